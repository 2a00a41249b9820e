#include "reference/pair_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "pair_systems.hpp"

namespace {

using namespace lanescape::reference;

/// Two species: the potential as it is, with half its strength, and half its strength and three quarters of its size.
PairMixture mixture_of(const PairPotential& potential) {
  const auto scaled = [&](double epsilon, double sigma) {
    PairPotential result = potential;
    std::visit(
        [&](auto& form) {
          form.epsilon *= epsilon;
          form.sigma *= sigma;
        },
        result.form);
    result.cutoff *= sigma;
    return result;
  };
  return {2, {potential, scaled(0.5, 1.0), scaled(0.5, 1.0), scaled(0.5, 0.75)}};
}

void give_diameters(System& system, const PairPotential& potential) {
  if (!std::holds_alternative<Polydisperse>(potential.form)) return;
  for (std::size_t j = 0; j < system.species.size(); ++j) system.diameters.push_back(0.75 + 0.1 * static_cast<double>(j % 7));
}

/// Calls visit(system, mixture) for each potential, in a box shorter than most cutoffs and in one of several cells.
template <class Visit>
void for_each_system(const Visit& visit) {
  for_each_potential([&](const PairPotential& potential, const std::string& name) {
    for (System system : {rattled_fcc({1, 1, 2}, 1.45, 0.1, 2, 2), rattled_fcc({2, 1, 2}, 1.3, 0.05, 2, 3)}) {
      SCOPED_TRACE(name);
      give_diameters(system, potential);
      visit(system, mixture_of(potential));
    }
  });
}

/// The gradient of a sum with a jump at the cutoff is that of the sum whose pairs keep their side of it.
PairMixture without_jump(PairMixture mixture) {
  for (PairPotential& potential : mixture.potentials)
    if (potential.truncation == Truncation::plain || potential.truncation == Truncation::tail)
      potential.truncation = Truncation::shifted;
  return mixture;
}

TEST(ReferencePairSum, TheGradientIsTheDerivativeOfTheEnergy) {
  for_each_system([](const System& system, const PairMixture& mixture) {
    const Evaluation result = pair_sum(system.particles(), mixture, ImageRule::all);
    for (std::size_t k = 0; k < 6; ++k) {
      const auto energy = [&](double shift) {
        System moved = system;
        moved.positions[k] += shift;
        return pair_sum(moved.particles(), without_jump(mixture), ImageRule::all).energy;
      };
      EXPECT_NEAR(result.gradient[k], derivative(energy, 1e-5), 1e-8 * largest(result.gradient_magnitude)) << k;
    }
  });
}

TEST(ReferencePairSum, TheVirialTensorIsMinusTheDerivativeOfTheEnergyWithStrain) {
  for_each_system([](const System& system, const PairMixture& mixture) {
    const PairMixture continuous = without_jump(mixture);
    const Evaluation result = pair_sum(system.particles(), continuous, ImageRule::all);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto energy = [&](double strain) {
        return pair_sum(stretched(system, axis, strain).particles(), continuous, ImageRule::all).energy;
      };
      EXPECT_NEAR(result.virial_tensor[axis], -derivative(energy, 1e-5), 1e-8 * result.virial_magnitude) << axis;
    }
    const auto& w = result.virial_tensor;
    EXPECT_NEAR(result.virial, w[0] + w[1] + w[2], 1e-13 * result.virial_magnitude);
  });
}

TEST(ReferencePairSum, ForcesAddUpToZero) {
  for_each_system([](const System& system, const PairMixture& mixture) {
    const Evaluation result = pair_sum(system.particles(), mixture, ImageRule::all);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0.0;
      for (std::size_t k = axis; k < result.gradient.size(); k += 3) sum += result.gradient[k];
      EXPECT_NEAR(sum, 0.0, 1e-12 * largest(result.gradient_magnitude));
    }
  });
}

