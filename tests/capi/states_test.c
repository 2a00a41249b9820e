// Sites in states with an order parameter and probabilities of the caller's own.
#include "check.h"

enum { sites = 64 };

// What fails, and with what code.
struct plan {
  const char* failing;
  int code;
  lanescape_potential* used_inside;
};

static int fails(void* user, const char* name) {
  const struct plan* plan = user;
  return plan->failing != NULL && strcmp(plan->failing, name) == 0 ? plan->code : 0;
}

// The number of neighbours, each weighted with (1 - r^2/4)^3.
static double inside(const double* d) {
  const double x = 1.0 - 0.25 * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  return x > 0.0 ? x : 0.0;
}

static int reach(void* user, int first, int second, double* to) {
  *to = 2.0;
  CHECK(first == 0 && second == 0);
  return fails(user, "reach");
}

static int evaluate(void* user, const lanescape_site_pairs* pairs, size_t count, const int* species, double* values) {
  CHECK(pairs->size == sizeof *pairs && count == sites && species[sites - 1] == 0);
  for (size_t i = 0; i < count; ++i) values[i] = 0.0;
  for (size_t k = 0; k < pairs->count; ++k) values[pairs->first[k]] += pow(inside(pairs->separation + 3 * k), 3.0);
  const struct plan* plan = user;
  if (plan->used_inside != NULL)
    REFUSED(lanescape_potential_states(plan->used_inside, NULL, NULL, NULL), "is in use by another call");
  return fails(user, "evaluate");
}

static int add_gradient(void* user, const lanescape_site_pairs* pairs, size_t count, const int* species, const double* multipliers,
                        double* gradient, double* virial) {
  static const int voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  CHECK(count == sites && species[0] == 0);
  for (size_t k = 0; k < pairs->count; ++k) {
    const int64_t i = pairs->first[k], j = pairs->second[k];
    const double *d = pairs->separation + 3 * k, x = inside(d);
    const double slope_over_r = -1.5 * x * x * (multipliers[i] + multipliers[j]);
    for (int axis = 0; axis < 3; ++axis) gradient[3 * i + axis] += slope_over_r * d[axis];
    for (int v = 0; v < 6; ++v) virial[v] -= 0.5 * slope_over_r * d[voigt[v][0]] * d[voigt[v][1]];
  }
  return fails(user, "add_gradient");
}

static int respond(void* user, int species, double value, double* states) {
  const double x = value - 2.0, p = 1.0 / (1.0 + exp(-x)), q = 1.0 / (1.0 + exp(x));
  const double both[6] = {p, p * q, -log1p(exp(-x)), q, -p * q, -log1p(exp(x))};
  memcpy(states, both, sizeof both);
  CHECK(species == 0);
  return fails(user, "respond");
}

static lanescape_state_functions functions_of(struct plan* plan) {
  const lanescape_state_functions functions = {sizeof functions, plan, 2, reach, evaluate, add_gradient, respond};
  return functions;
}

struct fluid {
  lanescape_model* model;
  int species[sites];
  double positions[3 * sites], box[3];
};

static struct fluid make_fluid(void) {
  struct fluid fluid = {.model = named_model("ucg")};
  OK(lanescape_make_start(fluid.model, sites, 0.6, 9, fluid.species, fluid.positions, fluid.box, NULL));
  for (int k = 0; k < 3 * sites; ++k) fluid.positions[k] += 0.1 * sin(17.0 * k);
  return fluid;
}

static lanescape_potential* make(const struct fluid* fluid, struct plan* plan) {
  const lanescape_state_functions functions = functions_of(plan);
  lanescape_potential* potential = NULL;
  OK(lanescape_potential_create_with_states(fluid->model, sites, fluid->species, fluid->box, NULL, &functions, &potential));
  return potential;
}

static double energy_at(lanescape_potential* potential, const double* positions) {
  double energy = 0.0;
  const lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy};
  OK(lanescape_potential_evaluate(potential, positions, &outputs));
  return energy;
}

