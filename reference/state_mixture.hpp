#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "reference/vector.hpp"

/// Interactions whose strength follows the states of the sites: each site is in state a with a probability p_a that depends on its
/// surroundings ([P]). Scalar, written from the formulas, in two forms: three passes over pairs, and the nested one that the three
/// passes replace.
///
///   rho_i = sum over neighbours j of c(s_i, s_j) w_{s_i}(r_ij),   p_ia = p_a(s_i, rho_i)
///   U = 1/2 sum_i sum_j sum_ab p_ia p_jb u_ab(r_ij) + sum_i sum_a (mu_a p_ia + T p_ia ln p_ia)
namespace lanescape::reference {

/// A function of a distance and its derivative.
struct Radial {
  double value = 0.0, slope = 0.0;
};
using RadialFunction = std::function<Radial(double r)>;

/// Of one site: p_a, dp_a/drho and ln p_a, one of each per state.
struct StateProbability {
  double p = 0.0, slope = 0.0, logarithm = 0.0;
};
using ProbabilityFunction = std::function<void(double density, std::span<StateProbability> states)>;

struct StateSystem {
  std::size_t species = 1, states = 1;
  std::vector<ProbabilityFunction> probabilities;  // of each species
  std::vector<RadialFunction> switching;           // w_s of each species
  std::vector<double> switching_cutoff;            // [sigma]
  std::vector<double> filter;                      // c: species x species, of the first with the second
  std::vector<RadialFunction> potential;           // u: see potential_at()
  std::vector<double> potential_cutoff;            // species x species, symmetric [sigma]
  std::vector<double> mu;                          // species x states [epsilon]
  double entropy_temperature = 0.0;                // k_B T of the term p ln p, an input; 0: there is none [epsilon]

  /// State a of species s with state b of species t; u_ab of (s, t) must be u_ba of (t, s).
  std::size_t potential_at(std::size_t s, std::size_t a, std::size_t t, std::size_t b) const {
    return ((s * species + t) * states + a) * states + b;
  }
};

/// Another site, or an image, near one: r_i - r_j - shift separates them.
struct StateNeighbour {
  std::size_t site = 0;
  Vector shift{};  // whole boxes [sigma]
};
/// All neighbours of each site: each pair from both ends, a site's own images with it.
using StateNeighbours = std::vector<std::vector<StateNeighbour>>;

struct StateEvaluation {
  double energy = 0.0;           // all of U [epsilon]
  double one_body_energy = 0.0;  // the part of it that is no pair's
  double virial = 0.0;           // sum over pairs of r.f; the trace of the tensor
  std::array<double, 6> virial_tensor{};
  std::vector<double> gradient;       // 3N, +dU/dr
  std::vector<double> densities;      // N
  std::vector<double> probabilities;  // N x states
  // What rounding scales with: the same sums of absolute terms.
  double magnitude = 0.0;
  std::vector<double> gradient_magnitude;  // N
};

/// Every neighbour within `reach`, through every image. O(N^2).
StateNeighbours all_neighbours(std::span<const double> positions, const Vector& box, double reach);

/// Three passes: densities; energy, forces at fixed p and dU/dp; forces by way of the densities. Lists may hold what is out of
/// range. positions: 3N, interleaved [sigma]; species: N. Throws std::invalid_argument where sizes do not fit.
StateEvaluation three_passes(std::span<const double> positions, std::span<const int> species, const StateSystem& system,
                             const StateNeighbours& neighbours);

/// The same by the chain rule carried through pair by pair ([P], Eq. 4 multiplied out): every site visits the neighbours of its
/// neighbours. O(N n^2) for n neighbours.
StateEvaluation nested(std::span<const double> positions, std::span<const int> species, const StateSystem& system,
                       const StateNeighbours& neighbours);

// Forms in use.

/// w(r) = (1 - tanh((r - threshold) / width)) / 2, taken to zero between 0.8 cutoff and cutoff by a polynomial with two continuous
/// derivatives, 1 - 10 s^3 + 15 s^4 - 6 s^5.
RadialFunction tapered_switch(double threshold, double width, double cutoff);

/// A cascade of tanh: state 0 above the first threshold, else state 1 above the second, ..., else the last. With one threshold this
/// is [P]'s p_0 = (1 + tanh((rho - threshold) / width)) / 2, p_1 = 1 - p_0.
ProbabilityFunction tanh_cascade(std::vector<double> thresholds, std::vector<double> widths);

/// 4 epsilon ((sigma/r)^12 - (sigma/r)^6) less its value at the cutoff.
RadialFunction shifted_lennard_jones(double epsilon, double sigma, double cutoff);

}  // namespace lanescape::reference
