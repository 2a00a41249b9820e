// Molecular and event-driven dynamics, starts and end points.
#include "check.h"

enum { particles = 108 };
static int species[particles];
static double positions[3 * particles], box[3];

static lanescape_dynamics_report report_of(lanescape_dynamics* dynamics) {
  lanescape_dynamics_report report = {.size = sizeof report};
  OK(lanescape_dynamics_describe(dynamics, &report));
  return report;
}

static void energy_is_conserved_and_states_come_back(lanescape_potential* potential) {
  lanescape_dynamics* dynamics = NULL;
  OK(lanescape_dynamics_create(potential, NULL, positions, 0.002, &dynamics));
  OK(lanescape_potential_destroy(potential));  // the dynamics keeps what it needs
  OK(lanescape_dynamics_draw_velocities(dynamics, 1.0, 7));
  const lanescape_dynamics_report first = report_of(dynamics);
  CHECK(near(first.temperature, 1.0, 1e-12) && first.steps == 0);
  OK(lanescape_dynamics_run(dynamics, 100));
  const lanescape_dynamics_report later = report_of(dynamics);
  const double drift = later.kinetic_energy + later.potential_energy - first.kinetic_energy - first.potential_energy;
  CHECK(later.steps == 100 && fabs(drift) < 0.1 && later.kinetic_energy != first.kinetic_energy);

  size_t needed = 0, again = 0;
  OK(lanescape_dynamics_save(dynamics, NULL, 0, &needed));
  void* state = malloc(needed);
  OK(lanescape_dynamics_save(dynamics, state, needed, &again));
  double x[3 * particles], v[3 * particles], y[3 * particles], w[3 * particles];
  OK(lanescape_dynamics_get(dynamics, x, v));
  OK(lanescape_dynamics_run(dynamics, 10));
  OK(lanescape_dynamics_restore(dynamics, state, needed));
  OK(lanescape_dynamics_get(dynamics, y, w));
  CHECK(again == needed && memcmp(x, y, sizeof x) == 0 && memcmp(v, w, sizeof v) == 0 && report_of(dynamics).steps == 100);
  REFUSED(lanescape_dynamics_restore(dynamics, state, 3), "state: its bytes were cut or changed");
  ((char*)state)[needed / 2] ^= 1;
  REFUSED(lanescape_dynamics_restore(dynamics, state, needed), "state: its bytes were cut or changed");
  REFUSED(lanescape_dynamics_restore(dynamics, NULL, 3), "argument state is NULL");
  REFUSED(lanescape_dynamics_save(dynamics, NULL, 3, &needed), "argument state is NULL");
  free(state);
  v[5] = NAN;
  REFUSED(lanescape_dynamics_set_velocities(dynamics, v), "finite");
  REFUSED(lanescape_dynamics_set_velocities(dynamics, NULL), "argument velocities is NULL");
  REFUSED(lanescape_dynamics_draw_velocities(dynamics, -1.0, 1), "temperature");
  OK(lanescape_dynamics_destroy(dynamics));
  REFUSED(lanescape_dynamics_run(dynamics, 1), "it was destroyed");
}

struct spring {
  int calls, fail_at;
  lanescape_dynamics* used_inside;  // by the callback, which is refused
};

static int evaluate_spring(void* user, const double* x, double* gradient, double* energy) {
  struct spring* spring = user;
  if (++spring->calls == spring->fail_at) return -3;
  if (spring->used_inside != NULL) {
    REFUSED(lanescape_dynamics_run(spring->used_inside, 1), "argument dynamics is in use by another call");
    REFUSED(lanescape_dynamics_destroy(spring->used_inside), "argument dynamics is in use by another call");
  }
  *energy = 0.5 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
  for (int k = 0; gradient != NULL && k < 3; ++k) gradient[k] = x[k];
  return 0;
}

