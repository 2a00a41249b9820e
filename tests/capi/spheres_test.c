// Neighbour pairs and overlaps of hard spheres.
#include "check.h"

static const double apart[6] = {9.5, 1.0, 2.0, 0.25, 1.0, 2.0};  // 0.75 across a face of the box

static lanescape_neighbour_options within(double cutoff) {
  lanescape_neighbour_options options;
  OK(lanescape_neighbour_options_init(&options, sizeof options));
  options.cutoff = cutoff;
  return options;
}

static void pairs_have_their_shift(void) {
  lanescape_neighbours* neighbours = NULL;
  lanescape_neighbour_options options = within(2.5);
  lanescape_neighbour_pairs pairs = {.size = sizeof pairs};
  options.segments = 1;
  OK(lanescape_neighbours_create(&options, &neighbours));
  OK(lanescape_neighbours_find(neighbours, 2, apart, cube, NULL, &pairs));
  CHECK(pairs.count == 2 && pairs.first[0] == 0 && pairs.second[0] == 1 && pairs.first[1] == 1 && pairs.second[1] == 0);
  CHECK(pairs.shift[0] == 1 && pairs.shift[1] == 0 && pairs.shift[3] == -1);
  CHECK(pairs.separation[0] == 0.75 && pairs.separation[3] == -0.75 && pairs.distance[0] == 0.75);
  CHECK(pairs.segments[0] == 0 && pairs.segments[1] == 1 && pairs.segments[2] == 2);
  const int64_t bonded[2] = {0, 1};
  OK(lanescape_neighbours_exclude(neighbours, 1, bonded));
  OK(lanescape_neighbours_find(neighbours, 2, apart, cube, NULL, &pairs));
  CHECK(pairs.count == 0);
  OK(lanescape_neighbours_exclude(neighbours, 0, NULL));
  OK(lanescape_neighbours_find(neighbours, 0, NULL, cube, NULL, &pairs));
  CHECK(pairs.count == 0);
  OK(lanescape_neighbours_set_particles(neighbours, 2, apart, cube, NULL));
  OK(lanescape_neighbours_of_points(neighbours, 1, apart, NULL, &pairs));
  CHECK(pairs.count == 2 && pairs.first[1] == 0 && pairs.second[0] == 0 && pairs.distance[0] == 0.0 && pairs.second[1] == 1);
  OK(lanescape_neighbours_destroy(neighbours));
}

static void options_reach_the_search(void) {
  lanescape_neighbours* neighbours = NULL;
  lanescape_neighbour_options options = within(2.5);
  lanescape_neighbour_pairs pairs = {.size = sizeof pairs};
  options.half = 1;
  options.sorted = options.shifts = options.separations = 0;
  OK(lanescape_neighbours_create(&options, &neighbours));
  OK(lanescape_neighbours_find(neighbours, 2, apart, cube, NULL, &pairs));
  CHECK(pairs.count == 1 && pairs.first[0] == 0 && pairs.second[0] == 1 && pairs.distance[0] == 0.75);
  CHECK(pairs.shift == NULL && pairs.separation == NULL && pairs.segments == NULL);
  OK(lanescape_neighbours_destroy(neighbours));
  options.periodic[0] = 0;
  OK(lanescape_neighbours_create(&options, &neighbours));
  OK(lanescape_neighbours_find(neighbours, 2, apart, cube, NULL, &pairs));
  CHECK(pairs.count == 0);
  OK(lanescape_neighbours_destroy(neighbours));

  const double cutoffs[4] = {0.0, 1.0, 1.0, 0.0};  // unlike pairs only
  const int like[2] = {1, 1}, unlike[2] = {0, 1}, unknown[2] = {0, 2};
  options = within(0.0);
  options.species = 2;
  options.cutoffs = cutoffs;
  OK(lanescape_neighbours_create(&options, &neighbours));
  OK(lanescape_neighbours_find(neighbours, 2, apart, cube, like, &pairs));
  CHECK(pairs.count == 0);
  OK(lanescape_neighbours_find(neighbours, 2, apart, cube, unlike, &pairs));
  CHECK(pairs.count == 2);
  REFUSED(lanescape_neighbours_find(neighbours, 2, apart, cube, unknown, &pairs), "2");
  OK(lanescape_neighbours_destroy(neighbours));
  options.species = SIZE_MAX / 4;
  REFUSED(lanescape_neighbours_create(&options, &neighbours), "it must be at most");
}

