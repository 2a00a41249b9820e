#pragma once

// The part of the C interface that makes paths as short as they can be, and checks any path; lanescape.h includes it.

#include <lanescape/lanescape.h>

#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

// A word for the method of shortening; NULL for an index beyond the last.
const char* lanescape_shorten_method(size_t index);

typedef struct lanescape_shorten_settings {
  size_t size;
  const char* method;  // a word of lanescape_shorten_method(); NULL: the first
  uint64_t starts;     // independent runs with other random numbers, of which the shortest path is kept, 1
  uint64_t seed;       // 1
  // How the path to start from and those in between are found, with the threads, precision, instruction set and landscape energy of
  // all of it; NULL: the defaults. Its frames have no effect, and its reverse must be 0. Its progress is called with the number of
  // iterations or trials made so far, 0 while the path to start from is found.
  const lanescape_path_settings* search;
} lanescape_shorten_settings;

typedef struct lanescape_short_path_summary {
  size_t size;
  const char* outcome;  // reached where the method ended by its own rule; step_limit, stalled, interrupted; valid while the path is
  const char* reason;   // why it is not reached; likewise
  double length_before;         // in 3N space, of mass-weighted coordinates where masses differ
  double length;                // of the shortest path, 0 where there was none to start from
  double distance;              // of its ends
  double ratio_squared;         // (distance / length)^2, 0 without a path
  double landscape_energy;      // E_L of soft models
  double largest_violation;     // largest V - E_L along it, or deepest overlap; at least 0
  double kuhn_tucker_residual;  // as in lanescape_path_certificate; not a number where the frames are only some points of the path
  uint64_t evaluations;         // that found the path, not those of trials that failed
  double seconds;
  size_t particles, frames, starts;  // frames: ends included, 0 without a path; starts: 0 likewise
  int reached;
  int has_multipliers;  // where there is a residual
} lanescape_short_path_summary;

lanescape_status lanescape_shorten_settings_init(lanescape_shorten_settings* settings, size_t size);
// Shortens a path between two configurations of a model: that through `frames` configurations, 3N numbers each one after the other,
// or the one that the search finds, with 0 and NULL. At least three frames, which begin and end at the two ends in either order and
// are allowed. Other arguments as for lanescape_find_path(); settings may be NULL.
lanescape_status lanescape_shorten_path(const lanescape_model* model, size_t particles, const int* species, const double box[3],
                                        const double* start, const double* finish, const double* diameters, size_t frames,
                                        const double* positions, const lanescape_shorten_settings* settings,
                                        lanescape_short_path** path);
// On a landscape of the caller's own, on one thread. masses: of each particle, or NULL for equal ones.
lanescape_status lanescape_shorten_path_on(const lanescape_landscape* landscape, const double* start, const double* finish,
                                           const double* masses, size_t frames, const double* positions,
                                           const lanescape_shorten_settings* settings, lanescape_short_path** path);
lanescape_status lanescape_short_path_summarise(const lanescape_short_path* path, lanescape_short_path_summary* summary);
// Copies the 3N numbers of one frame.
lanescape_status lanescape_short_path_frame(const lanescape_short_path* path, size_t frame, double* positions);
// Copies the multiplier of each frame, where there are multipliers, and the length that each start found. What is NULL is not
// written.
lanescape_status lanescape_short_path_values(const lanescape_short_path* path, double* multipliers, double* start_lengths);
lanescape_status lanescape_short_path_destroy(lanescape_short_path* path);

typedef struct lanescape_check_settings {
  size_t size;
  const double* landscape_energy;  // E_L; NULL: the higher of the two ends
  int threads;                     // 1; no effect on any result
  const char* instruction_set;     // auto, or a word of lanescape_instruction_set()
} lanescape_check_settings;

// How far a path of straight segments leaves the allowed region, and how far it is from the Kuhn-Tucker condition of a shortest
// one. A small residual shows that it is stationary, not that no other is shorter. Arrays are the caller's; NULL is not written.
typedef struct lanescape_path_certificate {
  size_t size;
  double length;             // in 3N space, of mass-weighted coordinates where masses differ
  double distance;           // of its ends, likewise
  double ratio_squared;      // (distance / length)^2
  double landscape_energy;   // E_L of soft models
  double largest_violation;  // of V - E_L, or of overlaps, over frames and segments; at least 0
  // max_k |tau_k - lambda_k n_k| / max_k |tau_k| over the bends tau_k of the path; 0 for a path that is straight up to rounding.
  double kuhn_tucker_residual;
  double* multipliers;        // lambda_k >= 0 of each frame; of hard spheres the sum over contacts
  double* excess;             // of each frame: V - E_L; of hard spheres the smallest gap, infinity for a single one
  double* segment_violation;  // of each segment, frames - 1: the largest V - E_L; of hard spheres minus the smallest gap
} lanescape_path_certificate;

lanescape_status lanescape_check_settings_init(lanescape_check_settings* settings, size_t size);
// Of a path of a model, at least three frames, 3N numbers each one after the other, unwrapped; no two neighbouring ones are the
// same. settings may be NULL.
lanescape_status lanescape_check_path(const lanescape_model* model, size_t particles, const int* species, const double box[3],
                                      const double* diameters, size_t frames, const double* positions,
                                      const lanescape_check_settings* settings, lanescape_path_certificate* certificate);
// On a landscape of the caller's own, on one thread. masses: of each particle, or NULL for equal ones.
lanescape_status lanescape_check_path_on(const lanescape_landscape* landscape, const double* masses, size_t frames,
                                         const double* positions, const lanescape_check_settings* settings,
                                         lanescape_path_certificate* certificate);

#ifdef __cplusplus
}
#endif
#ifdef __GNUC__
#pragma GCC visibility pop
#endif
