#include "reference/state_mixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "pair_cases.hpp"
#include "reference/lennard_jones.hpp"

namespace {

using namespace lanescape::reference;

struct Sites {
  std::vector<double> positions;
  std::vector<int> species;
  Vector box;
};

enum class Filter { every, own, cross, asymmetric };

/// A cubic lattice at density 0.8 with random displacements; with two species, every second site is of the second.
Sites fluid(int edge, std::size_t species, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0; };
  const double a = std::cbrt(1.0 / 0.8);
  Sites sites{{}, {}, {edge * a, edge * a, edge * a}};
  for (int x = 0; x < edge; ++x)
    for (int y = 0; y < edge; ++y)
      for (int z = 0; z < edge; ++z) {
        for (const int c : {x, y, z}) sites.positions.push_back(a * c + 0.08 * uniform());
        sites.species.push_back(static_cast<int>(sites.species.size() % species));
      }
  return sites;
}

/// The middle of the widest gap between pair distances within [from, to]: a cutoff with no pair near it.
double cutoff_in_gap(const Sites& sites, double from, double to) {
  std::vector<double> r{from, to};
  const StateNeighbours neighbours = all_neighbours(sites.positions, sites.box, to);
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    for (const StateNeighbour& j : neighbours[i]) {
      Vector d;
      for (std::size_t k = 0; k < 3; ++k) d[k] = sites.positions[3 * i + k] - sites.positions[3 * j.site + k] - j.shift[k];
      const double distance = std::hypot(d[0], d[1], d[2]);
      if (distance > from) r.push_back(distance);
    }
  std::sort(r.begin(), r.end());
  std::size_t widest = 1;
  for (std::size_t k = 1; k < r.size(); ++k)
    if (r[k] - r[k - 1] > r[widest] - r[widest - 1]) widest = k;
  EXPECT_GT(r[widest] - r[widest - 1], 4e-3);
  return 0.5 * (r[widest] + r[widest - 1]);
}

struct Options {
  std::size_t species = 1, states = 2;
  Filter filter = Filter::every;
  double entropy_temperature = 0.0;
  bool saturated = false;
};

double filter_of(Filter filter, std::size_t s, std::size_t t) {
  switch (filter) {
    case Filter::every:
      return 1.0;
    case Filter::own:
      return s == t ? 1.0 : 0.0;
    case Filter::cross:
      return s == t ? 0.0 : 1.0;
    case Filter::asymmetric:
      return s == 0 ? 1.0 : 0.3 * static_cast<double>(t);
  }
  return 0.0;
}

StateSystem system_of(const Options& o, double cutoff) {
  StateSystem system;
  system.species = o.species;
  system.states = o.states;
  system.entropy_temperature = o.entropy_temperature;
  for (std::size_t s = 0; s < o.species; ++s) {
    const double density_cutoff = 2.1 - 0.2 * static_cast<double>(s);
    system.switching.push_back(tapered_switch(1.4, 0.14, density_cutoff));
    system.switching_cutoff.push_back(density_cutoff);
    // Densities are about 8, or 4 if half of the sites count.
    std::vector<double> thresholds, widths;
    for (std::size_t a = 0; a + 1 < o.states; ++a) {
      thresholds.push_back(o.saturated ? 3000.0 : 6.0 - 3.0 * static_cast<double>(a));
      widths.push_back(o.saturated ? 2.0 : 2.5);
    }
    system.probabilities.push_back(tanh_cascade(thresholds, widths));
    for (std::size_t t = 0; t < o.species; ++t) {
      system.filter.push_back(filter_of(o.filter, s, t));
      system.potential_cutoff.push_back(cutoff);
      for (std::size_t a = 0; a < o.states; ++a)
        for (std::size_t b = 0; b < o.states; ++b)
          system.potential.push_back(
              shifted_lennard_jones(1.0 + 0.3 * static_cast<double>(a + b) - 0.2 * static_cast<double>(s + t),
                                    1.0 - 0.05 * static_cast<double>(a * b), cutoff));
    }
    for (std::size_t a = 0; a < o.states; ++a) system.mu.push_back(0.7 * static_cast<double>(a) - 0.4 * static_cast<double>(s));
  }
  return system;
}

std::vector<Options> every_option() {
  std::vector<Options> options;
  for (const std::size_t species : {1U, 2U})
    for (const std::size_t states : {1U, 2U, 3U})
      for (const Filter filter : {Filter::every, Filter::own, Filter::cross, Filter::asymmetric})
        for (const double temperature : {0.0, 1.3})
          for (const bool saturated : {false, true}) options.push_back({species, states, filter, temperature, saturated});
  return options;
}

