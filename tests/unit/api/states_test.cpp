#include <lanescape/states.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <lanescape/dynamics.hpp>

#include "refusal.hpp"

namespace lanescape {
namespace {

using testing::refusal;

// The number of neighbours, each weighted with (1 - r^2/4)^3.
class Neighbours : public SiteOrderParameter {
 public:
  double reach(int, int) const override { return 2.0; }
  void evaluate(const SitePairs& pairs, std::span<const int>, std::span<double> values) override {
    std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t k = 0; k < pairs.first.size(); ++k) {
      const double inside = 1.0 - 0.25 * squared(pairs.separation[k]);
      if (inside > 0.0) values[static_cast<std::size_t>(pairs.first[k])] += inside * inside * inside;
    }
  }
  void add_gradient(const SitePairs& pairs, std::span<const int>, std::span<const double> multipliers, std::span<double> gradient,
                    std::array<double, 6>& virial) override {
    constexpr std::size_t voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    for (std::size_t k = 0; k < pairs.first.size(); ++k) {
      const auto i = static_cast<std::size_t>(pairs.first[k]), j = static_cast<std::size_t>(pairs.second[k]);
      const auto& d = pairs.separation[k];
      const double inside = 1.0 - 0.25 * squared(d);
      if (inside <= 0.0) continue;
      const double slope_over_r = -1.5 * inside * inside * (multipliers[i] + multipliers[j]);
      for (std::size_t axis = 0; axis < 3; ++axis) gradient[3 * i + axis] += slope_over_r * d[axis];
      for (std::size_t v = 0; v < 6; ++v) virial[v] -= 0.5 * slope_over_r * d[voigt[v][0]] * d[voigt[v][1]];
    }
  }

 private:
  static double squared(const std::array<double, 3>& d) { return d[0] * d[0] + d[1] * d[1] + d[2] * d[2]; }
};

class Logistic final : public SiteResponse {
 public:
  std::size_t states() const override { return 2; }
  void evaluate(int, double value, std::span<SiteProbability> states) const override {
    const double x = value - 2.0, p = 1.0 / (1.0 + std::exp(-x)), q = 1.0 / (1.0 + std::exp(x));
    states[0] = {p, p * q, -std::log1p(std::exp(-x))};
    states[1] = {q, -p * q, -std::log1p(std::exp(x))};
  }
};

struct Sites64 {
  Model model = Model::named("ucg");
  Start start = make_start(model, 64, 0.6, 9);
  Sites64() {
    for (std::size_t k = 0; k < start.positions.size(); ++k) start.positions[k] += 0.1 * std::sin(17.0 * static_cast<double>(k));
  }
};

void expect_forces_are_slopes(StateSystem& system, std::vector<double> positions) {
  std::vector<double> forces(positions.size());
  const Evaluation e = system.evaluate(positions, {.forces = Vectors<double>::interleaved(forces), .stress = true});
  EXPECT_EQ(e.energy, system.energy(positions));
  EXPECT_NEAR(e.stress[0] + e.stress[1] + e.stress[2], -e.virial / (64.0 / 0.6), 1e-9 * std::fabs(e.virial));
  const double h = 1e-6;
  for (const std::size_t k : {0u, 40u, 101u, 191u}) {
    const double at = positions[k];
    positions[k] = at + h;
    const double up = system.energy(positions);
    positions[k] = at - h;
    const double down = system.energy(positions);
    positions[k] = at;
    EXPECT_NEAR(forces[k], -(up - down) / (2.0 * h), 1e-6 * (1.0 + std::fabs(forces[k])));
  }
}

TEST(StateSystem, HasForcesThatAreSlopesOfTheEnergy) {
  const Sites64 sites;
  StateSystem system(sites.model, sites.start.species, sites.start.box);
  expect_forces_are_slopes(system, sites.start.positions);
  EXPECT_EQ(system.states(), 2u);
  const std::vector<double> p = system.probabilities();
  ASSERT_EQ(p.size(), 128u);
  for (std::size_t i = 0; i < 64; ++i) EXPECT_NEAR(p[2 * i] + p[2 * i + 1], 1.0, 1e-14);
  EXPECT_EQ(system.order_parameters().size(), 64u);
}

TEST(StateSystem, SharesItsEnergyAmongTheSitesAndTakesAnotherBox) {
  const Sites64 sites;
  StateSystem system(sites.model, sites.start.species, sites.start.box);
  std::vector<double> energies(64);
  const double energy = system.evaluate(sites.start.positions, {.energies = energies}).energy;
  EXPECT_NEAR(std::accumulate(energies.begin(), energies.end(), 0.0), energy, 1e-10);
  std::array<double, 3> longer = sites.start.box;
  longer[2] *= 1.1;
  system.set_box(longer);
  EXPECT_NEAR(system.energy(sites.start.positions),
              StateSystem(sites.model, sites.start.species, longer).energy(sites.start.positions), 1e-10);
}

TEST(StateSystem, TakesAnOrderParameterOfTheHost) {
  const Sites64 sites;
  const auto neighbours = std::make_shared<Neighbours>();
  StateSystem system(sites.model, sites.start.species, sites.start.box,
                     {.order_parameter = neighbours, .response = std::make_shared<Logistic>()});
  expect_forces_are_slopes(system, sites.start.positions);
  StateSystem plain(sites.model, sites.start.species, sites.start.box);
  EXPECT_NE(system.energy(sites.start.positions), plain.energy(sites.start.positions));
}

TEST(StateSystem, RefusesWhatCannotBe) {
  const Sites64 sites;
  const auto make = [&](const StateSystem::Options& options) {
    return refusal([&] { StateSystem(sites.model, sites.start.species, sites.start.box, options); });
  };
  EXPECT_EQ(make({.order_parameter = std::make_shared<Neighbours>()}),
            "an order parameter and a response go together: both or none are needed");
  EXPECT_EQ(make({.threads = 2, .order_parameter = std::make_shared<Neighbours>(), .response = std::make_shared<Logistic>()}),
            "2 threads are not allowed with an order parameter of the host: 1 is needed");
  EXPECT_EQ(refusal([&] { StateSystem(Model::named("lennard-jones"), sites.start.species, sites.start.box); }),
            "model lennard-jones has no states: a StateSystem needs one of sites in states, such as ucg");
  class Reaching final : public Neighbours {
   public:
    explicit Reaching(double reach) : reach_(reach) {}
    double reach(int, int) const override { return reach_; }

   private:
    double reach_;
  };
  const auto with_reach = [&](double reach) {
    return make({.order_parameter = std::make_shared<Reaching>(reach), .response = std::make_shared<Logistic>()});
  };
  EXPECT_EQ(with_reach(-1.0), "order parameter: reach -1 of species 0 and 0 is not allowed: it must be finite and at least 0");
  EXPECT_NE(with_reach(std::nan("")).find("reach nan"), std::string::npos);
  EXPECT_NE(with_reach(1e9).find("reaches over more than 8 images"), std::string::npos);
  StateSystem system(sites.model, sites.start.species, sites.start.box);
  std::vector<double> energies(63);
  EXPECT_EQ(refusal([&] { system.evaluate(sites.start.positions, {.energies = energies}); }),
            "room for 63 energies was given: 64 are needed");
}

}  // namespace
}  // namespace lanescape
