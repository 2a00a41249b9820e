#include "reference/lennard_jones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "pair_systems.hpp"

namespace {

using namespace lanescape::reference;

constexpr std::array kImageRules{ImageRule::all, ImageRule::minimum};
constexpr std::array kTruncations{Truncation::shifted, Truncation::plain, Truncation::tail};

Mixture one_component(double cutoff = 2.5) { return {1, {1.0}, {1.0}, {cutoff}}; }

Mixture kob_andersen() { return {2, {1.0, 1.5, 1.5, 0.5}, {1.0, 0.8, 0.8, 0.88}, {2.5, 2.0, 2.0, 2.2}}; }

Evaluation evaluate(const System& system, const Mixture& mixture, ImageRule images, Truncation truncation) {
  return lennard_jones(system.positions, system.species, system.box, mixture, images, truncation);
}

double u(double r, double epsilon = 1.0, double sigma = 1.0) {
  return 4.0 * epsilon * (std::pow(sigma / r, 12) - std::pow(sigma / r, 6));
}

TEST(ReferenceLennardJones, NoParticlesHaveNoEnergy) {
  for (const ImageRule images : kImageRules)
    for (const Truncation truncation : kTruncations) {
      const Evaluation result = evaluate({{}, {}, {3.0, 4.0, 5.0}}, one_component(), images, truncation);
      EXPECT_EQ(result.energy, 0.0);
      EXPECT_EQ(result.virial, 0.0);
      EXPECT_EQ(result.magnitude, 0.0);
      EXPECT_TRUE(result.gradient.empty());
      EXPECT_TRUE(result.gradient_magnitude.empty());
    }
}

TEST(ReferenceLennardJones, OneParticleInALargeVectorHasNoEnergyAndNoGradient) {
  for (const ImageRule images : kImageRules) {
    const Evaluation result = evaluate({{1.0, -7.0, 3.0}, {0}, {9.0, 9.0, 9.0}}, one_component(), images, Truncation::shifted);
    EXPECT_EQ(result.energy, 0.0);
    EXPECT_EQ(result.gradient, std::vector<double>(3, 0.0));
  }
}

TEST(ReferenceLennardJones, OneParticleInASmallVectorMeetsItsOwnImagesUnlessTheRuleIsMinimumImage) {
  const System alone{{0.3, 0.2, 0.1}, {0}, {1.5, 10.0, 10.0}};
  const Evaluation all = evaluate(alone, one_component(), ImageRule::all, Truncation::plain);
  EXPECT_NEAR(all.energy, u(1.5), 1e-15);  // two images, half each
  EXPECT_NEAR(all.virial, 24.0 * (2.0 * std::pow(1.5, -12) - std::pow(1.5, -6)), 1e-14);
  EXPECT_EQ(all.gradient, std::vector<double>(3, 0.0));
  EXPECT_EQ(evaluate(alone, one_component(), ImageRule::minimum, Truncation::plain).energy, 0.0);
}

TEST(ReferenceLennardJones, TwoParticlesAtTheMinimumHaveEnergyMinusEpsilon) {
  const Evaluation result = evaluate(two_particles(std::pow(2.0, 1.0 / 6.0)), one_component(), ImageRule::all, Truncation::plain);
  EXPECT_NEAR(result.energy, -1.0, 1e-15);
  EXPECT_NEAR(result.virial, 0.0, 1e-14);
  EXPECT_NEAR(largest(result.gradient), 0.0, 1e-14);
}

TEST(ReferenceLennardJones, TwoParticlesAtSigmaRepelWithForceTwentyFour) {
  const Evaluation result = evaluate(two_particles(1.0), one_component(), ImageRule::all, Truncation::plain);
  EXPECT_DOUBLE_EQ(result.energy, 0.0);
  EXPECT_DOUBLE_EQ(result.magnitude, 8.0);
  EXPECT_DOUBLE_EQ(result.virial, 24.0);
  EXPECT_DOUBLE_EQ(result.virial_tensor[0], 24.0);
  EXPECT_DOUBLE_EQ(result.gradient[0], 24.0);  // the particle on the left is pushed to the left
  EXPECT_DOUBLE_EQ(result.gradient[3], -24.0);
  EXPECT_DOUBLE_EQ(result.gradient_magnitude[0], 72.0);
}

TEST(ReferenceLennardJones, PairsOfTwoSpeciesUseTheirOwnParameters) {
  System system = two_particles(0.9);
  const std::array<std::array<double, 2>, 3> epsilon_sigma{{{1.0, 1.0}, {1.5, 0.8}, {0.5, 0.88}}};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) {
      system.species = {a, b};
      const auto [epsilon, sigma] = epsilon_sigma[static_cast<std::size_t>(a + b)];
      const double expected = u(0.9, epsilon, sigma) - u(2.5, epsilon, 1.0);
      const Evaluation result = evaluate(system, kob_andersen(), ImageRule::all, Truncation::shifted);
      EXPECT_NEAR(result.energy, expected, 1e-14 * result.magnitude) << a << b;
    }
}