static void a_spring_swings(void) {
  struct spring spring = {0, 0, NULL};
  const lanescape_landscape landscape = {.size = sizeof landscape, .user = &spring, .particles = 1, .evaluate = evaluate_spring};
  const double mass = 4.0, at[3] = {1.0, 0.0, 0.0};  // period 4 pi
  lanescape_dynamics* dynamics = NULL;
  OK(lanescape_dynamics_create_on(&landscape, &mass, at, acos(-1.0) / 1000.0, &dynamics));
  OK(lanescape_dynamics_run(dynamics, 2000));
  double x[3];
  OK(lanescape_dynamics_get(dynamics, x, NULL));
  CHECK(near(x[0], -1.0, 1e-5) && x[1] == 0.0);
  spring.used_inside = dynamics;
  OK(lanescape_dynamics_run(dynamics, 1));
  spring.used_inside = NULL;
  spring.fail_at = spring.calls + 5;
  CHECK(lanescape_dynamics_run(dynamics, 10) == LANESCAPE_CALLBACK_FAILED && lanescape_last_callback_error() == -3);
  OK(lanescape_dynamics_destroy(dynamics));
  REFUSED(lanescape_dynamics_create_on(&landscape, &mass, at, -1.0, &dynamics), "time step");
  REFUSED(lanescape_dynamics_create_on(NULL, &mass, at, 1.0, &dynamics), "argument landscape is NULL");
  REFUSED(lanescape_dynamics_create_on(&landscape, &mass, NULL, 1.0, &dynamics), "argument positions is NULL");
  REFUSED(lanescape_dynamics_create(NULL, NULL, at, 1.0, &dynamics), "argument potential is NULL");
}

static void hard_spheres_collide(void) {
  lanescape_model* model = named_model("hard-sphere");
  double diameters[particles], radii[particles], x[3 * particles], v[3 * particles], y[3 * particles];
  OK(lanescape_make_start(model, particles, 0.3, 1, species, positions, box, diameters));
  for (int i = 0; i < particles; ++i) radii[i] = 0.5 * diameters[i];
  lanescape_event_driven* dynamics = NULL;
  OK(lanescape_event_driven_create(particles, radii, NULL, positions, box, NULL, &dynamics));
  REFUSED(lanescape_event_driven_collide(dynamics, 1), "at rest");
  OK(lanescape_event_driven_draw_velocities(dynamics, 3));
  OK(lanescape_event_driven_collide(dynamics, 1000));
  lanescape_event_driven_report report = {.size = sizeof report};
  OK(lanescape_event_driven_describe(dynamics, &report));
  CHECK(report.collisions == 1000 && report.time > 0.0 && report.compressibility > 1.0);
  CHECK(near(report.kinetic_energy, 1.5 * particles, 1e-9 * particles));
  REFUSED(lanescape_event_driven_advance_to(dynamics, report.time - 1.0), "must be finite and not before");
  OK(lanescape_event_driven_advance_to(dynamics, report.time + 0.01));
  size_t needed = 0, again = 0;
  OK(lanescape_event_driven_save(dynamics, NULL, 0, &needed));
  void* state = malloc(needed);
  OK(lanescape_event_driven_save(dynamics, state, needed, &again));
  OK(lanescape_event_driven_get(dynamics, x, v));
  OK(lanescape_event_driven_collide(dynamics, 10));
  OK(lanescape_event_driven_restore(dynamics, state, needed));
  OK(lanescape_event_driven_get(dynamics, y, NULL));
  CHECK(again == needed && memcmp(x, y, sizeof x) == 0);
  free(state);
  OK(lanescape_event_driven_set_velocities(dynamics, v));
  REFUSED(lanescape_event_driven_set_velocities(dynamics, NULL), "argument velocities is NULL");
  report.size = 5;
  REFUSED(lanescape_event_driven_describe(dynamics, &report), "of size 5 is not known");
  OK(lanescape_event_driven_destroy(dynamics));
  REFUSED(lanescape_event_driven_get(dynamics, x, v), "it was destroyed");
  positions[0] = positions[3];
  positions[1] = positions[4];
  positions[2] = positions[5];
  REFUSED(lanescape_event_driven_create(particles, radii, NULL, positions, box, NULL, &dynamics), "overlap");
  REFUSED(lanescape_event_driven_create(particles, NULL, NULL, positions, box, NULL, &dynamics), "argument radii is NULL");
  OK(lanescape_model_destroy(model));
}

