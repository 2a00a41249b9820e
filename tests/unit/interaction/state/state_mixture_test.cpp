#include "interaction/state/state_mixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>

#include "dispatch/isa.hpp"
#include "interaction/state/local_density.hpp"
#include "interaction/state/state_potentials.hpp"
#include "reference/lennard_jones.hpp"
#include "refusal.hpp"
#include "verification/state_mixture_cases.hpp"

namespace lanescape {
namespace {

using Filter = StateMixtureVariant::Filter;
using Potentials = StateMixtureVariant::Potentials;

const kernels::KernelTable& table() { return kernel_table(available_isas().back()); }

// The middle of the widest gap between two pair distances within [from, to]: a cutoff with no pair near it.
double cutoff_in_gap(const Configuration& fluid, double from, double to) {
  std::vector<double> r{from, to};
  for (std::size_t i = 0; i < fluid.size(); ++i)
    for (std::size_t j = 0; j < fluid.size(); ++j)
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z) {
            const std::array<int, 3> cell{x, y, z};
            std::array<double, 3> d;
            for (std::size_t k = 0; k < 3; ++k)
              d[k] = fluid.box.nearest_image(k, fluid.positions[3 * i + k] - fluid.positions[3 * j + k]) +
                     cell[k] * fluid.box.length[k];
            const double distance = std::hypot(d[0], d[1], d[2]);
            if (distance > from && distance < to) r.push_back(distance);
          }
  std::sort(r.begin(), r.end());
  std::size_t widest = 1;
  for (std::size_t k = 1; k < r.size(); ++k)
    if (r[k] - r[k - 1] > r[widest] - r[widest - 1]) widest = k;
  EXPECT_GT(r[widest] - r[widest - 1], 4e-3);
  return 0.5 * (r[widest] + r[widest - 1]);
}

template <class F>
double five_point(F f, double h) {
  return (f(-2.0 * h) - 8.0 * f(-h) + 8.0 * f(h) - f(2.0 * h)) / (12.0 * h);
}

struct Evaluated {
  StateMixture::Evaluation e;
  AlignedArray gradient;
};

Evaluated evaluate(StateMixtureParts parts, const Configuration& c, std::size_t species,
                   const StateMixture::Options& options = {}) {
  const ParticleLayout layout(c.species, species);
  StateMixture interaction(std::move(parts), c.box, layout, table(), options);
  Evaluated result{{}, AlignedArray(layout.dimension())};
  result.e = interaction.energy_and_gradient(layout.to_slots(c.positions), result.gradient);
  return result;
}

// Compares forces and virial of an interaction with differences of its energy. `make` creates its parts.
template <class MakeParts>
void expect_consistent(MakeParts make, const Configuration& c, std::size_t species, const std::string& name) {
  const Evaluated at = evaluate(make(), c, species);
  const ParticleLayout layout(c.species, species);
  const std::vector<double> gradient = layout.to_user(at.gradient);
  double scale = 0.0;
  for (const double g : gradient) scale = std::max(scale, std::abs(g));
  for (const std::size_t k : {0U, 13U, 26U, 41U, 80U}) {
    const auto energy = [&](double x) {
      Configuration moved = c;
      moved.positions[k] += x;
      return evaluate(make(), moved, species).e.energy;
    };
    EXPECT_NEAR(gradient[k], five_point(energy, 4e-4), 1e-8 * scale) << name << ", " << k;
  }
  const auto energy = [&](double x) {
    Configuration scaled = c;
    for (double& r : scaled.positions) r *= 1.0 + x;
    for (double& edge : scaled.box.length) edge *= 1.0 + x;
    return evaluate(make(), scaled, species).e.energy;
  };
  EXPECT_NEAR(-at.e.virial, five_point(energy, 1e-4), 1e-8 * (std::abs(at.e.virial) + scale)) << name;
}

TEST(StateMixture, ForcesAndVirialAreFivePointDifferencesOfTheEnergy) {
  for (const std::size_t species : {1U, 2U}) {
    Configuration fluid = state_mixture_fluid(27, species);
    fluid.wrap();
    const double cutoff = cutoff_in_gap(fluid, 2.2, 2.6);
    for (const std::size_t states : {1U, 2U, 3U})
      for (const Filter filter : {Filter::every, Filter::own, Filter::cross, Filter::asymmetric})
        for (const double temperature : {0.0, 1.3})
          for (const bool saturated : {false, true}) {
            const StateMixtureVariant variant{species, states, filter, Potentials::lennard_jones, temperature, saturated};
            expect_consistent([&] { return make_parts(state_mixture_model(variant, cutoff)); }, fluid, species, describe(variant));
          }
  }
}

TEST(StateMixture, TablesAreConsistentTooTheyEndSmoothly) {
  Configuration fluid = state_mixture_fluid(27, 2);
  fluid.wrap();
  const StateMixtureVariant variant{2, 2, Filter::asymmetric, Potentials::tables, 0.8};
  // At knots the third derivative jumps, which limits the accuracy of differences.
  const auto parts = [&] { return make_parts(state_mixture_model(variant)); };
  const Evaluated at = evaluate(parts(), fluid, 2);
  const std::vector<double> gradient = ParticleLayout(fluid.species, 2).to_user(at.gradient);
  for (const std::size_t k : {0U, 13U, 41U, 80U}) {
    const auto energy = [&](double x) {
      Configuration moved = fluid;
      moved.positions[k] += x;
      return evaluate(parts(), moved, 2).e.energy;
    };
    EXPECT_NEAR(gradient[k], five_point(energy, 1e-4), 1e-7 * std::abs(gradient[k]) + 1e-6) << k;
  }
}

TEST(StateMixture, AnySwitchingFunctionWillDo) {
  Configuration fluid = state_mixture_fluid(27, 2);
  fluid.wrap();
  const double cutoff = cutoff_in_gap(fluid, 2.2, 2.6);
  const auto lucy = [](double r) { return std::pow(1.0 - r / 1.9, 3) * (1.0 + 3.0 * r / 1.9); };
  const auto bell = [](double r) { return std::pow(1.0 - r * r / 4.0, 3); };
  const auto parts = [&] {
    StateMixtureParts made = make_parts(state_mixture_model({2, 3, Filter::every, Potentials::lennard_jones, 0.3}, cutoff));
    std::vector<SwitchingFunction> own{{lucy, 1.9}, {bell, 2.0}};
    made.order_parameter = std::make_unique<LocalDensity>(std::move(own), std::vector<double>{1.0, 0.5, 0.0, 2.0});
    // These densities come from few neighbours.
    made.response =
        std::make_unique<TanhCascade>(std::vector<std::vector<TanhCascade::Step>>{{{3.0, 1.0}, {1.0, 0.5}}, {{4.0, 2.0}}});
    return made;
  };
  expect_consistent(parts, fluid, 2, "own switching functions");
  const std::vector<double> seen = [&] {
    const ParticleLayout layout(fluid.species, 2);
    StateMixture interaction(parts(), fluid.box, layout, table(), {});
    interaction.energy(layout.to_slots(fluid.positions));
    return std::vector<double>{interaction.states().of(layout.slot_of(0))[0], interaction.states().of(layout.slot_of(1))[1]};
  }();
  for (const double p : seen) {
    EXPECT_GT(p, 1e-3);
    EXPECT_LT(p, 1.0 - 1e-3);
  }
}

TEST(StateMixture, OneStateIsPlainLennardJonesToTwoUnitsInTheLastPlace) {
  const Configuration fluid = state_mixture_fluid(500, 1);
  StateMixtureModel one;
  one.species = {{"Ar"}};
  one.states = {{{}, {}, {0.0}}};
  one.filter = {1.0};
  one.potentials = {StateMixtureModel::LennardJones{1.0, 1.0}};
  for (const Isa isa : available_isas()) {
    const ParticleLayout layout(fluid.species, 1);
    const AlignedArray positions = layout.to_slots(fluid.positions);
    StateMixture states(one, fluid.box, layout, kernel_table(isa), {});
    PairInteraction plain(lennard_jones(), fluid.box, layout, kernel_table(isa), {.search = PairSearch::list});
    AlignedArray a(layout.dimension()), b(layout.dimension());
    const auto e = states.energy_and_stress(positions, a);
    const auto lj = plain.energy_and_stress(positions, b);
    const auto two_ulp = [](double x) { return 2.0 * std::abs(x) * std::numeric_limits<double>::epsilon(); };
    EXPECT_NEAR(e.energy, lj.energy, two_ulp(lj.energy));
    EXPECT_NEAR(e.virial, lj.virial, two_ulp(lj.virial));
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], two_ulp(b[k])) << k;
    EXPECT_EQ(e.one_body_energy, 0.0);
  }
}