TEST(ReferenceLennardJones, TheVirialTensorOfOnePairIsTheOuterProductOfSeparationAndForce) {
  const System system{{0.1, 0.2, 0.3, 0.9, -0.4, 0.8}, {0, 0}, {20.0, 20.0, 20.0}};
  const Evaluation result = evaluate(system, one_component(), ImageRule::all, Truncation::plain);
  const Vector d{-0.8, 0.6, -0.5};
  const std::array<std::array<std::size_t, 2>, 6> voigt{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(result.virial_tensor[k], -d[voigt[k][0]] * result.gradient[voigt[k][1]], 1e-13) << k;
}

TEST(ReferenceLennardJones, TheShiftMakesTheEnergyContinuousAtTheCutoff) {
  for (const double cutoff : {1.3, 2.5}) {
    const auto energy = [&](double r, Truncation truncation) {
      return evaluate(two_particles(r), one_component(cutoff), ImageRule::all, truncation).energy;
    };
    const double below = cutoff * (1.0 - 1e-12);
    EXPECT_NEAR(energy(below, Truncation::shifted), 0.0, 1e-10);
    EXPECT_NEAR(energy(below, Truncation::plain), u(cutoff), 1e-10);
    EXPECT_NEAR(energy(1.1, Truncation::shifted), u(1.1) - u(cutoff), 1e-14);
  }
}

TEST(ReferenceLennardJones, APairExactlyAtTheCutoffDoesNotInteract) {
  const Evaluation at = evaluate(two_particles(2.5), one_component(), ImageRule::all, Truncation::plain);
  EXPECT_EQ(at.magnitude, 0.0);
  const Evaluation below = evaluate(two_particles(std::nextafter(2.5, 0.0)), one_component(), ImageRule::all, Truncation::plain);
  EXPECT_GT(below.magnitude, 0.0);
}

TEST(ReferenceLennardJones, TheGradientIsTheDerivativeOfTheEnergy) {
  // In the smallest box the cutoff exceeds L and each pair has several images. Minimum images have kinks there and are not tested.
  const std::vector<System> systems{rattled_fcc({2, 2, 2}, 1.6, 0.15, 2, 1), rattled_fcc({1, 1, 2}, 1.5, 0.1, 2, 2),
                                    rattled_fcc({4, 3, 3}, 1.7, 0.1, 2, 3)};
  for (const System& system : systems)
    for (const Truncation truncation : kTruncations) {
      const bool wide = *std::min_element(system.box.begin(), system.box.end()) >= 2.0 * 2.5;
      const ImageRule images = wide ? ImageRule::minimum : ImageRule::all;
      const Evaluation result = evaluate(system, kob_andersen(), images, truncation);
      const double force = largest(result.gradient);
      for (std::size_t k = 0; k < std::min<std::size_t>(system.positions.size(), 15); ++k) {
        const auto energy = [&](double shift) {
          System moved = system;
          moved.positions[k] += shift;
          return evaluate(moved, kob_andersen(), images, Truncation::shifted).energy;
        };
        EXPECT_NEAR(result.gradient[k], derivative(energy, 1e-4), 1e-7 * force) << k;
      }
    }
}

TEST(ReferenceLennardJones, TheGradientsOfAllParticlesAddUpToZero) {
  const System system = rattled_fcc({2, 2, 3}, 1.5, 0.15, 2, 4);
  const Evaluation result = evaluate(system, kob_andersen(), ImageRule::all, Truncation::shifted);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double sum = 0.0;
    for (std::size_t j = 0; j < system.species.size(); ++j) sum += result.gradient[3 * j + axis];
    EXPECT_NEAR(sum, 0.0, 1e-12 * largest(result.gradient_magnitude));
  }
}

