#pragma once

#include <array>
#include <optional>

#include "interaction/pair/probe_field.hpp"

namespace lanescape {

// The shape of a region of low energy around a point ([U] VI.A, Eqs. 9 to 13). R is the distance, in a given direction, at which
// the energy first rises above a given value. Means are over all directions.
struct Hole {
  double mean_radius = 0.0;      // <R> [sigma]
  double mean_square = 0.0;      // <R^2> [sigma^2]
  double anisotropy = 0.0;       // <R^2>/<R>^2 - 1
  double eccentricity = 0.0;     // of the prolate ellipsoid with semi-axes a, a, b that has both means
  double semi_minor = 0.0;       // a [sigma]
  double semi_major = 0.0;       // b [sigma]
  double open_directions = 0.0;  // share of directions without such a rise; R is largest_hole_radius there
};

inline constexpr double largest_hole_radius = 3.0;  // [ProbeField::length_unit()]

// Returns nothing if the energy at the point is not below `iso_energy` [epsilon].
std::optional<Hole> measure_hole(const ProbeField& fluid, const std::array<double, 3>& point, double iso_energy);

// Computes eccentricity and semi-axes from both means: <R> = a asin(e)/e and <R^2> = a^2 atanh(e)/e.
void fit_prolate(Hole& hole);

}  // namespace lanescape