TEST(StateMixture, FixedProbabilitiesAreAMixture) {
  // Two species with one state each, represented by two states; each species is always in its own state.
  const Configuration fluid = state_mixture_fluid(125, 2);
  const StateMixtureModel model = state_mixture_model({1, 2});
  const StatePairs order{2, 2};
  std::vector<LennardJonesStates::Pair> pairs(order.size());
  reference::Mixture mixture{2, std::vector<double>(4), std::vector<double>(4), std::vector<double>(4, 2.5)};
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b) {
      const auto& u = std::get<StateMixtureModel::LennardJones>(model.potentials[model.potential_at(0, a, 0, b)]);
      for (std::size_t st = 0; st < 4; ++st) pairs[order.at(st / 2, a, st % 2, b)] = {u.epsilon, u.sigma};
      mixture.epsilon[2 * a + b] = u.epsilon;
      mixture.sigma[2 * a + b] = u.sigma;
    }
  StateMixtureParts parts;
  parts.response = std::make_unique<FixedProbabilities>(std::vector<std::vector<double>>{{1.0, 0.0}, {0.0, 1.0}});
  parts.potentials.push_back(std::make_unique<LennardJonesStates>(order, pairs, std::vector<double>(4, 2.5)));
  const Evaluated at = evaluate(std::move(parts), fluid, 2);
  const auto expected = reference::lennard_jones(fluid.positions, fluid.species, fluid.box.length, mixture,
                                                 reference::ImageRule::all, reference::Truncation::shifted);
  EXPECT_NEAR(at.e.energy, expected.energy, 1e-14 * expected.magnitude);
  EXPECT_NEAR(at.e.virial, expected.virial, 1e-13 * expected.magnitude);
  const std::vector<double> gradient = ParticleLayout(fluid.species, 2).to_user(at.gradient);
  for (std::size_t k = 0; k < gradient.size(); ++k)
    EXPECT_NEAR(gradient[k], expected.gradient[k], 2e-13 * expected.gradient_magnitude[k] + 1e-13);
}