static void bad_searches_are_refused(void) {
  lanescape_neighbours* neighbours = NULL;
  lanescape_neighbour_options options = within(2.5);
  lanescape_neighbour_pairs pairs = {.size = sizeof pairs};
  OK(lanescape_neighbours_create(&options, &neighbours));
  double positions[6];
  memcpy(positions, apart, sizeof positions);
  positions[0] = NAN;
  REFUSED(lanescape_neighbours_find(neighbours, 2, positions, cube, NULL, &pairs), "finite");
  REFUSED(lanescape_neighbours_find(neighbours, 2, NULL, cube, NULL, &pairs), "argument positions is NULL");
  REFUSED(lanescape_neighbours_find(neighbours, SIZE_MAX, apart, cube, NULL, &pairs), "argument positions would have");
  REFUSED(lanescape_neighbours_find(neighbours, 2, apart, NULL, NULL, &pairs), "argument box is NULL");
  REFUSED(lanescape_neighbours_find(neighbours, 2, apart, cube, NULL, NULL), "argument pairs is NULL");
  REFUSED(lanescape_neighbours_set_particles(neighbours, 2, NULL, cube, NULL), "argument positions is NULL");
  REFUSED(lanescape_neighbours_of_points(neighbours, 1, NULL, NULL, &pairs), "argument positions is NULL");
  REFUSED(lanescape_neighbours_exclude(neighbours, 1, NULL), "argument particles is NULL");
  REFUSED(lanescape_neighbours_exclude(neighbours, SIZE_MAX, NULL), "argument particles would have");
  pairs.size = 8;
  REFUSED(lanescape_neighbours_find(neighbours, 2, apart, cube, NULL, &pairs), "of size 8 is not known");
  OK(lanescape_neighbours_destroy(neighbours));
  pairs.size = sizeof pairs;
  REFUSED(lanescape_neighbours_find(neighbours, 2, apart, cube, NULL, &pairs), "it was destroyed");
  REFUSED(lanescape_neighbours_create(&options, NULL), "argument neighbours is NULL");
  REFUSED(lanescape_neighbours_create(NULL, &neighbours), "argument options is NULL");
  REFUSED(lanescape_neighbour_options_init(&options, 1), "of size 1 is not known");
  options.threads = 0;
  REFUSED(lanescape_neighbours_create(&options, &neighbours), "0 threads are not allowed");
  options.threads = 1;
  options.cutoff = -1.0;
  REFUSED(lanescape_neighbours_create(&options, &neighbours), "-1");
}

static void overlaps_are_found(void) {
  const double radii[2] = {0.5, 0.5};
  lanescape_hard_sphere_options options;
  OK(lanescape_hard_sphere_options_init(&options, sizeof options));
  for (options.skin = 0.0; options.skin < 0.5; options.skin += 0.3) {
    lanescape_hard_spheres* spheres = NULL;
    OK(lanescape_hard_spheres_create(2, radii, cube, &options, &spheres));
    int any = 7;
    double gap = 7.0;
    lanescape_overlaps overlaps = {.size = sizeof overlaps};
    OK(lanescape_hard_spheres_any_overlap(spheres, apart, &any));
    OK(lanescape_hard_spheres_smallest_gap(spheres, apart, &gap));
    OK(lanescape_hard_spheres_overlaps(spheres, apart, &overlaps));
    CHECK(any == 1 && gap == -0.25);
    CHECK(overlaps.count == 1 && overlaps.first[0] == 0 && overlaps.second[0] == 1 && overlaps.gap[0] == -0.25);
    const double touching[6] = {9.5, 1.0, 2.0, 0.5, 1.0, 2.0};
    OK(lanescape_hard_spheres_any_overlap(spheres, touching, &any));
    OK(lanescape_hard_spheres_overlaps(spheres, touching, &overlaps));
    CHECK(any == 0 && overlaps.count == 0);
    OK(lanescape_hard_spheres_destroy(spheres));
  }
}

static void bad_spheres_are_refused(void) {
  const double radii[2] = {0.5, 0.5}, negative[2] = {0.5, -1.0}, infinite[6] = {0, 0, 0, INFINITY, 0, 0};
  lanescape_hard_spheres* spheres = NULL;
  REFUSED(lanescape_hard_spheres_create(2, negative, cube, NULL, &spheres), "radius -1 of particle 1");
  REFUSED(lanescape_hard_spheres_create(2, NULL, cube, NULL, &spheres), "argument radii is NULL");
  REFUSED(lanescape_hard_spheres_create(0, NULL, cube, NULL, &spheres), "no spheres");
  REFUSED(lanescape_hard_spheres_create(2, radii, NULL, NULL, &spheres), "argument box is NULL");
  lanescape_hard_sphere_options options = {.size = 3};
  REFUSED(lanescape_hard_spheres_create(2, radii, cube, &options, &spheres), "of size 3 is not known");
  REFUSED(lanescape_hard_sphere_options_init(&options, 5), "of size 5 is not known");
  OK(lanescape_hard_spheres_create(2, radii, cube, NULL, &spheres));
  int any = 0;
  double gap = 0.0;
  lanescape_overlaps overlaps = {.size = sizeof overlaps};
  REFUSED(lanescape_hard_spheres_any_overlap(spheres, infinite, &any), "finite");
  REFUSED(lanescape_hard_spheres_any_overlap(spheres, apart, NULL), "argument any is NULL");
  REFUSED(lanescape_hard_spheres_any_overlap(spheres, NULL, &any), "argument positions is NULL");
  REFUSED(lanescape_hard_spheres_smallest_gap(spheres, apart, NULL), "argument gap is NULL");
  REFUSED(lanescape_hard_spheres_smallest_gap(spheres, NULL, &gap), "argument positions is NULL");
  REFUSED(lanescape_hard_spheres_overlaps(spheres, apart, NULL), "argument overlaps is NULL");
  overlaps.size = 0;
  REFUSED(lanescape_hard_spheres_overlaps(spheres, apart, &overlaps), "of size 0 is not known");
  OK(lanescape_hard_spheres_destroy(spheres));
  REFUSED(lanescape_hard_spheres_any_overlap(spheres, apart, &any), "argument spheres is no live handle");
  REFUSED(lanescape_hard_spheres_destroy(spheres), "it was destroyed");
}

int main(void) {
  pairs_have_their_shift();
  options_reach_the_search();
  bad_searches_are_refused();
  overlaps_are_found();
  bad_spheres_are_refused();
  return failures != 0;
}
