// A path of one particle in a plane, around a hill that it may not climb.
#include <lanescape/lanescape.h>

#include <math.h>
#include <stdio.h>

static int hill(void* user, const double* r, double* gradient, double* energy) {
  const double height = *(const double*)user;
  *energy = height * exp(-(r[0] * r[0] + r[1] * r[1]));
  for (int k = 0; gradient != NULL && k < 3; ++k) gradient[k] = k < 2 ? -2.0 * r[k] * *energy : 0.0;
  return 0;  // anything else ends the search and comes back
}

int main(void) {
  double height = 5.0;
  const double start[3] = {-2.0, 0.1, 0.0}, finish[3] = {2.0, 0.1, 0.0};
  const lanescape_landscape landscape = {.size = sizeof landscape, .user = &height, .particles = 1, .evaluate = hill};
  lanescape_path_settings settings;
  lanescape_path_settings_init(&settings, sizeof settings);
  const double most = 1.0;
  settings.landscape_energy = &most;
  lanescape_path* path;
  lanescape_path_summary summary = {.size = sizeof summary};
  if (lanescape_find_path_on(&landscape, start, finish, NULL, &settings, &path) != LANESCAPE_OK ||
      lanescape_path_summarise(path, &summary) != LANESCAPE_OK) {
    fprintf(stderr, "%s\n", lanescape_last_error());
    return 1;
  }
  printf("%s, length %.3f\n", summary.outcome, summary.length);
  lanescape_path_destroy(path);

  lanescape_shorten_settings shortening;
  lanescape_shorten_settings_init(&shortening, sizeof shortening);
  shortening.search = &settings;
  lanescape_short_path* shortest;
  lanescape_short_path_summary shortened = {.size = sizeof shortened};
  if (lanescape_shorten_path_on(&landscape, start, finish, NULL, 0, NULL, &shortening, &shortest) != LANESCAPE_OK ||
      lanescape_short_path_summarise(shortest, &shortened) != LANESCAPE_OK) {
    fprintf(stderr, "%s\n", lanescape_last_error());
    return 1;
  }
  printf("shortened to %.3f, Kuhn-Tucker residual %.1e\n", shortened.length, shortened.kuhn_tucker_residual);
  lanescape_short_path_destroy(shortest);
  return 0;
}