/// Energy with box, positions and, if `stretch_cutoff`, the cutoff stretched by 1 + strain along the given axes.
double strained_energy(const System& system, Mixture mixture, Truncation truncation, std::array<bool, 3> axes, double strain,
                       bool stretch_cutoff) {
  System stretched = system;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (axes[axis]) {
      stretched.box[axis] *= 1.0 + strain;
      for (std::size_t j = axis; j < stretched.positions.size(); j += 3) stretched.positions[j] *= 1.0 + strain;
    }
  if (stretch_cutoff)
    for (double& cutoff : mixture.cutoff) cutoff *= 1.0 + strain;
  return evaluate(stretched, mixture, ImageRule::all, truncation).energy;
}

TEST(ReferenceLennardJones, TheShiftedVirialIsMinusThreeVTimesTheVolumeDerivativeOfTheEnergy) {
  for (const System& system : {rattled_fcc({2, 2, 2}, 1.6, 0.1, 2, 5), rattled_fcc({1, 1, 1}, 1.5, 0.1, 2, 6)}) {
    const Evaluation result = evaluate(system, kob_andersen(), ImageRule::all, Truncation::shifted);
    const auto energy = [&](std::array<bool, 3> axes) {
      return [&, axes](double strain) { return strained_energy(system, kob_andersen(), Truncation::shifted, axes, strain, false); };
    };
    EXPECT_NEAR(result.virial, -derivative(energy({true, true, true}), 3e-5), 1e-7 * result.magnitude);
    EXPECT_NEAR(result.virial_tensor[0], -derivative(energy({true, false, false}), 3e-5), 1e-7 * result.magnitude);
    EXPECT_NEAR(result.virial_tensor[1], -derivative(energy({false, true, false}), 3e-5), 1e-7 * result.magnitude);
    EXPECT_NEAR(result.virial_tensor[2], -derivative(energy({false, false, true}), 3e-5), 1e-7 * result.magnitude);
  }
}

TEST(ReferenceLennardJones, ThePlainAndTailVirialsAreVolumeDerivativesWhenTheCutoffStretchesWithTheVector) {
  // No pair crosses the cutoff then, so that the jump of u does not contribute.
  const System system = rattled_fcc({2, 2, 2}, 1.6, 0.1, 2, 7);
  for (const Truncation truncation : {Truncation::plain, Truncation::tail}) {
    const Evaluation result = evaluate(system, kob_andersen(), ImageRule::all, truncation);
    const auto energy = [&](double strain) {
      return strained_energy(system, kob_andersen(), truncation, {true, true, true}, strain, true);
    };
    EXPECT_NEAR(result.virial, -derivative(energy, 1e-4), 1e-9 * result.magnitude);
  }
}

TEST(ReferenceLennardJones, TheVirialIsTheTraceOfItsTensor) {
  for (const Truncation truncation : kTruncations) {
    const Evaluation result = evaluate(rattled_fcc({2, 1, 1}, 1.6, 0.1, 2, 8), kob_andersen(), ImageRule::all, truncation);
    const auto& w = result.virial_tensor;
    EXPECT_NEAR(result.virial, w[0] + w[1] + w[2], 1e-13 * result.magnitude);
  }
}

TEST(ReferenceLennardJones, BothImageRulesAgreeWhenTheCutoffIsAtMostHalfTheVector) {
  System system = rattled_fcc({4, 3, 3}, 1.7, 0.15, 2, 9);
  system.positions[0] += 3.0 * system.box[0];  // unwrapped positions, as along a path
  system.positions[4] -= 2.0 * system.box[1];
  ASSERT_GE(*std::min_element(system.box.begin(), system.box.end()), 2.0 * 2.5);
  for (const Truncation truncation : kTruncations)
    expect_same(evaluate(system, kob_andersen(), ImageRule::all, truncation),
                evaluate(system, kob_andersen(), ImageRule::minimum, truncation));
}

