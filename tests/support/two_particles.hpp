#pragma once

#include <cmath>
#include <numbers>

#include "run/configuration_pair.hpp"

namespace lanescape::testing {

// Two particles with a resting centre, `r_before` apart, before and after a rotation by `degrees` that leaves them `r_after` apart.
inline ConfigurationPair turned(double r_before, double r_after, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const auto around = [](double x, double y) {
    return Configuration{{{10.0, 10.0, 10.0}}, {0, 0}, {5.0 + x, 5.0 + y, 5.0, 5.0 - x, 5.0 - y, 5.0}};
  };
  return {around(0.5 * r_before, 0.0), around(0.5 * r_after * std::cos(angle), 0.5 * r_after * std::sin(angle))};
}

}  // namespace lanescape::testing
