// The potential energy of pairs against the formula, and refusals.
#include "check.h"

static const int two[2] = {0, 0};
static const double apart[6] = {9.5, 1.0, 2.0, 1.0, 1.0, 2.0};  // 1.5 across a face of the box

static lanescape_potential* plain_pair(const lanescape_potential_options* options) {
  lanescape_model* model = NULL;
  const lanescape_model_changes changes = {.size = sizeof changes, .truncation = "plain"};
  OK(lanescape_model_named("lennard-jones", &changes, &model));
  lanescape_potential* potential = NULL;
  OK(lanescape_potential_create(model, 2, two, cube, options, &potential));
  OK(lanescape_model_destroy(model));  // the potential keeps what it needs
  return potential;
}

static void two_particles_have_the_pair_potential(void) {
  for (size_t k = 0; lanescape_instruction_set(k) != NULL; ++k) {
    lanescape_potential_options options;
    OK(lanescape_potential_options_init(&options, sizeof options));
    options.instruction_set = lanescape_instruction_set(k);
    lanescape_potential* potential = plain_pair(&options);
    double energy, virial, stress[6], forces[6];
    const lanescape_outputs outputs = {
        .size = sizeof outputs, .energy = &energy, .virial = &virial, .stress = stress, .forces = forces};
    OK(lanescape_potential_evaluate(potential, apart, &outputs));
    const double s6 = pow(1.5, -6.0), slope = -24.0 * (2.0 * s6 * s6 - s6) / 1.5;
    CHECK(near(energy, 4.0 * (s6 * s6 - s6), 1e-15));
    CHECK(near(virial, -1.5 * slope, 1e-14) && near(forces[0], slope, 1e-14) && near(forces[3], -slope, 1e-14));
    CHECK(forces[1] == 0.0 && forces[2] == 0.0 && forces[4] == 0.0 && forces[5] == 0.0);
    CHECK(near(stress[0], -virial / 1000.0, 1e-17) && stress[1] == 0.0 && stress[3] == 0.0);

    double alone = 0.0;
    const lanescape_outputs only_energy = {.size = sizeof only_energy, .energy = &alone};
    const lanescape_outputs only_virial = {.size = sizeof only_virial, .virial = &virial};
    OK(lanescape_potential_evaluate(potential, apart, &only_energy));
    OK(lanescape_potential_evaluate(potential, apart, &only_virial));
    CHECK(alone == energy && near(virial, -1.5 * slope, 1e-14));
    OK(lanescape_potential_destroy(potential));
  }
}

static void energies_of_particles_add_up(void) {
  lanescape_potential* potential = plain_pair(NULL);
  double energy = 0.0, energies[2] = {7.0, 7.0};
  const lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy, .energies = energies};
  OK(lanescape_potential_evaluate(potential, apart, &outputs));
  CHECK(near(energies[0], 0.5 * energy, 1e-15) && near(energies[1], 0.5 * energy, 1e-15));
  OK(lanescape_potential_destroy(potential));
}

static double energy_of(lanescape_potential* potential) {
  double energy = 0.0;
  const lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy};
  OK(lanescape_potential_evaluate(potential, apart, &outputs));
  return energy;
}

static void another_box_changes_the_energy(void) {
  lanescape_potential *potential = plain_pair(NULL), *copy = NULL;
  const double before = energy_of(potential), longer[3] = {20.0, 10.0, 10.0};
  OK(lanescape_potential_copy(potential, &copy));
  OK(lanescape_potential_set_box(potential, longer));
  CHECK(energy_of(potential) == 0.0 && energy_of(copy) == before);
  size_t particles = 0;
  OK(lanescape_potential_particles(copy, &particles));
  CHECK(particles == 2);
  const double none[3] = {0.0, 10.0, 10.0};
  REFUSED(lanescape_potential_set_box(potential, none), "box edge 0");
  REFUSED(lanescape_potential_set_box(potential, NULL), "argument box is NULL");
  CHECK(energy_of(potential) == 0.0);
  OK(lanescape_potential_destroy(potential));
  OK(lanescape_potential_destroy(copy));
}