TEST(ReferenceLennardJones, TheImageRulesDifferWhenTheCutoffExceedsHalfTheVector) {
  const System system = rattled_fcc({3, 3, 3}, std::cbrt(4.0 / 1.2), 0.1, 2, 10);  // 108 particles, L = 4.4814
  EXPECT_NEAR(system.box[0], 4.4814, 5e-5);
  const Evaluation all = evaluate(system, kob_andersen(), ImageRule::all, Truncation::shifted);
  const Evaluation minimum = evaluate(system, kob_andersen(), ImageRule::minimum, Truncation::shifted);
  EXPECT_GT(all.magnitude, minimum.magnitude);
  EXPECT_GT(std::abs(all.energy - minimum.energy), 1e-6 * std::abs(all.energy));
}

TEST(ReferenceLennardJones, MinimumImageTakesOneImageEvenWhenMoreAreWithinTheCutoff) {
  const System system = two_particles(0.9, {2.0, 20.0, 20.0});
  EXPECT_NEAR(evaluate(system, one_component(), ImageRule::minimum, Truncation::plain).energy, u(0.9), 1e-13);
  // Images at 0.9 - 2 and both particles' own images at 2 are within 2.5; the image at 0.9 + 2 is not.
  EXPECT_NEAR(evaluate(system, one_component(), ImageRule::all, Truncation::plain).energy, u(0.9) + u(1.1) + 2.0 * u(2.0), 1e-13);
}

TEST(ReferenceLennardJones, MovingAParticleByWholeVectoresChangesNothing) {
  const System system = rattled_fcc({1, 1, 2}, 1.6, 0.1, 2, 11);
  System moved = system;
  for (std::size_t k = 0; k < moved.positions.size(); ++k)
    moved.positions[k] += (static_cast<double>(k % 7) - 3.0) * moved.box[k % 3];
  expect_same(evaluate(system, kob_andersen(), ImageRule::all, Truncation::tail),
              evaluate(moved, kob_andersen(), ImageRule::all, Truncation::tail));
}

TEST(ReferenceLennardJones, ASupercellOfATinyVectorHasEightTimesItsEnergyAndTheSameGradient) {
  const System cell = rattled_fcc({1, 1, 1}, 1.5, 0.1, 2, 12);  // cutoff 2.5 is more than three half boxes
  System supercell;
  for (std::size_t axis = 0; axis < 3; ++axis) supercell.box[axis] = 2.0 * cell.box[axis];
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 2; ++z)
        for (std::size_t j = 0; j < cell.species.size(); ++j) {
          supercell.positions.push_back(cell.positions[3 * j] + x * cell.box[0]);
          supercell.positions.push_back(cell.positions[3 * j + 1] + y * cell.box[1]);
          supercell.positions.push_back(cell.positions[3 * j + 2] + z * cell.box[2]);
          supercell.species.push_back(cell.species[j]);
        }
  for (const Truncation truncation : kTruncations) {
    const Evaluation once = evaluate(cell, kob_andersen(), ImageRule::all, truncation);
    Evaluation eight = once;
    eight.energy *= 8.0;
    eight.virial *= 8.0;
    eight.magnitude *= 8.0;
    for (double& component : eight.virial_tensor) component *= 8.0;
    eight.gradient.clear();
    for (int copy = 0; copy < 8; ++copy) eight.gradient.insert(eight.gradient.end(), once.gradient.begin(), once.gradient.end());
    eight.gradient_magnitude.assign(eight.gradient.size(), largest(once.gradient_magnitude));
    expect_same(eight, evaluate(supercell, kob_andersen(), ImageRule::all, truncation));
  }
}

TEST(ReferenceLennardJones, TheTailOfOneComponentIsTheTextbookFormula) {
  const System system = rattled_fcc({2, 3, 2}, 1.7, 0.1, 1, 13);
  const double n = static_cast<double>(system.species.size());
  const double rho = n / (system.box[0] * system.box[1] * system.box[2]);
  const double pi = std::numbers::pi;
  for (const double rc : {2.0, 2.5}) {
    const Evaluation plain = evaluate(system, one_component(rc), ImageRule::all, Truncation::plain);
    const Evaluation tail = evaluate(system, one_component(rc), ImageRule::all, Truncation::tail);
    const double energy = n * 8.0 / 3.0 * pi * rho * (std::pow(rc, -9) / 3.0 - std::pow(rc, -3));
    const double virial = n * 16.0 * pi * rho * (2.0 / 3.0 * std::pow(rc, -9) - std::pow(rc, -3));
    EXPECT_NEAR(tail.energy - plain.energy, energy, 1e-13 * tail.magnitude);
    EXPECT_NEAR(tail.virial - plain.virial, virial, 1e-12 * tail.magnitude);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(tail.virial_tensor[axis] - plain.virial_tensor[axis], virial / 3.0, 1e-12 * tail.magnitude);
    for (std::size_t k = 3; k < 6; ++k) EXPECT_EQ(tail.virial_tensor[k], plain.virial_tensor[k]);
    EXPECT_EQ(tail.gradient, plain.gradient);
  }
}

