#pragma once

// The part of the C interface for sites in states of the caller's own making; lanescape.h includes it.

#include <lanescape/lanescape.h>

#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

// All pairs of sites within reach, once from each end; arrays are valid during the call.
typedef struct lanescape_site_pairs {
  size_t size;
  size_t count;
  const int64_t *first, *second;
  const double* separation;  // 3 of each pair: r_first - r_second, an image of it
} lanescape_site_pairs;

// One number per site on which its state depends, such as a local density, and the probabilities of its states as functions of this
// order parameter. Functions return 0, or a code that ends the call with LANESCAPE_CALLBACK_FAILED, and are called from the
// caller's thread.
typedef struct lanescape_state_functions {
  size_t size;
  void* user;     // passed to the functions
  size_t states;  // of a site, as many as the model's
  // The distance within which the order parameter looks at pairs of these species; called while the potential is made.
  int (*reach)(void* user, int first_species, int second_species, double* reach);
  // Writes the order parameter of each site.
  int (*evaluate)(void* user, const lanescape_site_pairs* pairs, size_t sites, const int* species, double* values);
  // Adds sum_k multipliers[k] d value[k]/dr_i to the gradient of each site, 3 of each, and writes to `virial` what that adds to
  // sum r_a f_b, xx yy zz yz xz xy.
  int (*add_gradient)(void* user, const lanescape_site_pairs* pairs, size_t sites, const int* species, const double* multipliers,
                      double* gradient, double* virial);
  // Writes 3 numbers of each state: its probability, the slope with respect to the order parameter, and the logarithm. The
  // probabilities add up to one.
  int (*respond)(void* user, int species, double value, double* states);
} lanescape_state_functions;

// As lanescape_potential_create(), for a model with states, with these functions in place of the model's order parameter and
// probabilities, on one thread.
lanescape_status lanescape_potential_create_with_states(const lanescape_model* model, size_t particles, const int* species,
                                                        const double box[3], const lanescape_potential_options* options,
                                                        const lanescape_state_functions* functions,
                                                        lanescape_potential** potential);

#ifdef __cplusplus
}
#endif
#ifdef __GNUC__
#pragma GCC visibility pop
#endif
