#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "configuration/mixture.hpp"

namespace lanescape {

// A mixture whose sites are in states, each with a probability that follows the site's local density (ultra-coarse-graining, [P]):
//   rho_i = sum_j c(s_i, s_j) w_{s_i}(r_ij),  U = 1/2 sum_ij sum_ab p_ia p_jb u_ab(r_ij) + sum_i sum_a (mu_a p_ia + T p_ia ln
//   p_ia).
// All periodic images within the cutoffs count.
struct StateMixtureModel : Mixture {
  // w(r) = (1 - tanh((r - threshold) / width)) / 2, tapered to zero from 0.8 cutoff to cutoff [sigma].
  struct Switching {
    double threshold = 1.5, width = 0.15, cutoff = 2.5;
  };
  // A site is in state a if its density is above the a-th threshold and below all before: p_0 = (1 + tanh((rho - threshold) /
  // width)) / 2 and so on.
  struct Step {
    double threshold, width;
  };
  // The states of a species: one more than it has steps.
  struct States {
    Switching switching;
    std::vector<Step> steps;
    std::vector<double> mu;  // of each state [epsilon]
  };
  struct LennardJones {
    double epsilon, sigma;  // cut and shifted at `cutoff` [epsilon], [sigma]
    bool operator==(const LennardJones&) const = default;
  };
  struct Table {
    double first, last;          // distances of the first and the last value [sigma]
    std::vector<double> values;  // at equal distances [epsilon]
    bool operator==(const Table&) const = default;
  };
  using Potential = std::variant<LennardJones, Table>;

  std::vector<States> states;         // of each species
  std::vector<double> filter;         // c: species x species, of the first with the second
  std::vector<Potential> potentials;  // see potential_at()
  double entropy_temperature = 0.0;   // k_B T of the term p ln p [epsilon]
  double cutoff = 2.5;                // of Lennard-Jones potentials [sigma]

  std::size_t pair(std::size_t s, std::size_t t) const { return s * species.size() + t; }
  std::size_t states_of(std::size_t s) const { return states[s].steps.size() + 1; }
  std::size_t most_states() const;
  // State a of species s with state b of species t; the stride is most_states(), so some entries stay unused.
  std::size_t potential_at(std::size_t s, std::size_t a, std::size_t t, std::size_t b) const {
    return (pair(s, t) * most_states() + a) * most_states() + b;
  }
  // The size of a pair, a distance that two sites hardly go below: the smallest sigma, or first distance of a table, of their
  // states.
  double size_of(std::size_t s, std::size_t t) const;
  // The distance up to which two sites of these species interact [sigma].
  double reach(std::size_t s, std::size_t t) const;
  // The largest sigma; without any, the longest reach over 2.5 [sigma].
  double largest_size() const;
  // The unit of length for its sites [sigma].
  double length_unit() const;
  // The same model with lengths in another unit.
  StateMixtureModel in_unit(double unit) const;
  // Where a potential ends: a table at its last distance, Lennard-Jones at `cutoff` [sigma].
  static double end_of(const Potential& potential, double cutoff);

  // Throws Error(bad_input) unless sizes match, potentials are symmetric and every number is finite and in range.
  void check() const;
};

// One component of two states, dense and dilute, whose potentials differ: written Ar. The dense state attracts more
// strongly.
StateMixtureModel liquid_vapour();

}  // namespace lanescape