TEST(ReferenceLennardJones, TheTailDoesNotSeeHowEqualParticlesAreNamed) {
  System system = rattled_fcc({2, 2, 2}, 1.7, 0.1, 1, 14);
  const Evaluation one = evaluate(system, one_component(), ImageRule::all, Truncation::tail);
  for (std::size_t j = 0; j < system.species.size(); ++j) system.species[j] = j % 3 == 0 ? 1 : 0;
  const Mixture same{2, {1.0, 1.0, 1.0, 1.0}, {1.0, 1.0, 1.0, 1.0}, {2.5, 2.5, 2.5, 2.5}};
  expect_same(one, evaluate(system, same, ImageRule::all, Truncation::tail));
}

TEST(ReferenceLennardJones, TheTailMakesTheEnergyOfACrystalNearlyIndependentOfTheCutoff) {
  const System system = rattled_fcc({2, 2, 2}, 1.6, 0.1, 2, 15);
  const auto scaled = [](double factor) {
    Mixture mixture = kob_andersen();
    for (double& cutoff : mixture.cutoff) cutoff *= factor;
    return mixture;
  };
  const auto energy = [&](double factor, Truncation truncation) {
    return evaluate(system, scaled(factor), ImageRule::all, truncation).energy;
  };
  const double plain = std::abs(energy(3.0, Truncation::plain) - energy(2.0, Truncation::plain));
  const double tail = std::abs(energy(3.0, Truncation::tail) - energy(2.0, Truncation::tail));
  EXPECT_LT(tail, 0.1 * plain);
}

TEST(ReferenceLennardJones, ThePerfectKobAndersenLatticeOfEqualParticlesHasTheLatticeSumPerParticle) {
  // All particles are A. The shells at a sqrt(k/2) with 12, 6, 24, 12 and 24 neighbours are within 2.5.
  const double constant = std::cbrt(4.0 / 1.2);
  const System system = rattled_fcc({3, 3, 3}, constant, 0.0, 1, 16);
  const std::array<double, 5> neighbours{12.0, 6.0, 24.0, 12.0, 24.0};
  ASSERT_LT(constant * std::sqrt(2.5), 2.5);
  ASSERT_GT(constant * std::sqrt(3.0), 2.5);
  double per_particle = 0.0;
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    per_particle += 0.5 * neighbours[k] * (u(constant * std::sqrt(0.5 * static_cast<double>(k + 1))) - u(2.5));
  const Evaluation result = evaluate(system, kob_andersen(), ImageRule::all, Truncation::shifted);
  EXPECT_NEAR(result.energy, 108.0 * per_particle, 1e-12 * result.magnitude);
}

TEST(ReferenceLennardJones, APositionThatIsNotANumberShowsInTheResult) {
  System system = two_particles(1.2);
  system.positions[1] = std::numeric_limits<double>::quiet_NaN();
  for (const ImageRule images : kImageRules)
    EXPECT_TRUE(std::isnan(evaluate(system, one_component(), images, Truncation::shifted).energy));
}

TEST(ReferenceLennardJones, InputThatDoesNotFitIsRefused) {
  const auto call = [](const System& system, const Mixture& mixture) {
    evaluate(system, mixture, ImageRule::all, Truncation::shifted);
  };
  System system = two_particles(1.2);
  system.species.push_back(0);
  EXPECT_THROW(call(system, one_component()), std::invalid_argument);
  system = two_particles(1.2);
  system.species[1] = 1;
  EXPECT_THROW(call(system, one_component()), std::invalid_argument);
  system.species[1] = -1;
  EXPECT_THROW(call(system, one_component()), std::invalid_argument);
  EXPECT_THROW(call(two_particles(1.2, {10.0, 0.0, 10.0}), one_component()), std::invalid_argument);
  Mixture mixture = one_component();
  mixture.cutoff.clear();
  EXPECT_THROW(call(two_particles(1.2), mixture), std::invalid_argument);
}

}  // namespace
