#include "observables/scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/error.hpp"

namespace lanescape {
namespace {

TEST(Scaling, ProportionalNumbersHaveSlopeOneAndNoSpread) {
  const Scaling scaling = scale(std::vector<ScalingPoint>{{0.2, 0.1}, {0.02, 0.01}, {0.002, 0.001}});
  EXPECT_NEAR(scaling.constant.value, 2.0, 1e-14);
  EXPECT_NEAR(scaling.constant.error.value(), 0.0, 1e-14);
  EXPECT_NEAR(scaling.slope->value, 1.0, 1e-14);
  EXPECT_NEAR(scaling.spread.value(), 0.0, 1e-7);
}

TEST(Scaling, APowerShowsInTheSlopeAndInTheSpread) {
  std::vector<ScalingPoint> points;
  for (const double ratio : {0.1, 0.2, 0.4}) points.push_back({3.0 * std::pow(ratio, 1.5), ratio});
  const Scaling scaling = scale(points);
  EXPECT_NEAR(scaling.slope->value, 1.5, 1e-13);
  // ln(D/ratio) differs by 0.5 ln 2 from state to state.
  EXPECT_NEAR(scaling.spread.value(), 0.5 * std::log(2.0), 1e-13);
  EXPECT_NEAR(scaling.constant.value, std::sqrt(0.1) * (1.0 + std::sqrt(2.0) + 2.0), 1e-13);
}

TEST(Scaling, OneStateHasAConstantAlone) {
  const Scaling scaling = scale(std::vector<ScalingPoint>{{0.3, 0.1}});
  EXPECT_NEAR(scaling.constant.value, 3.0, 1e-14);
  EXPECT_FALSE(scaling.constant.error || scaling.slope || scaling.spread);
}

TEST(Scaling, NumbersThatAreNotAboveZeroAreRefused) {
  EXPECT_THROW(scale(std::vector<ScalingPoint>{}), Error);
  EXPECT_THROW(scale(std::vector<ScalingPoint>{{-0.1, 0.1}}), Error);
  EXPECT_THROW(scale(std::vector<ScalingPoint>{{0.1, 0.0}}), Error);
}

}  // namespace
}  // namespace lanescape
