#include "reference/state_mixture.hpp"

#include <cmath>
#include <stdexcept>

#include "reference/images.hpp"
#include "reference/pair_potential.hpp"

namespace lanescape::reference {
namespace {

struct Site {
  std::size_t species;
  std::vector<StateProbability> states;
};

struct Pair {
  Vector d;  // r_i - r_j
  double r;
};

// The input, and the terms of a pair and of a site, for both ways of summing.
class Evaluator {
 public:
  Evaluator(std::span<const double> positions, std::span<const int> species, const StateSystem& system,
            const StateNeighbours& neighbours)
      : positions_(positions), system_(system), neighbours_(neighbours) {
    if (positions.size() != 3 * species.size() || neighbours.size() != species.size())
      throw std::invalid_argument("state mixture: three coordinates, a species and a list are needed for each site");
    const std::size_t s2 = system.species * system.species;
    if (system.filter.size() != s2 || system.potential_cutoff.size() != s2 || system.switching.size() != system.species ||
        system.switching_cutoff.size() != system.species || system.probabilities.size() != system.species ||
        system.potential.size() != s2 * system.states * system.states || system.mu.size() != system.species * system.states)
      throw std::invalid_argument("state mixture: parameters do not fit the numbers of species and states");
    for (const int s : species) {
      if (s < 0 || static_cast<std::size_t>(s) >= system.species) throw std::invalid_argument("state mixture: unknown species");
      sites_.push_back({static_cast<std::size_t>(s), std::vector<StateProbability>(system.states)});
    }
    sum_.gradient.assign(positions.size(), 0.0);
    sum_.gradient_magnitude.assign(species.size(), 0.0);
  }

  std::size_t size() const { return sites_.size(); }
  const std::vector<StateNeighbour>& neighbours(std::size_t i) const { return neighbours_[i]; }

  Pair pair(std::size_t i, const StateNeighbour& j) const {
    Vector d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = positions_[3 * i + k] - positions_[3 * j.site + k] - j.shift[k];
    return {d, std::sqrt(dot(d, d))};
  }

  // Pass 1.
  void find_states() {
    for (std::size_t i = 0; i < size(); ++i) {
      double density = 0.0;
      for (const StateNeighbour& j : neighbours_[i])
        density += filter(i, j.site) * switching(sites_[i].species, pair(i, j).r).value;
      system_.probabilities[sites_[i].species](density, sites_[i].states);
      sum_.densities.push_back(density);
      for (const StateProbability& state : sites_[i].states) sum_.probabilities.push_back(state.p);
    }
  }

  // A pair as seen from i, at fixed p: half its energy and the gradient of i.
  void add_pair_energy(std::size_t i, const StateNeighbour& j) {
    const Pair ij = pair(i, j);
    if (ij.r >= cutoff(i, j.site)) return;
    double slope = 0.0;
    for (std::size_t a = 0; a < system_.states; ++a)
      for (std::size_t b = 0; b < system_.states; ++b) {
        const double weight = sites_[i].states[a].p * sites_[j.site].states[b].p;
        const Radial u = potential(i, a, j.site, b)(ij.r);
        sum_.energy += 0.5 * weight * u.value;
        sum_.magnitude += 0.5 * std::abs(weight * u.value);
        slope += weight * u.slope;
      }
    add_force(i, ij, slope);
  }

  // mu p + T p ln p; p ln p is 0 if p is.
  void add_one_body_energy(std::size_t i) {
    for (std::size_t a = 0; a < system_.states; ++a) {
      const StateProbability& state = sites_[i].states[a];
      const double entropy = state.p > 0.0 ? system_.entropy_temperature * state.p * state.logarithm : 0.0;
      const double energy = mu(i, a) * state.p + entropy;
      sum_.one_body_energy += energy;
      sum_.magnitude += std::abs(energy);
    }
  }

  // lambda_i = sum_a dU/dp_ia dp_ia/drho_i, a sum over the neighbours of i.
  double multiplier(std::size_t i) const {
    double lambda = 0.0;
    for (std::size_t a = 0; a < system_.states; ++a) {
      const StateProbability& state = sites_[i].states[a];
      if (state.slope == 0.0) continue;  // saturated: ln p may be infinite
      double slope = mu(i, a) + system_.entropy_temperature * (state.logarithm + 1.0);
      for (const StateNeighbour& j : neighbours_[i]) {
        const double r = pair(i, j).r;
        if (r >= cutoff(i, j.site)) continue;
        for (std::size_t b = 0; b < system_.states; ++b) slope += sites_[j.site].states[b].p * potential(i, a, j.site, b)(r).value;
      }
      lambda += slope * state.slope;
    }
    return lambda;
  }

  // The gradient of i through the densities of i and j.
  void add_density_force(std::size_t i, const StateNeighbour& j, double lambda_i, double lambda_j) {
    const Pair ij = pair(i, j);
    add_force(i, ij,
              lambda_i * filter(i, j.site) * switching(sites_[i].species, ij.r).slope +
                  lambda_j * filter(j.site, i) * switching(sites_[j.site].species, ij.r).slope);
  }

  StateEvaluation result() {
    sum_.energy += sum_.one_body_energy;
    sum_.virial = sum_.virial_tensor[0] + sum_.virial_tensor[1] + sum_.virial_tensor[2];
    return std::move(sum_);
  }

