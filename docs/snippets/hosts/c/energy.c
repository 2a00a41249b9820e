// The energy and forces of a liquid.
#include <lanescape/lanescape.h>

#include <stdio.h>

int main(void) {
  enum { n = 108 };
  int species[n];
  double positions[3 * n], box[3], energy, forces[3 * n];
  lanescape_model* model;
  lanescape_potential* potential;
  const lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy, .forces = forces};
  if (lanescape_model_named("kob-andersen", NULL, &model) != LANESCAPE_OK ||
      lanescape_make_start(model, n, 1.2, 1, species, positions, box, NULL) != LANESCAPE_OK ||
      lanescape_potential_create(model, n, species, box, NULL, &potential) != LANESCAPE_OK ||
      lanescape_potential_evaluate(potential, positions, &outputs) != LANESCAPE_OK) {
    fprintf(stderr, "%s\n", lanescape_last_error());
    return 1;
  }
  printf("V = %.6f\n", energy);
  lanescape_potential_destroy(potential);
  lanescape_model_destroy(model);
  return 0;
}