static void forces_are_slopes_of_the_energy(void) {
  struct fluid fluid = make_fluid();
  struct plan plan = {NULL, 0, NULL};
  lanescape_potential *potential = make(&fluid, &plan), *plain = NULL;
  double forces[3 * sites], energy, virial, stress[6], order[sites], p[2 * sites];
  const lanescape_outputs outputs = {sizeof outputs, &energy, &virial, stress, forces, NULL};
  OK(lanescape_potential_evaluate(potential, fluid.positions, &outputs));
  OK(lanescape_potential_states(potential, NULL, order, p));
  for (int i = 0; i < sites; ++i) CHECK(near(p[2 * i], 1.0 / (1.0 + exp(2.0 - order[i])), 1e-12));
  const double volume = fluid.box[0] * fluid.box[1] * fluid.box[2];
  CHECK(near((stress[0] + stress[1] + stress[2]) * volume, -virial, 1e-9 * fabs(virial)));
  const double h = 1e-6;
  for (int k = 0; k < 3 * sites; k += 47) {
    const double at = fluid.positions[k];
    fluid.positions[k] = at + h;
    const double up = energy_at(potential, fluid.positions);
    fluid.positions[k] = at - h;
    const double down = energy_at(potential, fluid.positions);
    fluid.positions[k] = at;
    CHECK(near(forces[k], -(up - down) / (2.0 * h), 1e-6 * (1.0 + fabs(forces[k]))));
  }
  OK(lanescape_potential_create(fluid.model, sites, fluid.species, fluid.box, NULL, &plain));
  CHECK(energy_at(plain, fluid.positions) != energy);
  lanescape_dynamics* dynamics = NULL;
  OK(lanescape_dynamics_create(potential, NULL, fluid.positions, 0.001, &dynamics));
  OK(lanescape_dynamics_run(dynamics, 2));
  plan = (struct plan){"evaluate", 31, NULL};
  CHECK(lanescape_dynamics_run(dynamics, 2) == LANESCAPE_CALLBACK_FAILED && lanescape_last_callback_error() == 31);
  OK(lanescape_dynamics_destroy(dynamics));
  OK(lanescape_potential_destroy(plain));
  OK(lanescape_potential_destroy(potential));
  OK(lanescape_model_destroy(fluid.model));
}

static void codes_of_the_functions_come_back(void) {
  const struct fluid fluid = make_fluid();
  struct plan plan = {NULL, 0, NULL};
  lanescape_potential* potential = make(&fluid, &plan);
  double energy = 7.0, forces[3 * sites];
  const lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy, .forces = forces};
  static const char* const names[] = {"evaluate", "add_gradient", "respond"};
  for (int k = 0; k < 3; ++k) {
    plan = (struct plan){names[k], 40 + k, NULL};
    CHECK(lanescape_potential_evaluate(potential, fluid.positions, &outputs) == LANESCAPE_CALLBACK_FAILED);
    CHECK(lanescape_last_callback_error() == 40 + k && strstr(lanescape_last_error(), names[k]) != NULL && energy == 7.0);
  }
  plan = (struct plan){"reach", -3, NULL};
  const lanescape_state_functions functions = functions_of(&plan);
  lanescape_potential* none = NULL;
  CHECK(lanescape_potential_create_with_states(fluid.model, sites, fluid.species, fluid.box, NULL, &functions, &none) ==
        LANESCAPE_CALLBACK_FAILED);
  CHECK(none == NULL && lanescape_last_callback_error() == -3);
  plan = (struct plan){NULL, 0, potential};
  CHECK(energy_at(potential, fluid.positions) != 7.0);
  OK(lanescape_potential_destroy(potential));
  OK(lanescape_model_destroy(fluid.model));
}

static void bad_functions_are_refused(void) {
  const struct fluid fluid = make_fluid();
  lanescape_model* pairs = named_model("lennard-jones");
  struct plan plan = {NULL, 0, NULL};
  lanescape_potential* potential = NULL;
  lanescape_potential_options options;
  OK(lanescape_potential_options_init(&options, sizeof options));
#define MAKE(model, functions) \
  lanescape_potential_create_with_states(model, sites, fluid.species, fluid.box, &options, functions, &potential)
  lanescape_state_functions functions = functions_of(&plan);
  REFUSED(MAKE(fluid.model, NULL), "argument functions is NULL");
  REFUSED(MAKE(pairs, &functions), "has no states");
  functions.states = 3;
  REFUSED(MAKE(fluid.model, &functions), "3 states");
  functions = functions_of(&plan);
  functions.add_gradient = NULL;
  REFUSED(MAKE(fluid.model, &functions), "argument functions->add_gradient is NULL");
  functions = functions_of(&plan);
  functions.size = 8;
  REFUSED(MAKE(fluid.model, &functions), "is not known");
  functions = functions_of(&plan);
  options.threads = 2;
  REFUSED(MAKE(fluid.model, &functions), "2 threads are not allowed");
  options.threads = 1;
  options.precision = "mixed";
  REFUSED(MAKE(fluid.model, &functions), "precision mixed is not possible");
#undef MAKE
  CHECK(potential == NULL);
  OK(lanescape_model_destroy(pairs));
  OK(lanescape_model_destroy(fluid.model));
}

int main(void) {
  forces_are_slopes_of_the_energy();
  codes_of_the_functions_come_back();
  bad_functions_are_refused();
  return failures != 0;
}