static void excluded_pairs_do_not_interact(void) {
  lanescape_potential* potential = plain_pair(NULL);
  const double energy = energy_of(potential);
  const size_t pair[2] = {0, 1}, unknown[2] = {0, 9};
  OK(lanescape_potential_set_exclusions(potential, 1, pair));
  CHECK(energy != 0.0 && near(energy_of(potential), 0.0, 1e-14));
  OK(lanescape_potential_set_exclusions(potential, 0, NULL));
  CHECK(energy_of(potential) == energy);
  REFUSED(lanescape_potential_set_exclusions(potential, 1, unknown), "9");
  REFUSED(lanescape_potential_set_exclusions(potential, 1, NULL), "argument particles is NULL");
  REFUSED(lanescape_potential_set_exclusions(potential, SIZE_MAX, pair), "argument particles would have");
  REFUSED(lanescape_potential_states(potential, NULL, NULL, NULL), "one of sites in states is needed");
  OK(lanescape_potential_destroy(potential));
}

static void a_move_changes_the_energy(void) {
  lanescape_model* model = named_model("lennard-jones");
  lanescape_moves* moves = NULL;
  OK(lanescape_moves_create(model, 2, two, apart, cube, NULL, &moves));
  const double to[3] = {1.25, 1.0, 2.0}, nowhere[3] = {NAN, 0.0, 0.0};
  double change = 0.0, back = 0.0, positions[6];
  OK(lanescape_moves_energy_change(moves, 1, to, &change));
  OK(lanescape_moves_positions(moves, positions));
  CHECK(change > 0.0 && positions[3] == 1.0);
  OK(lanescape_moves_accept(moves));
  OK(lanescape_moves_positions(moves, positions));
  OK(lanescape_moves_energy_change(moves, 1, apart + 3, &back));
  CHECK(positions[3] == 1.25 && near(back, -change, 1e-12));
  REFUSED(lanescape_moves_energy_change(moves, 2, to, &change), "2");
  REFUSED(lanescape_moves_energy_change(moves, 1, nowhere, &change), "finite");
  REFUSED(lanescape_moves_energy_change(moves, 1, NULL, &change), "argument to is NULL");
  REFUSED(lanescape_moves_energy_change(moves, 1, to, NULL), "argument change is NULL");
  REFUSED(lanescape_moves_positions(moves, NULL), "argument positions is NULL");
  OK(lanescape_moves_destroy(moves));
  REFUSED(lanescape_moves_accept(moves), "it was destroyed");
  REFUSED(lanescape_moves_create(model, 2, two, NULL, cube, NULL, &moves), "argument positions is NULL");
  OK(lanescape_model_destroy(model));
}

// The same numbers in arrays of x, y and z, in rows of four, and from the last to the first.
static void strided_arrays_give_the_same(lanescape_potential* potential, size_t n, const double* positions) {
  enum { most = 64 };
  double energy[2], virial, forces[3 * most], separate[2][3][most], rows[2][4 * most], reverse[2][3 * most];
  lanescape_outputs outputs = {.size = sizeof outputs, .energy = energy, .virial = &virial, .forces = forces};
  OK(lanescape_potential_evaluate(potential, positions, &outputs));
  const double expected = virial;
  outputs = (lanescape_outputs){.size = sizeof outputs, .energy = energy + 1, .virial = &virial};
  for (size_t i = 0; i < n; ++i)
    for (size_t k = 0; k < 3; ++k) separate[0][k][i] = rows[0][4 * i + k] = reverse[0][3 * (n - 1 - i) + k] = positions[3 * i + k];
  double *p = reverse[0] + 3 * (n - 1), *f = reverse[1] + 3 * (n - 1);
  const lanescape_positions from[] = {{sizeof from[0], separate[0][0], separate[0][1], separate[0][2], 1},
                                      {sizeof from[0], rows[0], rows[0] + 1, rows[0] + 2, 4},
                                      {sizeof from[0], p, p + 1, p + 2, -3}};
  const lanescape_forces to[] = {{sizeof to[0], separate[1][0], separate[1][1], separate[1][2], 1},
                                 {sizeof to[0], rows[1], rows[1] + 1, rows[1] + 2, 4},
                                 {sizeof to[0], f, f + 1, f + 2, -3}};
  for (int k = 0; k < 3; ++k) {
    OK(lanescape_potential_evaluate_strided(potential, from + k, &outputs, to + k));
    CHECK(energy[0] == energy[1] && virial == expected);
    OK(lanescape_potential_evaluate_strided(potential, from + k, &outputs, NULL));
    CHECK(energy[0] == energy[1]);
  }
  for (size_t i = 0; i < n; ++i)
    for (size_t k = 0; k < 3; ++k)
      CHECK(separate[1][k][i] == forces[3 * i + k] && rows[1][4 * i + k] == forces[3 * i + k] &&
            reverse[1][3 * (n - 1 - i) + k] == forces[3 * i + k]);
}

