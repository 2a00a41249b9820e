#include "reference/insertion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "reference/lennard_jones.hpp"

namespace {

using namespace lanescape::reference;

struct Fluid {
  std::vector<double> positions;
  std::vector<int> species;
  std::vector<double> diameters;
  Vector box{3.3, 4.1, 5.2};

  Particles particles() const { return {positions, species, box, diameters}; }
};

// Two species, anywhere but within 0.8 of another or of `hole`.
Fluid random_fluid(const Vector& hole) {
  std::mt19937 random(3);
  Fluid fluid;
  std::vector<Vector> taken{hole};
  const auto far = [&](const Vector& p) {
    for (const Vector& q : taken) {
      double squared = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = p[axis] - q[axis], nearest = d - fluid.box[axis] * std::nearbyint(d / fluid.box[axis]);
        squared += nearest * nearest;
      }
      if (squared < 0.64) return false;
    }
    return true;
  };
  while (fluid.species.size() < 30) {
    Vector p;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = fluid.box[axis] * static_cast<double>(random()) / 4294967296.0;
    if (!far(p)) continue;
    taken.push_back(p);
    fluid.positions.insert(fluid.positions.end(), p.begin(), p.end());
    fluid.species.push_back(fluid.species.size() % 3 == 0 ? 1 : 0);
  }
  return fluid;
}

const Vector hole{1.1, 3.9, 0.2};

PairMixture kob_andersen(Truncation truncation) {
  return lennard_jones_mixture({2, {1.0, 1.5, 1.5, 0.5}, {1.0, 0.8, 0.8, 0.88}, {2.5, 2.0, 2.0, 2.2}}, truncation);
}

void expect_energy_to_rise_by_the_probes(const Fluid& fluid, const Probed& probed, const PairMixture& mixture) {
  Fluid with = fluid;
  with.positions.insert(with.positions.end(), hole.begin(), hole.end());
  with.species.push_back(probed.species);
  if (!fluid.diameters.empty()) with.diameters.push_back(probed.diameter);
  const Evaluation before = pair_sum(fluid.particles(), mixture, ImageRule::all);
  const Evaluation after = pair_sum(with.particles(), mixture, ImageRule::all);
  const Probe found = probe(probed, fluid.particles(), mixture);
  EXPECT_NE(found.energy, 0.0);
  EXPECT_NEAR(found.energy, after.energy - before.energy, 1e-14 * after.magnitude);
  EXPECT_NEAR(found.magnitude, after.magnitude - before.magnitude, 1e-13 * after.magnitude);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(found.gradient[axis], after.gradient[3 * fluid.species.size() + axis], 1e-14 * found.gradient_magnitude[axis]);
}

TEST(ReferenceProbe, EnergyIsWhatTheFluidsRisesByWhenTheParticleIsPutThere) {
  for (const Truncation truncation : {Truncation::shifted, Truncation::plain, Truncation::tail, Truncation::smooth})
    for (const int species : {0, 1})
      expect_energy_to_rise_by_the_probes(random_fluid(hole), {hole, species}, kob_andersen(truncation));
}

TEST(ReferenceProbe, AProbeOfAnyFormAndDiameterIsThatParticle) {
  Fluid fluid = random_fluid(hole);
  const PairPotential yukawa{Yukawa{2.0, 1.0, 1.5}, 4.0, Truncation::tail};
  expect_energy_to_rise_by_the_probes(fluid, {hole, 1}, {2, std::vector(4, yukawa)});
  for (std::size_t j = 0; j < fluid.species.size(); ++j) fluid.diameters.push_back(0.7 + 0.03 * static_cast<double>(j));
  fluid.box = {3.3, 4.1, 1.3};  // the probe meets its own images
  for (const double diameter : {0.8, 1.4})
    expect_energy_to_rise_by_the_probes(fluid, {hole, 1, diameter}, {2, std::vector(4, PairPotential{Polydisperse{}})});
}

TEST(ReferenceProbe, GradientIsThatOfTheEnergy) {
  const Fluid fluid = random_fluid(hole);
  const PairMixture mixture = kob_andersen(Truncation::shifted);
  const auto energy = [&](std::size_t axis, double by) {
    Vector moved = hole;
    moved[axis] += by;
    return probe({moved}, fluid.particles(), mixture).energy;
  };
  const Probe here = probe({hole}, fluid.particles(), mixture);
  constexpr double h = 1e-4;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double difference =
        (8.0 * (energy(axis, h) - energy(axis, -h)) - (energy(axis, 2.0 * h) - energy(axis, -2.0 * h))) / (12.0 * h);
    EXPECT_NEAR(here.gradient[axis], difference, 1e-8 * here.gradient_magnitude[axis]);
  }
}