std::string describe(const Options& o) {
  return std::to_string(o.species) + " species, " + std::to_string(o.states) + " states, filter " +
         std::to_string(static_cast<int>(o.filter)) + (o.entropy_temperature > 0.0 ? ", entropy" : "") +
         (o.saturated ? ", saturated" : "");
}

StateEvaluation evaluate(const Sites& sites, const StateSystem& system, double reach = 2.7) {
  return three_passes(sites.positions, sites.species, system, all_neighbours(sites.positions, sites.box, reach));
}

TEST(StateMixtureReference, ForcesAreFivePointDifferencesOfTheEnergy) {
  const Sites one = fluid(3, 1, 7), two = fluid(3, 2, 7);
  const double cutoff = cutoff_in_gap(one, 2.2, 2.6);
  for (const Options& o : every_option()) {
    const Sites& sites = o.species == 1 ? one : two;
    const StateSystem system = system_of(o, cutoff);
    const StateEvaluation e = evaluate(sites, system);
    for (const std::size_t k : {0U, 13U, 26U, 41U, 80U}) {
      Sites moved = sites;
      const auto energy = [&](double x) {
        moved.positions[k] = sites.positions[k] + x;
        return evaluate(moved, system).energy;
      };
      EXPECT_NEAR(e.gradient[k], derivative(energy, 4e-4), 1e-8 * e.gradient_magnitude[k / 3]) << describe(o) << ", " << k;
    }
  }
}

TEST(StateMixtureReference, VirialIsTheVolumeDerivativeOfTheEnergy) {
  const Sites one = fluid(3, 1, 8), two = fluid(3, 2, 8);
  const double cutoff = cutoff_in_gap(one, 2.2, 2.6);
  for (const Options& o : every_option()) {
    const Sites& sites = o.species == 1 ? one : two;
    const StateSystem system = system_of(o, cutoff);
    const auto energy = [&](double x) {
      Sites scaled = sites;
      for (double& r : scaled.positions) r *= 1.0 + x;
      for (double& edge : scaled.box) edge *= 1.0 + x;
      return evaluate(scaled, system).energy;
    };
    // dU / d ln L = -sum r.f.
    const StateEvaluation e = evaluate(sites, system);
    EXPECT_NEAR(-e.virial, derivative(energy, 1e-4), 1e-8 * std::max(e.magnitude, std::abs(e.virial))) << describe(o);
  }
}

TEST(StateMixtureReference, NestedAndThreePassesAgree) {
  for (const Options& o : every_option()) {
    const Sites sites = fluid(3, o.species, 9);
    const StateSystem system = system_of(o, 2.5);
    const StateNeighbours neighbours = all_neighbours(sites.positions, sites.box, 2.8);
    const StateEvaluation a = three_passes(sites.positions, sites.species, system, neighbours);
    const StateEvaluation b = nested(sites.positions, sites.species, system, neighbours);
    EXPECT_NEAR(a.energy, b.energy, 1e-13 * a.magnitude) << describe(o);
    EXPECT_NEAR(a.virial, b.virial, 1e-12 * a.magnitude) << describe(o);
    EXPECT_EQ(a.probabilities, b.probabilities);
    for (std::size_t k = 0; k < a.gradient.size(); ++k)
      EXPECT_NEAR(a.gradient[k], b.gradient[k], 1e-13 * a.gradient_magnitude[k / 3]) << describe(o);
  }
}

TEST(StateMixtureReference, OneStateIsALennardJonesFluid) {
  const Sites sites = fluid(3, 1, 10);
  Options o{1, 1};
  const StateEvaluation e = evaluate(sites, system_of(o, 2.5));
  const Evaluation lj =
      lennard_jones(sites.positions, sites.species, sites.box, {1, {1.0}, {1.0}, {2.5}}, ImageRule::all, Truncation::shifted);
  EXPECT_NEAR(e.energy, lj.energy, 1e-14 * lj.magnitude);
  EXPECT_NEAR(e.virial, lj.virial, 1e-13 * lj.magnitude);
  for (std::size_t k = 0; k < lj.gradient.size(); ++k)
    EXPECT_NEAR(e.gradient[k], lj.gradient[k], 1e-13 * e.gradient_magnitude[k / 3]);
}