TEST(ReferencePairSum, PlainAndTailDifferByTheIntegralsAlone) {
  const double pi = std::numbers::pi;
  for (const NamedForm& form : all_forms()) {
    if (!has_tail(form)) continue;
    const System system = rattled_fcc({1, 1, 2}, 1.45, 0.1, 2, 2);  // 7 A and 1 B
    const PairMixture mixture = mixture_of({form.form, form.cutoff, Truncation::tail});
    PairMixture plain = mixture;
    for (PairPotential& potential : plain.potentials) potential.truncation = Truncation::plain;
    const Evaluation with = pair_sum(system.particles(), mixture, ImageRule::all);
    const Evaluation without = pair_sum(system.particles(), plain, ImageRule::all);
    const double volume = system.box[0] * system.box[1] * system.box[2];
    TailIntegrals sum;
    for (const auto& [a, b, pairs] : {std::tuple{0, 0, 49.0}, {0, 1, 14.0}, {1, 1, 1.0}}) {
      const TailIntegrals integrals = tail_integrals(mixture.potential(a, b));
      sum.energy += 2.0 * pi / volume * pairs * integrals.energy;
      sum.virial += 2.0 * pi / volume * pairs * integrals.virial;
    }
    EXPECT_NEAR(with.energy - without.energy, sum.energy, 1e-13 * with.magnitude) << form.name;
    EXPECT_NEAR(with.virial - without.virial, sum.virial, 1e-13 * with.virial_magnitude) << form.name;
    EXPECT_EQ(with.gradient, without.gradient) << form.name;
  }
}

TEST(ReferencePairSum, EqualDiametersAreASmoothInversePower) {
  System system = rattled_fcc({2, 2, 1}, 1.45, 0.1, 1, 4);
  const Evaluation inverse_power =
      pair_sum(system.particles(), {1, {{InversePower{1.5, 0.9, 12}, 0.9 * 1.25, Truncation::smooth}}}, ImageRule::all);
  system.diameters.assign(system.species.size(), 0.9);
  expect_same(inverse_power, pair_sum(system.particles(), {1, {{Polydisperse{1.5}}}}, ImageRule::all));
}

TEST(ReferencePairSum, DiametersOfTwoKindsAreAMixtureOfTwoSpecies) {
  System system = rattled_fcc({2, 2, 1}, 1.45, 0.1, 2, 5);
  const auto potential = [](double sigma) { return PairPotential{InversePower{1.0, sigma, 12}, 1.25 * sigma, Truncation::smooth}; };
  const double mixed = 1.0 * (1.0 - 0.2 * 0.4);
  const Evaluation mixture =
      pair_sum(system.particles(), {2, {potential(0.8), potential(mixed), potential(mixed), potential(1.2)}}, ImageRule::all);
  for (int& s : system.species) {
    system.diameters.push_back(s == 0 ? 0.8 : 1.2);
    s = 0;
  }
  expect_same(mixture, pair_sum(system.particles(), {1, {{Polydisperse{}}}}, ImageRule::all));
}

TEST(ReferencePairSum, APositionThatIsNotANumberShowsInTheResult) {
  for_each_potential([](const PairPotential& potential, const std::string& name) {
    System system = two_particles(1.2);
    if (std::holds_alternative<Polydisperse>(potential.form)) system.diameters = {1.0, 1.1};
    system.positions[1] = std::numeric_limits<double>::quiet_NaN();
    for (const ImageRule images : {ImageRule::all, ImageRule::minimum}) {
      const Evaluation result = pair_sum(system.particles(), {1, {potential}}, images);
      EXPECT_TRUE(std::isnan(result.energy)) << name;
      EXPECT_TRUE(std::isnan(result.gradient[0])) << name;
    }
  });
}

TEST(ReferencePairSum, InputThatDoesNotFitIsRefused) {
  const PairMixture argon{1, {{LennardJones{}, 2.5}}}, polydisperse{1, {{Polydisperse{}}}};
  const auto refused = [](const System& system, const PairMixture& mixture) {
    EXPECT_THROW(pair_sum(system.particles(), mixture, ImageRule::all), std::invalid_argument);
  };
  System system = two_particles(1.2);
  refused(system, {2, {{LennardJones{}, 2.5}}});
  refused(system, {1, {{LennardJones{}}}});  // without a cutoff
  refused(system, polydisperse);             // without diameters
  system.diameters = {1.0};
  refused(system, polydisperse);
  system.diameters = {1.0, 0.0};
  refused(system, polydisperse);
  system.diameters = {1.0, 1.0};
  EXPECT_NO_THROW(pair_sum(system.particles(), polydisperse, ImageRule::all));
  refused(system, argon);
}

}  // namespace
