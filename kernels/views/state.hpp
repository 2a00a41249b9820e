#pragma once

#include <cstddef>
#include <cstdint>

#include "views/pair.hpp"

namespace lanescape::kernels {

// Interactions that depend on the states of sites, over neighbour lists. The fourth number of a point holds what a pass needs to
// know about a neighbour.

// A cubic spline on intervals of equal width. Interval k is the record of point_width doubles {b, c, d, a}, 32-byte aligned, for a
// + s (b + s (c + s d)) with s from 0 to 1. One record of zeros follows the last.
struct CubicSpline {
  const double* records;
  double per_unit;   // intervals per unit of the argument
  double intervals;  // their number
};

// w(r) as a spline in r^2; its derivative is that of the spline.
struct SwitchingSpline {
  CubicSpline spline;
  double cutoff_squared;  // w is zero from here on [sigma^2]
};

struct StateDensityInput {
  NeighbourRows list;
  SwitchingSpline switching;  // of the rows' species
  const double* filter;       // c(rows' species, each species)
  // The pass also builds a list of the neighbours within reach now, for the later passes: the input list has a skin, this one has
  // none.
  const double* reaches_squared;  // reach of each species, squared [sigma^2]
  std::uint32_t* near;            // room for as many entries as `list` has, padding included
  std::uint32_t* near_lengths;
  double* near_slopes;  // w'(r)/r of the rows' species for each entry of `near`; 0 beyond the cutoff
};

struct StateDensityForceInput {
  NeighbourRows list;                 // fourth number of a point: dU/drho of its site
  SwitchingSpline switching;          // of the rows' species
  const SwitchingSpline* switchings;  // of each species
  const double* filter;               // c(rows' species, each species)
  const double* filter_back;          // c(each species, rows' species)
  const double* slopes;               // w'(r)/r of the rows' species for each neighbour
};

// The states of the rows and their neighbours. With two states, the fourth number of a point is the probability of the first.
struct StateProbabilities {
  std::size_t states;
  const double* rows;        // row_count x states
  const double* points;      // three or more states: records of point_width at the points' offsets hold the first four states,
  std::size_t group_stride;  // and records this many doubles later the next four; probabilities of missing states are zero
};

// u_ab(r) = c12 r^-12 - c6 r^-6 - shift.
struct StateLjPair {
  double c12, c6, shift;
};

struct StateLjInput {
  NeighbourRows list;
  StateProbabilities probabilities;
  const StateLjPair* pairs;       // species x states of a row x states of a neighbour: the rows' species with each
  const double* cutoffs_squared;  // with each species; 0: no interaction of this kind
};

// u_ab(r) of one pair of species as splines in r - origin on common intervals; each interval has a record per pair of states.
struct StateTable {
  CubicSpline spline;     // interval x states of a row x states of a neighbour
  double origin;          // at most 0 [sigma]
  double cutoff_squared;  // 0: no interaction of this kind
};

struct StateTableInput {
  NeighbourRows list;
  StateProbabilities probabilities;
  const StateTable* tables;  // the rows' species with each
};

}  // namespace lanescape::kernels