 private:
  double filter(std::size_t i, std::size_t j) const {
    return system_.filter[sites_[i].species * system_.species + sites_[j].species];
  }
  double cutoff(std::size_t i, std::size_t j) const {
    return system_.potential_cutoff[sites_[i].species * system_.species + sites_[j].species];
  }
  double mu(std::size_t i, std::size_t a) const { return system_.mu[sites_[i].species * system_.states + a]; }
  const RadialFunction& potential(std::size_t i, std::size_t a, std::size_t j, std::size_t b) const {
    return system_.potential[system_.potential_at(sites_[i].species, a, sites_[j].species, b)];
  }
  Radial switching(std::size_t species, double r) const {
    return r < system_.switching_cutoff[species] ? system_.switching[species](r) : Radial{};
  }

  // A pair as seen from i: the gradient of i and half the virial.
  void add_force(std::size_t i, const Pair& ij, double slope) {
    const double over_r = slope / ij.r;
    for (std::size_t k = 0; k < 3; ++k) sum_.gradient[3 * i + k] += over_r * ij.d[k];
    sum_.gradient_magnitude[i] += std::abs(slope);
    constexpr std::size_t voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    for (std::size_t k = 0; k < 6; ++k) sum_.virial_tensor[k] -= 0.5 * over_r * ij.d[voigt[k][0]] * ij.d[voigt[k][1]];
  }

  std::span<const double> positions_;
  const StateSystem& system_;
  const StateNeighbours& neighbours_;
  std::vector<Site> sites_;
  StateEvaluation sum_;
};

}  // namespace

StateNeighbours all_neighbours(std::span<const double> positions, const Vector& box, double reach) {
  const std::size_t n = positions.size() / 3;
  StateNeighbours neighbours(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      Vector separation;
      for (std::size_t k = 0; k < 3; ++k) separation[k] = positions[3 * i + k] - positions[3 * j + k];
      for_each_image(separation, box, all_periodic, reach, ImageRule::all, [&](const Image& image) {
        if (i == j && image.nearest) return;
        if (dot(image.separation, image.separation) < reach * reach) neighbours[i].push_back({j, image.shift});
      });
    }
  return neighbours;
}

StateEvaluation three_passes(std::span<const double> positions, std::span<const int> species, const StateSystem& system,
                             const StateNeighbours& neighbours) {
  Evaluator e(positions, species, system, neighbours);
  e.find_states();
  std::vector<double> lambda;
  for (std::size_t i = 0; i < e.size(); ++i) {
    for (const StateNeighbour& j : e.neighbours(i)) e.add_pair_energy(i, j);
    e.add_one_body_energy(i);
    lambda.push_back(e.multiplier(i));
  }
  for (std::size_t i = 0; i < e.size(); ++i)
    for (const StateNeighbour& j : e.neighbours(i)) e.add_density_force(i, j, lambda[i], lambda[j.site]);
  return e.result();
}

StateEvaluation nested(std::span<const double> positions, std::span<const int> species, const StateSystem& system,
                       const StateNeighbours& neighbours) {
  Evaluator e(positions, species, system, neighbours);
  e.find_states();
  for (std::size_t i = 0; i < e.size(); ++i) {
    e.add_one_body_energy(i);
    const double own = e.multiplier(i);
    for (const StateNeighbour& j : e.neighbours(i)) {
      e.add_pair_energy(i, j);
      e.add_density_force(i, j, own, e.multiplier(j.site));
    }
  }
  return e.result();
}

RadialFunction tapered_switch(double threshold, double width, double cutoff) {
  return [=](double r) -> Radial {
    if (r >= cutoff) return {};
    const double t = std::tanh((r - threshold) / width);
    const Radial w{0.5 * (1.0 - t), -0.5 * (1.0 - t * t) / width};
    const double taper_width = 0.2 * cutoff, s = (r - 0.8 * cutoff) / taper_width;
    if (s <= 0.0) return w;
    const double taper = 1.0 - s * s * s * (10.0 - s * (15.0 - 6.0 * s));
    const double taper_slope = -30.0 * s * s * (1.0 - s) * (1.0 - s) / taper_width;
    return {w.value * taper, w.slope * taper + w.value * taper_slope};
  };
}

ProbabilityFunction tanh_cascade(std::vector<double> thresholds, std::vector<double> widths) {
  return [=](double density, std::span<StateProbability> states) {
    for (StateProbability& state : states) state = {};
    // The probability of all further states, its derivative and its logarithm.
    StateProbability rest{1.0, 0.0, 0.0};
    for (std::size_t a = 0; a < thresholds.size(); ++a) {
      const double x = (density - thresholds[a]) / widths[a];
      const double above = 1.0 / (1.0 + std::exp(-2.0 * x)), below = 1.0 / (1.0 + std::exp(2.0 * x));
      const double slope = 2.0 * above * below / widths[a];
      // ln above - ln below = 2 x, so no logarithm of zero is taken.
      const double log_above = x > 0.0 ? -std::log1p(std::exp(-2.0 * x)) : 2.0 * x - std::log1p(std::exp(2.0 * x));
      states[a] = {rest.p * above, rest.slope * above + rest.p * slope, rest.logarithm + log_above};
      rest = {rest.p * below, rest.slope * below - rest.p * slope, rest.logarithm + log_above - 2.0 * x};
    }
    states[thresholds.size()] = rest;
  };
}

RadialFunction shifted_lennard_jones(double epsilon, double sigma, double cutoff) {
  return [potential = PairPotential{LennardJones{epsilon, sigma}, cutoff, Truncation::shifted}](double r) -> Radial {
    const PairValue u = value(potential, r);
    return {u.u, u.slope};
  };
}

}  // namespace lanescape::reference