TEST(StateMixture, ResultsDoNotDependOnTheNumberOfThreads) {
  const Configuration fluid = state_mixture_fluid(700, 2);
  for (const std::size_t states : {2U, 3U}) {
    const StateMixtureVariant variant{2, states, Filter::asymmetric, Potentials::both, 0.5};
    const Evaluated one = evaluate(make_parts(state_mixture_model(variant)), fluid, 2);
    for (const int threads : {2, 3, 5}) {
      StateMixture::Options options;
      options.threads = threads;
      const Evaluated several = evaluate(make_parts(state_mixture_model(variant)), fluid, 2, options);
      EXPECT_EQ(one.e.energy, several.e.energy);
      EXPECT_EQ(one.e.one_body_energy, several.e.one_body_energy);
      EXPECT_EQ(one.e.virial, several.e.virial);
      EXPECT_EQ(one.gradient, several.gradient);
    }
  }
}

// An evaluation keeps nothing except the positions at which its list was built.
TEST(StateMixture, ResultsDoNotDependOnWhatWasEvaluatedBefore) {
  const Configuration fluid = state_mixture_fluid(216, 1);
  const StateMixtureModel model = state_mixture_model({1, 2, Filter::every, Potentials::lennard_jones, 0.5});
  const ParticleLayout layout(fluid.species, 1);
  const AlignedArray positions = layout.to_slots(fluid.positions);
  AlignedArray moved = positions;
  for (std::size_t k = 0; k < moved.size(); k += 3) moved[k] += 0.01;
  StateMixture once(model, fluid.box, layout, table(), {}), often(model, fluid.box, layout, table(), {});
  AlignedArray a(layout.dimension()), b(layout.dimension());
  once.energy(positions);
  const auto e = once.energy_and_gradient(moved, a);
  often.energy_and_gradient(positions, b);
  often.energy(moved);
  often.energy(positions);
  EXPECT_EQ(often.energy_and_stress(moved, b).energy, e.energy);
  EXPECT_EQ(a, b);
}

