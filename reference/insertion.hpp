#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "reference/pair_sum.hpp"

/// The energy of a particle put into a fluid, and USHER's search for a position where it has a given value: PHYSICS 7, from
/// Delgado-Buscalioni and Coveney, doi 10.1063/1.1579475 ([U]).
namespace lanescape::reference {

struct Probe {
  double energy = 0.0;  // [epsilon]
  Vector gradient{};    // [epsilon/sigma]
  // What rounding scales with: the same sums with every term taken absolute.
  double magnitude = 0.0;
  Vector gradient_magnitude{};
};

/// A particle that is added to a fluid.
struct Probed {
  Vector position{};  // [sigma]
  int species = 0;
  double diameter = 1.0;  // [sigma], for the polydisperse form
};

/// What the probe feels beside the particles of a box. The energy is the amount by which that of the fluid would rise: the
/// full sum over all particles and their images within the cutoff, half of the probe's own images, and with Truncation::tail the
/// growth of the long-range correction. All images count, whatever the box. Throws as pair_sum() does.
Probe probe(const Probed& probed, const Particles& fluid, const PairMixture& mixture);

/// Whether all particles and their images are at least the clearance of their species from `position` [sigma].
bool is_clear(const Vector& position, std::span<const double> clearances, std::span<const double> positions,
              std::span<const int> species, const Vector& box, const Periodic& periodic = all_periodic);

/// One step of USHER (Eqs. 5 and 6) from where a probe has `energy` and `gradient` towards energy `target`.
struct UsherRule {
  double target;                // U0 [epsilon]
  double largest_step;          // ds_max [sigma]
  double overlap_energy = 1e4;  // U_ov [epsilon]
  double contact = 0.9;         // r_sigma [sigma]
};
Vector usher_step(const UsherRule& rule, double energy, const Vector& gradient);

/// One trial of direct USHER from `start`. It ends when |U - U0| <= tolerance, at the first uphill move, or after `most`
/// evaluations.
struct UsherTrial {
  bool found = false;
  Vector position{};
  double energy = 0.0;
  std::size_t evaluations = 0;
};
UsherTrial usher_trial(const UsherRule& rule, double tolerance, std::size_t most, const Vector& start,
                       const std::function<Probe(const Vector&)>& evaluate);

}  // namespace lanescape::reference
