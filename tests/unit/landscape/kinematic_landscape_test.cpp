#include "landscape/kinematic_landscape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "configuration/lattice.hpp"
#include "configuration/pair_model.hpp"
#include "landscape/pair_landscape.hpp"
#include "memory_archive.hpp"

namespace lanescape {
namespace {

// Kob and Andersen's mixture with forces that go to zero smoothly.
PairModel mixture(double first_mass, double second_mass) {
  PairModel model = kob_andersen();
  model.species[0].mass = first_mass;
  model.species[1].mass = second_mass;
  model.truncation = Truncation::smooth;
  return model;
}

// A lattice with some empty sites, so that there are forces.
struct System {
  PairModel model;
  Configuration configuration;
  ParticleLayout layout;
  KinematicMetric metric;

  System(double first_mass, double second_mass)
      : model(mixture(first_mass, second_mass)),
        configuration(fcc_start(model, 25, 1.0, 1)),
        layout(configuration.species, 2),
        metric(model, layout) {}
  std::unique_ptr<PairLandscape> inner() const {
    return std::make_unique<PairLandscape>(model, configuration.box, layout, choose_isa("auto"));
  }
  AlignedArray positions() const { return layout.to_slots(configuration.positions); }
};

TEST(KinematicMetric, ScalesEachParticleByTheRootOfItsMassOverTheMeanMass) {
  const System system(1.0, 3.0);
  const double mean = (20.0 * 1.0 + 5.0 * 3.0) / 25.0;
  EXPECT_FALSE(system.metric.is_euclidean());
  AlignedArray q(system.layout.dimension(), 1.0);
  system.metric.to_kinematic(q);
  for (std::size_t j = 0; j < 25; ++j)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_DOUBLE_EQ(q[axis * system.layout.slots() + system.layout.slot_of(j)],
                       std::sqrt((system.configuration.species[j] == 0 ? 1.0 : 3.0) / mean));
  system.metric.to_positions(q);
  for (const double x : q) EXPECT_DOUBLE_EQ(x, 1.0);  // padding too
}

TEST(KinematicMetric, IsEuclideanWhereMassesAreEqualWhateverTheyAre) {
  const System system(7.3, 7.3);
  EXPECT_TRUE(system.metric.is_euclidean());
  AlignedArray q = system.positions();
  system.metric.to_kinematic(q);
  EXPECT_EQ(q, system.positions());
}

TEST(KinematicLandscape, HasTheEnergyOfThePositions) {
  const System system(1.0, 3.0);
  KinematicLandscape landscape(system.inner(), system.metric);
  AlignedArray q = system.positions();
  system.metric.to_kinematic(q);
  const double expected = system.inner()->energy(system.positions());
  EXPECT_NEAR(landscape.energy(q), expected, 1e-12 * std::fabs(expected));
  EXPECT_EQ(landscape.dimension(), system.layout.dimension());
  EXPECT_EQ(landscape.particles(), 25u);
}

TEST(KinematicLandscape, GradientIsTheDerivativeWithRespectToKinematicCoordinates) {
  const System system(1.0, 3.0);
  KinematicLandscape landscape(system.inner(), system.metric);
  AlignedArray q = system.positions(), gradient(q.size(), 7.0), alone(q.size(), 7.0);
  system.metric.to_kinematic(q);
  EXPECT_EQ(landscape.energy_and_gradient(q, gradient), landscape.energy(q));
  landscape.gradient(q, alone);
  EXPECT_EQ(alone, gradient);
  const double h = 1e-5;
  double largest = 0.0;
  for (std::size_t j = 0; j < 25; ++j) {
    const std::size_t k = system.layout.slot_of(j) + j % 3 * system.layout.slots();
    const double at = q[k];
    q[k] = at + h;
    const double above = landscape.energy(q);
    q[k] = at - h;
    const double below = landscape.energy(q);
    q[k] = at;
    EXPECT_NEAR(gradient[k], (above - below) / (2.0 * h), 1e-6);
    largest = std::max(largest, std::fabs(gradient[k]));
  }
  EXPECT_GT(largest, 1.0);
}

// A landscape with hidden state.
class WithState final : public SoftLandscape {
 public:
  explicit WithState(double state) : state_(state), algebra_(kernel_table(choose_isa("auto"))) {}
  std::size_t dimension() const override { return 24; }
  std::size_t particles() const override { return 1; }
  const VectorAlgebra& algebra() const override { return algebra_; }
  double energy(const AlignedArray&) override { return state_; }
  double energy_and_gradient(const AlignedArray&, AlignedArray&) override { return state_; }
  void exchange(Archive& archive) override { archive.field("state", state_); }

 private:
  double state_;
  VectorAlgebra algebra_;
};

TEST(KinematicLandscape, HandsOnTheStateOfTheLandscapeWithin) {
  const System system(1.0, 3.0);
  KinematicLandscape one(std::make_unique<WithState>(1.0), system.metric), two(std::make_unique<WithState>(2.0), system.metric);
  testing::hand_on(one, two);
  EXPECT_EQ(two.energy(system.positions()), 1.0);
}

}  // namespace
}  // namespace lanescape