static int count(void* user, double done) {
  ++*(int*)user;
  return done > 2.0;
}
static int stop(void* user, double done) { return user == NULL && done >= 0.0; }

static void end_points_are_made(void) {
  lanescape_model* model = named_model("hard-sphere");
  lanescape_end_points* ends = NULL;
  lanescape_end_point_settings settings;
  OK(lanescape_end_point_settings_init(&settings, sizeof settings));
  OK(lanescape_make_start(model, particles, 0.3, 1, species, positions, box, NULL));
  int reports = 0;
  settings.quick = 1;
  settings.pairs = 2;
  settings.distance = 5.0;
  settings.progress = count;
  settings.progress_user = &reports;
  OK(lanescape_make_end_points(model, particles, species, positions, box, NULL, &settings, &ends));
  size_t pairs = 0;
  OK(lanescape_end_points_count(ends, &pairs));
  CHECK(pairs == 2 && reports > 0);
  double start[3 * particles], finish[3 * particles], distance = 0.0, time = 0.0;
  uint64_t steps = 0;
  OK(lanescape_end_points_get(ends, 1, start, finish, &distance, &steps, &time));
  CHECK(distance >= 5.0 && steps > 0 && time > 0.0 && memcmp(start, finish, sizeof start) != 0);
  OK(lanescape_end_points_get(ends, 0, NULL, NULL, NULL, NULL, NULL));
  REFUSED(lanescape_end_points_get(ends, 2, start, finish, NULL, NULL, NULL), "there are 2");
  OK(lanescape_end_points_destroy(ends));
  REFUSED(lanescape_end_points_count(ends, &pairs), "it was destroyed");
  settings.progress = stop;
  settings.progress_user = NULL;
  CHECK(lanescape_make_end_points(model, particles, species, positions, box, NULL, &settings, &ends) == LANESCAPE_INTERRUPTED);
  CHECK(strstr(lanescape_last_error(), "interrupted") != NULL && ends == NULL);
  lanescape_model* soft = named_model("lennard-jones");
  settings.threads = 0;
  REFUSED(lanescape_make_end_points(soft, particles, species, positions, box, NULL, &settings, &ends), "0 threads are not allowed");
  OK(lanescape_model_destroy(soft));
  settings.size = 2;
  REFUSED(lanescape_make_end_points(model, particles, species, positions, box, NULL, &settings, &ends), "of size 2 is not known");
  REFUSED(lanescape_make_end_points(model, particles, NULL, positions, box, NULL, NULL, &ends), "argument species is NULL");
  REFUSED(lanescape_make_start(model, particles, 0.3, 1, NULL, positions, box, NULL), "argument species is NULL");
  REFUSED(lanescape_make_start(model, particles, 0.3, 1, species, NULL, box, NULL), "argument positions is NULL");
  REFUSED(lanescape_make_start(model, particles, 0.3, 1, species, positions, NULL, NULL), "argument box is NULL");
  REFUSED(lanescape_make_start(model, particles, NAN, 1, species, positions, box, NULL), "nan");
  OK(lanescape_model_destroy(model));
}

int main(void) {
  lanescape_model* model = named_model("lennard-jones");
  OK(lanescape_make_start(model, particles, 0.8, 1, species, positions, box, NULL));
  lanescape_potential* potential = NULL;
  OK(lanescape_potential_create(model, particles, species, box, NULL, &potential));
  OK(lanescape_model_destroy(model));
  energy_is_conserved_and_states_come_back(potential);
  a_spring_swings();
  hard_spheres_collide();
  end_points_are_made();
  return failures != 0;
}