TEST(StateMixture, PairFunctionsAndKernelsAgree) {
  const Configuration fluid = state_mixture_fluid(64, 2);
  const StateMixtureModel model = state_mixture_model({2, 3, Filter::asymmetric, Potentials::lennard_jones, 0.4});
  const auto u = [&](std::size_t s, std::size_t a, std::size_t t, std::size_t b, double r) -> PairFunctionStates::Value {
    if (a >= model.states_of(s) || b >= model.states_of(t)) return {0.0, 0.0};
    const auto& lj = std::get<StateMixtureModel::LennardJones>(model.potentials[model.potential_at(s, a, t, b)]);
    const double sixth = std::pow(lj.sigma / r, 6), at_cutoff = std::pow(lj.sigma / model.cutoff, 6);
    return {4.0 * lj.epsilon * (sixth * (sixth - 1.0) - at_cutoff * (at_cutoff - 1.0)),
            24.0 * lj.epsilon * sixth * (1.0 - 2.0 * sixth) / r};
  };
  StateMixtureParts parts = make_parts(model);
  parts.potentials.clear();
  parts.potentials.push_back(std::make_unique<PairFunctionStates>(2, model.cutoff, u));
  const Evaluated by_function = evaluate(std::move(parts), fluid, 2), by_kernel = evaluate(make_parts(model), fluid, 2);
  EXPECT_NEAR(by_function.e.energy, by_kernel.e.energy, 1e-11);
  EXPECT_NEAR(by_function.e.virial, by_kernel.e.virial, 1e-10);
  for (std::size_t k = 0; k < by_kernel.gradient.size(); ++k) EXPECT_NEAR(by_function.gradient[k], by_kernel.gradient[k], 1e-10);
}

TEST(StateMixture, BondedAnglesFollowTheStateInTheMiddle) {
  Configuration fluid = state_mixture_fluid(27, 1);
  fluid.wrap();
  const double cutoff = cutoff_in_gap(fluid, 2.2, 2.6);
  const auto parts = [&] {
    StateMixtureParts made = make_parts(state_mixture_model({1, 2, Filter::every, Potentials::lennard_jones, 0.3}, cutoff));
    made.potentials.push_back(
        std::make_unique<BondedAngles>(std::vector<BondedAngles::Angle>{{0, 1, 4}, {4, 13, 14}, {8, 26, 25}},
                                       std::vector<BondedAngles::Spring>{{30.0, 1.9}, {12.0, std::numbers::pi / 2.0}}));
    return made;
  };
  expect_consistent(parts, fluid, 1, "angles");
  // The angle alone, at fixed probabilities, compared with its formula.
  Configuration three{{{20.0, 20.0, 20.0}}, {0, 0, 0}, {1.0, 1.0, 1.0, 2.0, 1.0, 1.0, 2.0, 2.0, 1.0}};
  StateMixtureParts alone;
  alone.response = std::make_unique<FixedProbabilities>(std::vector<std::vector<double>>{{0.25, 0.75}});
  alone.potentials.push_back(std::make_unique<BondedAngles>(std::vector<BondedAngles::Angle>{{0, 1, 2}},
                                                            std::vector<BondedAngles::Spring>{{8.0, 1.5}, {4.0, 1.0}}));
  const double theta = std::numbers::pi / 2.0;
  EXPECT_NEAR(evaluate(std::move(alone), three, 1).e.energy,
              0.25 * 4.0 * (theta - 1.5) * (theta - 1.5) + 0.75 * 2.0 * (theta - 1.0) * (theta - 1.0), 1e-14);
}

TEST(StateMixture, OneBodyEnergyIsTallied) {
  // Sites far apart: each is mostly in the last state.
  const Configuration two{{{20.0, 20.0, 20.0}}, {0, 0}, {1.0, 1.0, 1.0, 9.0, 9.0, 9.0}};
  StateMixtureModel model = state_mixture_model({1, 2, Filter::every, Potentials::lennard_jones, 0.9});
  model.states[0].steps[0] = {4.0, 5.0};
  const double p = 0.5 * (1.0 + std::tanh(-4.0 / 5.0)), q = 1.0 - p;
  const double expected = 2.0 * (model.states[0].mu[0] * p + model.states[0].mu[1] * q + 0.9 * (p * std::log(p) + q * std::log(q)));
  const Evaluated at = evaluate(make_parts(model), two, 1);
  EXPECT_NEAR(at.e.one_body_energy, expected, 1e-14);
  EXPECT_EQ(at.e.energy, at.e.one_body_energy);
}

