#pragma once

// The part of the C interface that makes configurations and moves them; lanescape.h includes it.

#include <lanescape/lanescape.h>

#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

// A lattice at a number density, of hard spheres at a packing fraction; species at random in the model's proportions. Writes N
// species, 3N positions, 3 edges and, unless it is NULL, N diameters where the model has them or is made of hard spheres.
lanescape_status lanescape_make_start(const lanescape_model* model, size_t particles, double density, uint64_t seed, int* species,
                                      double* positions, double box[3], double* diameters);

// The protocol that makes end points: melt, cool, check the temperature, settle, and follow the trajectory over a distance; hard
// spheres: equilibrate and follow. Counts are steps, or collisions of hard spheres; 0 stands for the library's own.
typedef struct lanescape_end_point_settings {
  size_t size;
  double temperature;           // of soft models, 1
  double distance;              // 0: 108 at N = 108, else 10 sqrt(N), in the model's unit of length
  size_t pairs;                 // 1
  int quick;                    // shorter counts, 0
  uint64_t equilibration;       // of melting, cooling, checking and settling each, 0
  uint64_t between;             // from the end of one pair to the start of the next, 0
  uint64_t seed;                // 1
  int threads;                  // 1; no effect on any result
  const char* precision;        // double or mixed
  const char* instruction_set;  // auto, or a word of lanescape_instruction_set()
  lanescape_progress progress;  // or NULL
  void* progress_user;
} lanescape_end_point_settings;

lanescape_status lanescape_end_point_settings_init(lanescape_end_point_settings* settings, size_t size);
// diameters: of each particle, for models that have them, or NULL. LANESCAPE_GOAL_NOT_REACHED if the temperature does not hold or
// the distance is not reached, LANESCAPE_INTERRUPTED if `progress` ends the work.
lanescape_status lanescape_make_end_points(const lanescape_model* model, size_t particles, const int* species,
                                           const double* positions, const double box[3], const double* diameters,
                                           const lanescape_end_point_settings* settings, lanescape_end_points** ends);
lanescape_status lanescape_end_points_count(const lanescape_end_points* ends, size_t* pairs);
// One pair: 3N unwrapped positions of each end, their distance in 3N space, steps or collisions and time between them. What is NULL
// is not written.
lanescape_status lanescape_end_points_get(const lanescape_end_points* ends, size_t pair, double* start, double* finish,
                                          double* distance, uint64_t* steps, double* time);
lanescape_status lanescape_end_points_destroy(lanescape_end_points* ends);

// Molecular dynamics: Newton's equations by the velocity Verlet algorithm (doi 10.1063/1.442716).
typedef struct lanescape_dynamics_report {
  size_t size;
  uint64_t steps;
  double temperature;  // 2 K / (3 N)
  double kinetic_energy, potential_energy;
} lanescape_dynamics_report;

// Starts at rest. masses: of each particle, or NULL for 1. Shares the potential with the caller.
lanescape_status lanescape_dynamics_create(lanescape_potential* potential, const double* masses, const double* positions,
                                           double time_step, lanescape_dynamics** dynamics);
lanescape_status lanescape_dynamics_create_on(const lanescape_landscape* landscape, const double* masses, const double* positions,
                                              double time_step, lanescape_dynamics** dynamics);
// From Maxwell's distribution without total momentum, scaled so that K = (3/2) N T.
lanescape_status lanescape_dynamics_draw_velocities(lanescape_dynamics* dynamics, double temperature, uint64_t seed);
lanescape_status lanescape_dynamics_set_velocities(lanescape_dynamics* dynamics, const double* velocities);
lanescape_status lanescape_dynamics_run(lanescape_dynamics* dynamics, uint64_t steps);
lanescape_status lanescape_dynamics_describe(lanescape_dynamics* dynamics, lanescape_dynamics_report* report);
// 3N each, unwrapped positions; what is NULL is not written.
lanescape_status lanescape_dynamics_get(const lanescape_dynamics* dynamics, double* positions, double* velocities);
// The state as bytes, and back. Writes up to `capacity` bytes and to `needed` how many there are. capacity 0: `state` may be NULL.
lanescape_status lanescape_dynamics_save(const lanescape_dynamics* dynamics, void* state, size_t capacity, size_t* needed);
lanescape_status lanescape_dynamics_restore(lanescape_dynamics* dynamics, const void* state, size_t bytes);
lanescape_status lanescape_dynamics_destroy(lanescape_dynamics* dynamics);

// Event-driven dynamics of hard spheres. Time in sigma sqrt(m / k_B T), with T = 1.
typedef struct lanescape_event_driven_report {
  size_t size;
  uint64_t collisions;
  double time, kinetic_energy;
  double compressibility;  // p V / (N k_B T) since the start; not a number before any time has passed
} lanescape_event_driven_report;

// masses: of each particle, or NULL for 1. instruction_set may be NULL for auto. Spheres must not overlap by more than rounding,
// 1e-12 of their distance at contact; edges are at least 2.05 of the largest diameter.
lanescape_status lanescape_event_driven_create(size_t particles, const double* radii, const double* masses, const double* positions,
                                               const double box[3], const char* instruction_set, lanescape_event_driven** dynamics);
lanescape_status lanescape_event_driven_draw_velocities(lanescape_event_driven* dynamics, uint64_t seed);
lanescape_status lanescape_event_driven_set_velocities(lanescape_event_driven* dynamics, const double* velocities);
// LANESCAPE_GOAL_NOT_REACHED if ten million events pass without a collision, as when spheres fly side by side.
lanescape_status lanescape_event_driven_collide(lanescape_event_driven* dynamics, uint64_t collisions);
lanescape_status lanescape_event_driven_advance_to(lanescape_event_driven* dynamics, double time);
lanescape_status lanescape_event_driven_describe(const lanescape_event_driven* dynamics, lanescape_event_driven_report* report);
lanescape_status lanescape_event_driven_get(const lanescape_event_driven* dynamics, double* positions, double* velocities);
// As for molecular dynamics. All spheres are brought to one time first, so that the state is the same in both calls of a caller who
// asks for the size first.
lanescape_status lanescape_event_driven_save(lanescape_event_driven* dynamics, void* state, size_t capacity, size_t* needed);
lanescape_status lanescape_event_driven_restore(lanescape_event_driven* dynamics, const void* state, size_t bytes);
lanescape_status lanescape_event_driven_destroy(lanescape_event_driven* dynamics);

#ifdef __cplusplus
}
#endif
#ifdef __GNUC__
#pragma GCC visibility pop
#endif