TEST(StateMixtureReference, FixedProbabilitiesOfZeroAndOneAreAMixture) {
  const Sites one = fluid(3, 1, 11);
  const StateSystem two_states = system_of({1, 2}, 2.5);
  StateSystem system = two_states;
  system.species = 2;
  // Species 0 is always in state 0, species 1 in state 1.
  for (const double p : {1.0, 0.0}) {
    const auto fixed = [p](double, std::span<StateProbability> states) {
      states[0] = {p, 0.0, std::log(p)};
      states[1] = {1.0 - p, 0.0, std::log(1.0 - p)};
    };
    if (p == 1.0) system.probabilities = {fixed, fixed};
    system.probabilities[p == 1.0 ? 0 : 1] = fixed;
  }
  system.switching.push_back(system.switching[0]);
  system.switching_cutoff.push_back(system.switching_cutoff[0]);
  system.filter.assign(4, 1.0);
  system.potential_cutoff.assign(4, 2.5);
  system.mu.assign(4, 0.0);
  system.potential.clear();
  for (int st = 0; st < 4; ++st)
    for (const RadialFunction& u : two_states.potential) system.potential.push_back(u);
  const Sites two = fluid(3, 2, 11);
  const StateEvaluation e = evaluate(two, system);
  const Evaluation lj =
      lennard_jones(two.positions, two.species, two.box, {2, {1.0, 1.3, 1.3, 1.6}, {1.0, 1.0, 1.0, 0.95}, {2.5, 2.5, 2.5, 2.5}},
                    ImageRule::all, Truncation::shifted);
  EXPECT_NEAR(e.energy, lj.energy, 1e-13 * lj.magnitude);
  for (std::size_t k = 0; k < lj.gradient.size(); ++k)
    EXPECT_NEAR(e.gradient[k], lj.gradient[k], 1e-13 * e.gradient_magnitude[k / 3]);
}

TEST(StateMixtureReference, SaturatedProbabilitiesGiveNumbers) {
  Options o{1, 3, Filter::every, 1.0, true};
  const StateEvaluation e = evaluate(fluid(3, 1, 12), system_of(o, 2.5));
  EXPECT_EQ(e.probabilities[0], 0.0);
  EXPECT_EQ(e.probabilities[2], 1.0);
  EXPECT_TRUE(std::isfinite(e.energy) && std::isfinite(e.virial));
  for (const double g : e.gradient) EXPECT_TRUE(std::isfinite(g));
}

TEST(StateMixtureReference, CascadeAddsUpToOneAndItsLogarithmsAreThoseOfItsProbabilities) {
  const ProbabilityFunction cascade = tanh_cascade({6.0, 3.0}, {2.5, 0.5});
  for (const double density : {0.0, 2.0, 3.0, 4.7, 6.0, 9.0, 12.0}) {
    std::array<StateProbability, 3> s;
    cascade(density, s);
    EXPECT_NEAR(s[0].p + s[1].p + s[2].p, 1.0, 1e-15);
    EXPECT_NEAR(s[0].slope + s[1].slope + s[2].slope, 0.0, 1e-15);
    EXPECT_NEAR(s[0].p, 0.5 * (1.0 + std::tanh((density - 6.0) / 2.5)), 1e-15);
    for (const StateProbability& state : s) EXPECT_NEAR(std::exp(state.logarithm), state.p, 1e-15);
  }
}

TEST(StateMixtureReference, SwitchReachesZeroWithTwoContinuousDerivatives) {
  const RadialFunction w = tapered_switch(1.4, 0.14, 2.0);
  EXPECT_DOUBLE_EQ(w(1.4).value, 0.5);
  EXPECT_EQ(w(2.0).value, 0.0);
  for (const double r : {1.0, 1.3, 1.7, 1.95})
    EXPECT_NEAR(w(r).slope, derivative([&](double x) { return w(r + x).value; }, 1e-3), 1e-7 * std::abs(w(r).slope)) << r;
  for (const double r : {1.6, 2.0}) {  // the ends of the taper
    const double step = 1e-6, before = (w(r).slope - w(r - step).slope) / step, after = (w(r + step).slope - w(r).slope) / step;
    EXPECT_NEAR(before, after, 1e-4 * std::abs(before) + 1e-7) << r;
  }
}

TEST(StateMixtureReference, RefusesSizesThatDoNotFit) {
  const Sites sites = fluid(2, 1, 13);
  StateSystem system = system_of({1, 2}, 2.0);
  const StateNeighbours neighbours = all_neighbours(sites.positions, sites.box, 2.0);
  system.mu.pop_back();
  EXPECT_THROW(three_passes(sites.positions, sites.species, system, neighbours), std::invalid_argument);
  EXPECT_THROW(nested(sites.positions, sites.species, system_of({1, 2}, 2.0), {}), std::invalid_argument);
}

}  // namespace
