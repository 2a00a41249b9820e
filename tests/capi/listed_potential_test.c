// A pair potential over lists of the caller: three particles in a row, the third a ghost.
#include "check.h"

static const int species[3] = {4, 4, 4}, rows[2] = {0, 1}, species_of[5] = {-1, -1, -1, -1, 0};
static const int first[2] = {1, 2}, second[2] = {0, 2};
static const int* neighbours[3] = {first, second, NULL};
static const int lengths[3] = {2, 2, 0};
static const double positions[9] = {0.0, 0.0, 0.0, 1.2, 0.0, 0.0, 2.4, 0.0, 0.0};
static const lanescape_lists lists = {.size = sizeof lists,
                                      .points = 3,
                                      .species = species,
                                      .rows = 2,
                                      .row_points = rows,
                                      .neighbours = neighbours,
                                      .lengths = lengths};

static double energy_at(double r) { return 4.0 * (pow(r, -12.0) - pow(r, -6.0)); }
static double slope_at(double r) { return -24.0 * (2.0 * pow(r, -13.0) - pow(r, -7.0)); }

static lanescape_listed_potential* make(const char* kind) {
  lanescape_model* model = NULL;
  const lanescape_model_changes changes = {.size = sizeof changes, .truncation = "plain"};
  OK(lanescape_model_named("lennard-jones", &changes, &model));
  lanescape_listed_options options;
  OK(lanescape_listed_options_init(&options, sizeof options));
  options.lists = kind;
  options.species_of = species_of;
  options.species = 5;
  lanescape_listed_potential* potential = NULL;
  OK(lanescape_listed_potential_create(model, &options, &potential));
  OK(lanescape_model_destroy(model));
  return potential;
}

static void kinds_of_lists_have_their_energy_and_forces(void) {
  const double own = energy_at(1.2), with_ghost = 0.5 * (energy_at(1.2) + energy_at(2.4));
  for (int on_ghosts = 0; on_ghosts < 2; ++on_ghosts) {
    lanescape_listed_potential* potential = make(on_ghosts ? "gradient" : NULL);
    OK(lanescape_listed_potential_set_lists(potential, &lists));
    double energy, virial, tensor[6], forces[9], energies[3], cutoff;
    const lanescape_listed_outputs outputs = {.size = sizeof outputs,
                                              .energy = &energy,
                                              .virial = &virial,
                                              .virial_tensor = tensor,
                                              .forces = forces,
                                              .energies = energies};
    OK(lanescape_listed_potential_evaluate(potential, positions, &outputs));
    CHECK(near(energy, own + with_ghost, 1e-14));
    CHECK(near(energies[0] + energies[1], energy, 1e-14) && energies[2] == 0.0);
    CHECK(near(virial, -1.2 * slope_at(1.2) - 0.5 * (1.2 * slope_at(1.2) + 2.4 * slope_at(2.4)), 1e-13));
    CHECK(near(tensor[0], virial, 1e-13) && tensor[1] == 0.0 && tensor[5] == 0.0);
    const double ghost = -0.5 * (slope_at(1.2) + slope_at(2.4));
    CHECK(near(forces[6], on_ghosts ? ghost : 0.0, 1e-14));
    CHECK(near(forces[0], slope_at(1.2) + (on_ghosts ? 0.5 : 1.0) * slope_at(2.4), 1e-13));

    double sum[9] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    const lanescape_listed_outputs added = {.size = sizeof added, .forces = sum, .add_to_forces = 1};
    OK(lanescape_listed_potential_evaluate(potential, positions, &added));
    CHECK(near(sum[0], 1.0 + forces[0], 1e-14) && sum[1] == 1.0);
    OK(lanescape_listed_potential_cutoff(potential, 0, 0, &cutoff));
    CHECK(cutoff == 2.5);
    OK(lanescape_listed_potential_destroy(potential));
  }
}

static void half_lists_count_each_pair_once(void) {
  static const int first_half[2] = {1, 2}, second_half[1] = {2};
  static const int* half[3] = {first_half, second_half, NULL};
  static const int half_lengths[3] = {2, 1, 0};
  lanescape_lists once = lists;
  once.neighbours = half;
  once.lengths = half_lengths;
  lanescape_listed_potential* potential = make("half");
  OK(lanescape_listed_potential_set_lists(potential, &once));
  double energy = 0.0, forces[9];
  const lanescape_listed_outputs outputs = {.size = sizeof outputs, .energy = &energy, .forces = forces};
  OK(lanescape_listed_potential_evaluate(potential, positions, &outputs));
  CHECK(near(energy, 2.0 * energy_at(1.2) + energy_at(2.4), 1e-14));
  CHECK(near(forces[6], -slope_at(1.2) - slope_at(2.4), 1e-14));
  OK(lanescape_listed_potential_destroy(potential));
}

static void bad_lists_are_refused(void) {
  lanescape_listed_potential* potential = make(NULL);
  lanescape_lists bad = lists;
  bad.lengths = NULL;
  REFUSED(lanescape_listed_potential_set_lists(potential, &bad), "lists->lengths");
  bad = lists;
  static const int far[2] = {1, 3};
  const int* wrong[3] = {far, second, NULL};
  bad.neighbours = wrong;
  REFUSED(lanescape_listed_potential_set_lists(potential, &bad), "neighbour 3 of point 0");
  OK(lanescape_listed_potential_destroy(potential));
  REFUSED(lanescape_listed_potential_set_lists(potential, &lists), "live handle");
  lanescape_listed_options options;
  OK(lanescape_listed_options_init(&options, sizeof options));
  options.lists = "quarter";
  lanescape_model* model = NULL;
  OK(lanescape_model_named("lennard-jones", NULL, &model));
  REFUSED(lanescape_listed_potential_create(model, &options, &potential), "quarter");
  OK(lanescape_model_destroy(model));
}

int main(void) {
  kinds_of_lists_have_their_energy_and_forces();
  half_lists_count_each_pair_once();
  bad_lists_are_refused();
  return failures != 0;
}