TEST(ReferenceProbe, ASpeciesOrADiameterThatDoesNotFitIsRefused) {
  const Fluid fluid = random_fluid(hole);
  EXPECT_THROW(probe({hole, 2}, fluid.particles(), kob_andersen(Truncation::shifted)), std::invalid_argument);
  EXPECT_THROW(probe({hole, -1}, fluid.particles(), kob_andersen(Truncation::shifted)), std::invalid_argument);
  EXPECT_THROW(probe({hole, 0, 0.0}, fluid.particles(), kob_andersen(Truncation::shifted)), std::invalid_argument);
}

// One particle at the origin, and nothing else within reach.
Probe beside_one(const Vector& p) {
  const std::vector<double> origin{0.0, 0.0, 0.0};
  const std::vector<int> species{0};
  return probe({p}, {origin, species, {20.0, 20.0, 20.0}, {}}, {1, {{LennardJones{}, 3.0, Truncation::plain}}});
}

TEST(ReferenceUsher, TheFirstStepFromAnOverlapEndsAtContact) {
  const UsherRule rule{-0.5, 0.1};
  const Vector start{0.1, 0.2, 0.2};  // r = 0.3
  const Probe here = beside_one(start);
  ASSERT_GT(here.energy, rule.overlap_energy);
  const Vector step = usher_step(rule, here.energy, here.gradient);
  // (4/U)^(1/12) leaves the attraction out: less than 1e-4 of r here.
  EXPECT_NEAR(std::hypot(start[0] + step[0], start[1] + step[1], start[2] + step[2]), rule.contact, 1e-4);
}

TEST(ReferenceUsher, AStepIsNewtonsAlongTheGradientOrTheLongestAllowed) {
  const UsherRule rule{-0.5, 0.1};
  const Vector step = usher_step(rule, -0.3, {0.0, -4.0, 3.0});
  EXPECT_NEAR(step[1], 0.04 * 0.8, 1e-15);
  EXPECT_NEAR(step[2], -0.04 * 0.6, 1e-15);
  const Vector longest = usher_step(rule, 7.0, {0.0, -4.0, 3.0});
  EXPECT_NEAR(std::hypot(longest[1], longest[2]), 0.1, 1e-15);
  // From below the target the way is up.
  EXPECT_LT(usher_step(rule, -0.7, {0.0, -4.0, 3.0})[1], 0.0);
}

TEST(ReferenceUsher, FindsTheTargetBesideAParticleAndErrsQuadratically) {
  const UsherRule rule{-0.5, 0.1};
  std::vector<double> errors;
  const UsherTrial trial = usher_trial(rule, 1e-13, 100, {0.1, 0.2, 0.2}, [&](const Vector& p) {
    const Probe here = beside_one(p);
    errors.push_back(std::abs(here.energy - rule.target));
    return here;
  });
  ASSERT_TRUE(trial.found);
  EXPECT_NEAR(trial.energy, rule.target, 1e-13);
  EXPECT_EQ(trial.evaluations, errors.size());
  // 4 (x^2 - x) = -1/2 has x = r^-6 = (1 + sqrt(1/2))/2 on the steep side.
  EXPECT_NEAR(std::hypot(trial.position[0], trial.position[1], trial.position[2]), std::pow(0.5 + std::sqrt(0.125), -1.0 / 6.0),
              1e-13);
  // Newton's error is u''/(2 u'^2) times the square of the last one, 0.74 there.
  std::size_t near = 0;
  for (std::size_t k = 1; k + 1 < errors.size(); ++k) {
    if (errors[k] > 0.05 || errors[k + 1] < 1e-13) continue;
    EXPECT_LT(errors[k + 1], 2.0 * errors[k] * errors[k]) << k;
    ++near;
  }
  EXPECT_GE(near, 2U);
}

TEST(ReferenceUsher, GivesUpAtTheFirstUphillMove) {
  // The pair has no energy below -1.
  const UsherRule rule{-1.5, 0.1};
  const UsherTrial trial = usher_trial(rule, 1e-3, 100, {0.1, 0.2, 0.2}, beside_one);
  EXPECT_FALSE(trial.found);
  EXPECT_LT(trial.evaluations, 20U);
  const UsherTrial cut = usher_trial(rule, 1e-3, 3, {0.1, 0.2, 0.2}, beside_one);
  EXPECT_EQ(cut.evaluations, 3U);
}

}  // namespace
