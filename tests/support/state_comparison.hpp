#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "random_state_mixtures.hpp"
#include "reference/pair_potential.hpp"
#include "reference/state_mixture.hpp"
#include "verification/check.hpp"
#include "verification/state_mixture_checks.hpp"

namespace lanescape::testing {

// The magnitudes that rounding scales with in sites in states: the reference's three passes over functions that give the sums of
// absolute terms of those of the model, and the largest values next to a distance or density, as far as a derivative changes
// within a fiftieth of the reach. So terms that cancel, in lambda and at a cutoff, count in full.
class StateMagnitudes {
 public:
  explicit StateMagnitudes(const StateMixtureModel& model)
      : model_(model), system_(reference_system(model, SwitchingForm::spline)) {
    for (std::size_t s = 0; s < system_.species; ++s) {
      system_.switching[s] = largest_near(system_.switching[s], 0.02 * system_.switching_cutoff[s]);
      system_.probabilities[s] = absolute(system_.probabilities[s]);
    }
    for (double& mu : system_.mu) mu = std::abs(mu);
    // Of a pair at the end of a function one implementation may see what another does not.
    for (double& cutoff : system_.switching_cutoff) cutoff *= 1.02;
    for (double& cutoff : system_.potential_cutoff) cutoff *= 1.02;
    for (std::size_t s = 0; s < system_.species; ++s)
      for (std::size_t t = 0; t < system_.species; ++t)
        for (std::size_t a = 0; a < model.states_of(s); ++a)
          for (std::size_t b = 0; b < model.states_of(t); ++b) make_absolute(s, a, t, b);
  }

  reference::StateEvaluation operator()(const Configuration& c) const {
    double reach = 0.0;
    for (const double cutoff : system_.potential_cutoff) reach = std::max(reach, cutoff);
    for (const double cutoff : system_.switching_cutoff) reach = std::max(reach, cutoff);
    return reference::three_passes(c.positions, c.species, system_, reference::all_neighbours(c.positions, c.box.length, reach));
  }

 private:
  static reference::RadialFunction largest_near(reference::RadialFunction f, double width) {
    return [f, width](double r) -> reference::Radial {
      reference::Radial largest;
      for (const double x : {r - width, r, r + width}) {
        const auto [value, slope] = f(x);
        largest = {std::max(largest.value, std::abs(value)), std::max(largest.slope, std::abs(slope))};
      }
      return largest;
    };
  }

  static reference::ProbabilityFunction absolute(reference::ProbabilityFunction f) {
    return [f](double density, std::span<reference::StateProbability> states) {
      f(density, states);
      std::vector<reference::StateProbability> near(states.size());
      for (const double x : {density - 0.02, density + 0.02}) {
        f(x, near);
        for (std::size_t a = 0; a < states.size(); ++a)
          states[a].slope = std::max(std::abs(states[a].slope), std::abs(near[a].slope));
      }
      for (reference::StateProbability& state : states) state.logarithm = std::abs(state.logarithm);
    };
  }

  void make_absolute(std::size_t s, std::size_t a, std::size_t t, std::size_t b) {
    reference::RadialFunction& u = system_.potential[system_.potential_at(s, a, t, b)];
    const StateMixtureModel::Potential& potential = model_.potentials[model_.potential_at(s, a, t, b)];
    const auto* lj = std::get_if<StateMixtureModel::LennardJones>(&potential);
    if (lj == nullptr) {
      u = largest_near(u, 0.02 * std::get<StateMixtureModel::Table>(potential).last);
      return;
    }
    const reference::PairPotential pair{reference::LennardJones{lj->epsilon, lj->sigma}, model_.cutoff,
                                        reference::Truncation::shifted};
    u = [pair](double r) -> reference::Radial {
      const reference::PairValue value = reference::value(pair, r);
      return {value.u_magnitude, value.slope_magnitude};
    };
  }

  const StateMixtureModel& model_;
  reference::StateSystem system_;
};

// Whether rounding decides if a force of Lennard-Jones counts; energies, tables and densities end with a slope of zero or more
// continuously.
inline bool has_site_at_cutoff(const RandomStateMixture& made, double rounding) {
  const Configuration& c = made.configuration;
  const double cutoff = made.model.cutoff, width = 1e-14 * cutoff + rounding;
  const auto neighbours = reference::all_neighbours(c.positions, c.box.length, cutoff + width);
  for (std::size_t i = 0; i < c.size(); ++i)
    for (const reference::StateNeighbour& j : neighbours[i]) {
      reference::Vector d;
      for (std::size_t k = 0; k < 3; ++k) d[k] = c.positions[3 * i + k] - c.positions[3 * j.site + k] - j.shift[k];
      if (std::sqrt(reference::dot(d, d)) >= cutoff - width) return true;
    }
  return false;
}

}  // namespace lanescape::testing
