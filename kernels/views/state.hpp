#pragma once

#include <cstddef>
#include <cstdint>

#include "views/pair.hpp"

namespace lanescape::kernels {

// Interactions that follow the states of sites, over neighbour lists whose points carry what a pass needs of a neighbour in their
// fourth number.

// A cubic spline on intervals of equal width: interval k is the record of point_width doubles {b, c, d, a}, 32-byte aligned, of
// a + s (b + s (c + s d)) with s from 0 to 1. One more record, of zeros, follows the last.
struct CubicSpline {
  const double* records;
  double per_unit;   // intervals per unit of the argument
  double intervals;  // their number
};

// w(r) as a spline in r^2; its derivative is the spline's.
struct SwitchingSpline {
  CubicSpline spline;
  double cutoff_squared;  // zero from here on [sigma^2]
};

struct StateDensityInput {
  NeighbourRows list;
  SwitchingSpline switching;  // of the rows' species
  const double* filter;       // c(rows' species, each species)
  // A list of what is near now is made on the way, for the passes that follow: lists hold a skin that is not.
  const double* reaches_squared;  // how far each species is near [sigma^2]
  std::uint32_t* near;            // room for as many as `list` has, padding included
  std::uint32_t* near_lengths;
  double* near_slopes;  // w'(r)/r of the rows' species for each place in `near`; 0 beyond the cutoff
};

struct StateDensityForceInput {
  NeighbourRows list;                 // fourth number of a point: dU/drho of its site
  SwitchingSpline switching;          // of the rows' species
  const SwitchingSpline* switchings;  // of each species
  const double* filter;               // c(rows' species, each species)
  const double* filter_back;          // c(each species, rows' species)
  const double* slopes;               // w'(r)/r of the rows' species for each neighbour
};

// The states of the rows and their neighbours. Where there are two, the fourth number of a point is the probability of the first.
struct StateProbabilities {
  std::size_t states;
  const double* rows;        // row_count x states
  const double* points;      // from three states on: records of point_width at the points' places, the first four states,
  std::size_t group_stride;  // and so many doubles further the next four; probabilities of states there are not are zero
};

// u_ab(r) = c12 r^-12 - c6 r^-6 - shift.
struct StateLjPair {
  double c12, c6, shift;
};

struct StateLjInput {
  NeighbourRows list;
  StateProbabilities probabilities;
  const StateLjPair* pairs;       // species x states of a row x states of a neighbour: the rows' species with each
  const double* cutoffs_squared;  // with each species; 0: these do not interact this way
};

// u_ab(r) of one pair of species as splines in r - origin on the same intervals, which a record for each pair of states makes up.
struct StateTable {
  CubicSpline spline;     // interval x states of a row x states of a neighbour
  double origin;          // at most 0 [sigma]
  double cutoff_squared;  // 0: these do not interact this way
};

struct StateTableInput {
  NeighbourRows list;
  StateProbabilities probabilities;
  const StateTable* tables;  // the rows' species with each
};

}  // namespace lanescape::kernels