static void sites_have_states(void) {
  enum { sites = 64 };
  int species[sites];
  double positions[3 * sites], box[3], forces[3 * sites], energy = 0.0, order[sites], p[2 * sites];
  lanescape_model* model = named_model("ucg");
  lanescape_potential* potential = NULL;
  OK(lanescape_make_start(model, sites, 0.3, 1, species, positions, box, NULL));
  OK(lanescape_potential_create(model, sites, species, box, NULL, &potential));
  const lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy, .forces = forces};
  OK(lanescape_potential_evaluate(potential, positions, &outputs));
  size_t states = 0;
  OK(lanescape_potential_states(potential, &states, NULL, NULL));
  CHECK(states == 2 && energy != 0.0);
  OK(lanescape_potential_states(potential, NULL, order, states == 2 ? p : NULL));
  for (int i = 0; i < sites; ++i) CHECK(order[i] > 0.0 && near(p[2 * i] + p[2 * i + 1], 1.0, 1e-14));
  strided_arrays_give_the_same(potential, sites, positions);
  lanescape_dynamics* dynamics = NULL;
  OK(lanescape_dynamics_create(potential, NULL, positions, 0.001, &dynamics));
  OK(lanescape_dynamics_run(dynamics, 2));
  OK(lanescape_dynamics_destroy(dynamics));
  const double longer[3] = {box[0], box[1], 1.1 * box[2]}, before = energy;
  OK(lanescape_potential_set_box(potential, longer));
  OK(lanescape_potential_evaluate(potential, positions, &outputs));
  CHECK(energy != before);
  lanescape_potential* copy = NULL;
  REFUSED(lanescape_potential_copy(potential, &copy), "one of pairs is needed");
  OK(lanescape_potential_destroy(potential));
  lanescape_potential_options options;
  OK(lanescape_potential_options_init(&options, sizeof options));
  options.precision = "mixed";
  REFUSED(lanescape_potential_create(model, sites, species, box, &options, &potential), "precision mixed is not possible");
  OK(lanescape_model_destroy(model));
}

static void arrays_may_be_separate(void) {
  lanescape_potential* potential = plain_pair(NULL);
  strided_arrays_give_the_same(potential, 2, apart);
  double forces[6], energy = 7.0;
  lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy, .forces = forces};
  lanescape_positions from = {sizeof from, apart, apart + 1, apart + 2, 3};
  lanescape_forces to = {sizeof to, forces, forces + 1, NULL, 3};
  REFUSED(lanescape_potential_evaluate_strided(potential, &from, &outputs, NULL), "argument outputs->forces must be NULL");
  outputs.forces = NULL;
  REFUSED(lanescape_potential_evaluate_strided(potential, &from, &outputs, &to), "argument forces->z is NULL");
  to.size = 8;
  REFUSED(lanescape_potential_evaluate_strided(potential, &from, &outputs, &to), "is not known");
  from.y = NULL;
  REFUSED(lanescape_potential_evaluate_strided(potential, &from, &outputs, NULL), "argument positions->y is NULL");
  from.y = apart + 1;
  from.stride = 0;
  REFUSED(lanescape_potential_evaluate_strided(potential, &from, &outputs, NULL), "argument positions->stride is 0");
  REFUSED(lanescape_potential_evaluate_strided(potential, NULL, &outputs, NULL), "argument positions is NULL");
  from.stride = 3;
  REFUSED(lanescape_potential_evaluate_strided(potential, &from, NULL, NULL), "argument outputs is NULL");
  CHECK(energy == 7.0);
  OK(lanescape_potential_destroy(potential));
}

