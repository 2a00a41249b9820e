#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>

#include "reference/lennard_jones.hpp"

/// What a particle that is not there would feel, and USHER's search for a place where that has a given value: PHYSICS 7, from
/// Delgado-Buscalioni and Coveney, doi 10.1063/1.1579475 ([U]).
namespace lanescape::reference {

struct Probe {
  double energy = 0.0;               // [epsilon]
  std::array<double, 3> gradient{};  // [epsilon/sigma]
  // The same sums with every term taken absolute.
  double magnitude = 0.0;
  std::array<double, 3> gradient_magnitude{};
};

/// A particle of species `species_of_probe` at `position` beside the particles of a periodic box. The energy is what the fluid's
/// would rise by: the full sum over all particles and their images within the cutoff, half of the probe's own images, and with
/// Truncation::tail what the long-range correction grows by. All images, whatever the box. Arguments as in lennard_jones().
Probe probe(const std::array<double, 3>& position, int species_of_probe, std::span<const double> positions,
            std::span<const int> species, const std::array<double, 3>& box, const Mixture& mixture, Truncation truncation);

/// Whether no particle, nor any of its images, is nearer to `position` than the clearance of its species [sigma].
bool is_clear(const std::array<double, 3>& position, std::span<const double> clearances, std::span<const double> positions,
              std::span<const int> species, const std::array<double, 3>& box);

/// One step of USHER (Eqs. 5 and 6) from where a probe has `energy` and `gradient` towards energy `target`.
struct UsherRule {
  double target;                // U0 [epsilon]
  double largest_step;          // ds_max [sigma]
  double overlap_energy = 1e4;  // U_ov [epsilon]
  double contact = 0.9;         // r_sigma [sigma]
};
std::array<double, 3> usher_step(const UsherRule& rule, double energy, const std::array<double, 3>& gradient);

/// One trial of direct USHER from `start`: ends where |U - U0| <= tolerance, at the first uphill move, or after `most` evaluations.
struct UsherTrial {
  bool found = false;
  std::array<double, 3> position{};
  double energy = 0.0;
  std::size_t evaluations = 0;
};
UsherTrial usher_trial(const UsherRule& rule, double tolerance, std::size_t most, const std::array<double, 3>& start,
                       const std::function<Probe(const std::array<double, 3>&)>& evaluate);

}  // namespace lanescape::reference
