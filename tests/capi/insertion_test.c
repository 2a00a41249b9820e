// Insertion into a small fluid.
#include "check.h"

enum { particles = 108, most = 5 };
static int species[particles];
static double positions[3 * particles], box[3];

static lanescape_inserter* inserter_of_a_fluid(lanescape_model* model) {
  lanescape_inserter* inserter = NULL;
  OK(lanescape_make_start(model, particles, 0.4, 1, species, positions, box, NULL));
  OK(lanescape_inserter_create(model, particles, species, positions, box, NULL, &inserter));
  return inserter;
}

static void the_force_is_minus_the_slope(lanescape_inserter* inserter) {
  const double h = 1e-6, there[3] = {0.3, 0.4, 0.2}, ahead[3] = {0.3 + h, 0.4, 0.2};
  double energy = 0.0, next = 0.0, force[3], both[2];
  const double points[6] = {there[0], there[1], there[2], ahead[0], ahead[1], ahead[2]};
  OK(lanescape_inserter_energy(inserter, there, &energy, force));
  OK(lanescape_inserter_energy(inserter, ahead, &next, NULL));
  OK(lanescape_inserter_energies(inserter, 2, points, both));
  CHECK(near(-(next - energy) / h, force[0], 1e-3 * fabs(force[0])));
  CHECK(near(both[0], energy, 1e-12 * fabs(energy)) && near(both[1], next, 1e-12 * fabs(next)));
}

static lanescape_insertion_settings settings_for(double energy) {
  lanescape_insertion_settings settings;
  OK(lanescape_insertion_settings_init(&settings, sizeof settings));
  settings.energy = energy;
  return settings;
}

static void positions_of_the_energy_are_found(lanescape_inserter* inserter) {
  const lanescape_insertion_settings settings = settings_for(-4.0);
  int found[most];
  double places[3 * most], energies[most], errors[most];
  uint64_t evaluations[most], trials[most];
  const lanescape_insertions all = {.size = sizeof all,
                                    .found = found,
                                    .positions = places,
                                    .energies = energies,
                                    .errors = errors,
                                    .evaluations = evaluations,
                                    .trials = trials};
  OK(lanescape_inserter_find(inserter, &settings, most, &all));
  for (int k = 0; k < most; ++k) {
    double energy = 0.0;
    OK(lanescape_inserter_energy(inserter, places + 3 * k, &energy, NULL));
    CHECK(found[k] == 1 && near(energies[k], -4.0, 0.04) && fabs(errors[k]) <= 0.01 && evaluations[k] >= 1 && trials[k] >= 1);
    CHECK(near(energy, energies[k], 1e-9));
  }
  size_t before = 0, after = 0;
  int removed = 7;
  OK(lanescape_inserter_particles(inserter, &before));
  OK(lanescape_inserter_insert(inserter, &settings, 2, &all));
  OK(lanescape_inserter_particles(inserter, &after));
  CHECK(before == particles && after == particles + 2);
  OK(lanescape_inserter_remove(inserter, places, &removed));
  CHECK(removed == 1);
  OK(lanescape_inserter_remove(inserter, places, &removed));
  CHECK(removed == 0);
  OK(lanescape_inserter_add(inserter, places));
  OK(lanescape_inserter_particles(inserter, &after));
  CHECK(after == particles + 2);
}

static void bad_input_is_refused(lanescape_model* model, lanescape_inserter* inserter) {
  const double nowhere[3] = {NAN, 0.0, 0.0}, here[3] = {0.3, 0.4, 0.2};
  double energy = 0.0;
  lanescape_insertion_settings settings = settings_for(-4.0);
  lanescape_insertions nothing = {.size = sizeof nothing};
  REFUSED(lanescape_inserter_add(inserter, nowhere), "finite");
  REFUSED(lanescape_inserter_remove(inserter, nowhere, NULL), "finite");
  REFUSED(lanescape_inserter_energy(inserter, NULL, &energy, NULL), "argument position is NULL");
  REFUSED(lanescape_inserter_energy(inserter, here, NULL, NULL), "argument energy is NULL");
  REFUSED(lanescape_inserter_energies(inserter, 1, NULL, &energy), "argument positions is NULL");
  REFUSED(lanescape_inserter_energies(inserter, 1, here, NULL), "argument energies is NULL");
  settings.threads = -3;
  REFUSED(lanescape_inserter_find(inserter, &settings, 1, &nothing), "-3 threads are not allowed");
  settings.threads = 1;
  settings.method = "magic";
  REFUSED(lanescape_inserter_find(inserter, &settings, 1, &nothing), "magic");
  REFUSED(lanescape_inserter_insert(inserter, NULL, 1, NULL), "argument insertions is NULL");
  settings.size = 1;
  REFUSED(lanescape_inserter_find(inserter, &settings, 1, &nothing), "of size 1 is not known");
  nothing.size = 2;
  REFUSED(lanescape_inserter_find(inserter, NULL, 1, &nothing), "of size 2 is not known");
  lanescape_inserter* none = NULL;
  lanescape_inserter_options options;
  OK(lanescape_inserter_options_init(&options, sizeof options));
  options.species = 5;
  REFUSED(lanescape_inserter_create(model, particles, species, positions, box, &options, &none), "5");
  REFUSED(lanescape_inserter_create(model, particles, NULL, positions, box, NULL, &none), "argument species is NULL");
  REFUSED(lanescape_inserter_create(model, particles, species, NULL, box, NULL, &none), "argument positions is NULL");
  REFUSED(lanescape_inserter_create(model, SIZE_MAX / 3, species, positions, box, NULL, &none), "would have");
  CHECK(none == NULL);
}

int main(void) {
  lanescape_model* model = named_model("lennard-jones");
  lanescape_inserter* inserter = inserter_of_a_fluid(model);
  the_force_is_minus_the_slope(inserter);
  positions_of_the_energy_are_found(inserter);
  bad_input_is_refused(model, inserter);
  OK(lanescape_inserter_destroy(inserter));
  size_t n = 0;
  REFUSED(lanescape_inserter_particles(inserter, &n), "it was destroyed");
  OK(lanescape_model_destroy(model));
  return failures != 0;
}