static void bad_systems_are_refused(void) {
  lanescape_model *model = named_model("kob-andersen"), *hard = named_model("hard-sphere");
  lanescape_potential* potential = NULL;
  const int unknown[2] = {0, 2};
  const double bad_box[3] = {10.0, NAN, 10.0};
  REFUSED(lanescape_potential_create(model, 2, unknown, cube, NULL, &potential), "species 2 is not allowed");
  REFUSED(lanescape_potential_create(model, 2, two, bad_box, NULL, &potential), "box edge nan");
  REFUSED(lanescape_potential_create(hard, 2, two, cube, NULL, &potential), "hard spheres");
  REFUSED(lanescape_potential_create(NULL, 2, two, cube, NULL, &potential), "argument model is NULL");
  REFUSED(lanescape_potential_create(model, 2, NULL, cube, NULL, &potential), "argument species is NULL");
  REFUSED(lanescape_potential_create(model, 2, two, NULL, NULL, &potential), "argument box is NULL");
  REFUSED(lanescape_potential_create(model, 2, two, cube, NULL, NULL), "argument potential is NULL");
  REFUSED(lanescape_potential_create(model, SIZE_MAX, two, cube, NULL, &potential), "argument species would have");
  lanescape_potential_options options;
  OK(lanescape_potential_options_init(&options, sizeof options));
  for (int k = 0; k < 3; ++k) {
    options.threads = k == 2 ? 100000000 : -k;
    REFUSED(lanescape_potential_create(model, 2, two, cube, &options, &potential), "threads are not allowed: from 1 to 4096");
  }
  options.threads = 1;
  options.precision = "half";
  REFUSED(lanescape_potential_create(model, 2, two, cube, &options, &potential), "unknown precision 'half'");
  options.size = 0;
  REFUSED(lanescape_potential_create(model, 2, two, cube, &options, &potential), "of size 0 is not known");
  REFUSED(lanescape_potential_options_init(NULL, sizeof options), "argument options is NULL");
  CHECK(potential == NULL);
  OK(lanescape_model_destroy(model));
  REFUSED(lanescape_potential_create(model, 2, two, cube, NULL, &potential), "argument model is no live handle");
  OK(lanescape_model_destroy(hard));
}

static void bad_evaluations_are_refused(void) {
  lanescape_potential* potential = plain_pair(NULL);
  double energy = 7.0, forces[6];
  lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy, .forces = forces};
  double positions[6];
  memcpy(positions, apart, sizeof positions);
  positions[4] = NAN;
  REFUSED(lanescape_potential_evaluate(potential, positions, &outputs), "y coordinate nan of particle 1 (from 0)");
  positions[4] = INFINITY;
  REFUSED(lanescape_potential_evaluate(potential, positions, &outputs), "y coordinate inf of particle 1 (from 0)");
  REFUSED(lanescape_potential_evaluate(potential, NULL, &outputs), "argument positions is NULL");
  REFUSED(lanescape_potential_evaluate(potential, apart, NULL), "argument outputs is NULL");
  REFUSED(lanescape_potential_evaluate(NULL, apart, &outputs), "argument potential is NULL");
  outputs.size = sizeof outputs + 8;
  REFUSED(lanescape_potential_evaluate(potential, apart, &outputs), "is not known");
  outputs.size = sizeof outputs;
  CHECK(energy == 7.0);
  OK(lanescape_potential_destroy(potential));
  REFUSED(lanescape_potential_evaluate(potential, apart, &outputs), "argument potential is no live handle");
  REFUSED(lanescape_potential_destroy(potential), "it was destroyed");
  lanescape_model* model = named_model("lennard-jones");
  REFUSED(lanescape_potential_evaluate((lanescape_potential*)(void*)model, apart, &outputs), "no live handle of its kind");
  OK(lanescape_model_destroy(model));
}

int main(void) {
  two_particles_have_the_pair_potential();
  energies_of_particles_add_up();
  another_box_changes_the_energy();
  excluded_pairs_do_not_interact();
  a_move_changes_the_energy();
  sites_have_states();
  arrays_may_be_separate();
  bad_systems_are_refused();
  bad_evaluations_are_refused();
  return failures != 0;
}
