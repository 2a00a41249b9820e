#include "stepper/trial_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "one_particle.hpp"

namespace lanescape {
namespace {

constexpr double bound_reach = 0.1, trial_step = 0.01;

// Keeps the centres it is asked about.
class KeepingBound final : public SegmentBound {
 public:
  explicit KeepingBound(std::vector<AlignedArray>& centres) : centres_(&centres) {}
  double reach() const override { return bound_reach; }
  SegmentLoss around(const AlignedArray& centre) override {
    centres_->push_back(centre);
    return {0.5, 2.0, 0.01};
  }

 private:
  std::vector<AlignedArray>* centres_;
};

class WithKeepingBound final : public testing::OneParticle {
 public:
  explicit WithKeepingBound(std::vector<AlignedArray>& centres) : centres_(&centres) {}
  std::unique_ptr<SegmentBound> segment_bound(double) const override { return std::make_unique<KeepingBound>(*centres_); }

 private:
  double value(double) const override { return 0.0; }
  double slope_over_r(double) const override { return 0.0; }

  std::vector<AlignedArray>* centres_;
};

TEST(TrialBound, RestsOnACentreWithinReachOfTheTrialHoweverLongTheLastStepWas) {
  std::vector<AlignedArray> centres;
  const WithKeepingBound landscape(centres);
  TrialBound bound(landscape, trial_step);
  double x = 0.0;
  for (const double length : {0.0, 0.01, 0.02, 0.015, 0.3, 0.01, 5.0, 0.04, 0.01}) {
    x += length;
    bound.moved(length);
    bound.exceeds(landscape.array({x, 0.0, 0.0}), 0.0, 0.0, 0.0);
    // On the trial two particles can move apart by sqrt 2 of its length.
    const double moved_apart = std::fabs(landscape.point(centres.back())[0] - x);
    EXPECT_LE(moved_apart + std::numbers::sqrt2 * trial_step, bound_reach) << length;
  }
  EXPECT_LT(centres.size(), 9u);
}

TEST(TrialBound, ProvesATrialForbiddenByItsTangentLessTheLoss) {
  std::vector<AlignedArray> centres;
  const WithKeepingBound landscape(centres);
  TrialBound bound(landscape, trial_step);
  const AlignedArray here = landscape.array({0.0, 0.0, 0.0});
  // 3 + 0.01 (10 - 0.5) - 0.01^2 2/2 - 0.01.
  EXPECT_TRUE(bound.exceeds(here, 3.0, 10.0, 3.0848));
  EXPECT_FALSE(bound.exceeds(here, 3.0, 10.0, 3.0850));
}

}  // namespace
}  // namespace lanescape
