#pragma once

// The part of the C interface for hosts that make neighbour lists; lanescape.h includes it.

#include <lanescape/lanescape.h>

#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

// A pair potential over neighbour lists that the caller makes, of points: particles, and ghosts, which are images of them or
// particles of other processes. There is no box: separations are plain differences. Lists hold all pairs within the cutoff.
typedef struct lanescape_listed_options {
  size_t size;
  // rows: all neighbours of each point with a list; the energy is half of each pair for each of its ends with a list, forces are
  // those on points with lists, complete. gradient: the same, and the forces that follow from this energy, on ghosts too. half:
  // each pair once, in the list of one of its points; forces are on both.
  const char* lists;
  const int* species_of;        // the model's species of each of the caller's, below 0: interacts with nothing; NULL: the same
  size_t species;               // of species_of
  int threads;                  // that share an evaluation, 1; no effect on any result
  const char* instruction_set;  // auto, or a word of lanescape_instruction_set()
} lanescape_listed_options;

typedef struct lanescape_lists {
  size_t size;
  size_t points;
  const int* species;            // of each point
  size_t rows;                   // points that have a list
  const int* row_points;         // which these are, from 0
  const int* const* neighbours;  // of point i: neighbours[i], lengths[i] of them; arrays of all points
  const int* lengths;
  unsigned mask;  // the bits of a neighbour that number a point; 0: all
} lanescape_lists;

// What is NULL is not computed.
typedef struct lanescape_listed_outputs {
  size_t size;
  double* energy;
  double* virial;         // sum over pairs of r.f
  double* virial_tensor;  // 6, sum over pairs of r_a f_b, xx yy zz yz xz xy
  double* forces;         // of each point, 3 numbers
  int add_to_forces;      // otherwise forces are overwritten, 0
  double* energies;       // of each point
} lanescape_listed_outputs;

lanescape_status lanescape_listed_options_init(lanescape_listed_options* options, size_t size);
// For pair potentials without diameters of particles and without truncation tail. options may be NULL.
lanescape_status lanescape_listed_potential_create(const lanescape_model* model, const lanescape_listed_options* options,
                                                   lanescape_listed_potential** potential);
// The distance beyond which two of the model's species do not interact.
lanescape_status lanescape_listed_potential_cutoff(const lanescape_listed_potential* potential, size_t a, size_t b, double* cutoff);
// For every new list. Nothing is kept of the arrays.
lanescape_status lanescape_listed_potential_set_lists(lanescape_listed_potential* potential, const lanescape_lists* lists);
// Positions of each point, 3 numbers.
lanescape_status lanescape_listed_potential_evaluate(lanescape_listed_potential* potential, const double* positions,
                                                     const lanescape_listed_outputs* outputs);
lanescape_status lanescape_listed_potential_destroy(lanescape_listed_potential* potential);

#ifdef __cplusplus
}
#endif
#ifdef __GNUC__
#pragma GCC visibility pop
#endif