TEST(StateMixture, ModelsThatMakeNoSenseAreRefused) {
  using testing::refusal;
  const auto refused = [](auto change) {
    StateMixtureModel model = state_mixture_model({2, 2, Filter::every, Potentials::tables});
    change(model);
    return refusal([&] { model.check(); });
  };
  EXPECT_NE(refused([](auto& m) { m.filter.pop_back(); }).find("density filters"), std::string::npos);
  EXPECT_NE(refused([](auto& m) { m.states[0].mu.push_back(1.0); }).find("mu"), std::string::npos);
  EXPECT_NE(refused([](auto& m) { m.states[0].switching.threshold = 3.0; }).find("below its cutoff"), std::string::npos);
  EXPECT_NE(refused([](auto& m) { m.states[0].steps[0].width = 0.0; }).find("above 0"), std::string::npos);
  EXPECT_NE(refused([](auto& m) { m.states[0].switching.width = 0.001; }).find("hundredth"), std::string::npos);
  EXPECT_NE(refused([](auto& m) { std::get<StateMixtureModel::Table>(m.potentials[0]).values.back() = 0.1; }).find("must be 0"),
            std::string::npos);
  EXPECT_NE(refused([](auto& m) { m.potentials[1] = StateMixtureModel::LennardJones{1.0, 1.0}; }).find("mirror image"),
            std::string::npos);
  EXPECT_NE(refused([](auto& m) { m.entropy_temperature = -1.0; }).find("entropy"), std::string::npos);
}

TEST(StateMixture, OverlapsAndFarReachesAreRefused) {
  Configuration two{{{20.0, 20.0, 20.0}}, {0, 0}, {1.0, 1.0, 1.0, 1.2, 1.0, 1.0}};
  EXPECT_NE(testing::refusal([&] { check_separations(two, liquid_vapour()); }).find("particles 0 and 1 overlap"),
            std::string::npos);
  two.positions[3] = std::nan("");
  EXPECT_NE(testing::refusal([&] { check_separations(two, liquid_vapour()); }).find("x coordinate nan of particle 1"),
            std::string::npos);
  EXPECT_NE(testing::refusal([&] { check_cutoff(liquid_vapour(), {{0.2, 5.0, 5.0}}); }).find("images"), std::string::npos);
}

TEST(StateMixture, StatesThatASpeciesDoesNotHaveLeaveTheUnitOfLengthAlone) {
  StateMixtureModel model = state_mixture_model({2, 3}).in_unit(0x1p30);
  ASSERT_EQ(model.states_of(1), 2U);
  const double unit = model.length_unit();
  EXPECT_LT(unit, 0x1p-29);
  model.potentials[model.potential_at(1, 2, 1, 2)] = StateMixtureModel::LennardJones{0.0, 1.0};
  EXPECT_EQ(model.length_unit(), unit);
}

TEST(StateMixture, UnitsOfLengthThatArePowersOfTwoChangeNoBit) {
  const Configuration fluid = state_mixture_fluid(64, 1);
  const auto in_unit = [&](double unit) {
    Configuration c = fluid;
    for (double& edge : c.box.length) edge *= unit;
    for (double& x : c.positions) x *= unit;
    const ParticleLayout layout(c.species, 1);
    StateMixture interaction(liquid_vapour().in_unit(1.0 / unit), c.box, layout, table(), {});
    AlignedArray gradient(layout.dimension(), 0.0);
    const auto e = interaction.energy_and_gradient(layout.to_slots(c.positions), gradient);
    for (double& g : gradient) g *= unit;
    return std::tuple(e.energy, e.one_body_energy, e.virial, gradient);
  };
  for (const double unit : {0x1p-100, 0x1p-20, 0x1p30}) EXPECT_EQ(in_unit(unit), in_unit(1.0)) << unit;
}

}  // namespace
}  // namespace lanescape
