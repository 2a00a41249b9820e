#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "reference/vector.hpp"

/// Sites in states: each site is in state a with a probability p_a that depends on its local density, and pair potentials depend on
/// the states ([P]). Scalar, written from the formulas, in two ways: three passes over pairs, and nested sums over neighbours of
/// neighbours, which the three passes replace.
///
///   rho_i = sum over neighbours j of c(s_i, s_j) w_{s_i}(r_ij),   p_ia = p_a(s_i, rho_i)
///   U = 1/2 sum_i sum_j sum_ab p_ia p_jb u_ab(r_ij) + sum_i sum_a (mu_a p_ia + T p_ia ln p_ia)
namespace lanescape::reference {

/// A function of a distance and its derivative.
struct Radial {
  double value = 0.0, slope = 0.0;
};
using RadialFunction = std::function<Radial(double r)>;

/// p_a, dp_a/drho and ln p_a of one state of a site.
struct StateProbability {
  double p = 0.0, slope = 0.0, logarithm = 0.0;
};
using ProbabilityFunction = std::function<void(double density, std::span<StateProbability> states)>;

struct StateSystem {
  std::size_t species = 1, states = 1;
  std::vector<ProbabilityFunction> probabilities;  // one for each species
  std::vector<RadialFunction> switching;           // w_s of each species
  std::vector<double> switching_cutoff;            // [sigma]
  std::vector<double> filter;                      // c: species x species, row: the site that has the density
  std::vector<RadialFunction> potential;           // u: see potential_at()
  std::vector<double> potential_cutoff;            // species x species, symmetric [sigma]
  std::vector<double> mu;                          // species x states [epsilon]
  double entropy_temperature = 0.0;                // k_B T of the term p ln p, an input; 0 for no such term [epsilon]

  /// Index of u_ab for state a of species s and state b of species t; u_ab of (s, t) must equal u_ba of (t, s).
  std::size_t potential_at(std::size_t s, std::size_t a, std::size_t t, std::size_t b) const {
    return ((s * species + t) * states + a) * states + b;
  }
};

/// A neighbour j of a site i, or an image of it; the separation is r_i - r_j - shift.
struct StateNeighbour {
  std::size_t site = 0;
  Vector shift{};  // whole boxes [sigma]
};
/// The neighbours of each site. A pair appears twice, once for each site. A site's own images are neighbours of it.
using StateNeighbours = std::vector<std::vector<StateNeighbour>>;

struct StateEvaluation {
  double energy = 0.0;           // all of U [epsilon]
  double one_body_energy = 0.0;  // the sum of mu p + T p ln p, a part of `energy`
  double virial = 0.0;           // sum over pairs of r.f; the trace of the tensor
  std::array<double, 6> virial_tensor{};
  std::vector<double> gradient;       // 3N, +dU/dr
  std::vector<double> densities;      // N
  std::vector<double> probabilities;  // N x states
  // What rounding scales with: the same sums of absolute terms.
  double magnitude = 0.0;
  std::vector<double> gradient_magnitude;  // N
};

/// All neighbours within `reach`, images included. O(N^2).
StateNeighbours all_neighbours(std::span<const double> positions, const Vector& box, double reach);

/// Three passes: densities; energy, forces at fixed p and dU/dp; forces through the densities. Lists may hold neighbours out of
/// range. positions: 3N, interleaved [sigma]; species: N. Throws std::invalid_argument if sizes differ.
StateEvaluation three_passes(std::span<const double> positions, std::span<const int> species, const StateSystem& system,
                             const StateNeighbours& neighbours);

/// The same with the chain rule applied to each pair ([P] Eq. 4, expanded): each site visits the neighbours of its neighbours.
/// O(N n^2) for n neighbours.
StateEvaluation nested(std::span<const double> positions, std::span<const int> species, const StateSystem& system,
                       const StateNeighbours& neighbours);

// Functions in use.

/// w(r) = (1 - tanh((r - threshold) / width)) / 2, times 1 - 10 s^3 + 15 s^4 - 6 s^5 between 0.8 cutoff and cutoff, which has two
/// continuous derivatives.
RadialFunction tapered_switch(double threshold, double width, double cutoff);

/// A cascade of tanh: state 0 above the first threshold, else state 1 above the second, ..., else the last state. One threshold
/// gives p_0 = (1 + tanh((rho - threshold) / width)) / 2, p_1 = 1 - p_0, the form of [UCG].
ProbabilityFunction tanh_cascade(std::vector<double> thresholds, std::vector<double> widths);

/// 4 epsilon ((sigma/r)^12 - (sigma/r)^6) minus its value at the cutoff.
RadialFunction shifted_lennard_jones(double epsilon, double sigma, double cutoff);

}  // namespace lanescape::reference
