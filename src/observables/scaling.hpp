#pragma once

#include <optional>
#include <span>

#include "observables/statistics.hpp"

namespace lanescape {

// D and (DeltaR/g)^2 at one state.
struct ScalingPoint {
  double diffusion;
  double ratio_squared;
};

// How far D follows (DeltaR/g)^2 over several states ([G] 4.3).
struct Scaling {
  Estimate constant;              // mean of D/(DeltaR/g)^2, with its standard error over the states
  std::optional<Estimate> slope;  // of ln D against ln (DeltaR/g)^2: 1 where they are proportional; its error needs three states
  std::optional<double> spread;   // standard deviation of ln(D/(DeltaR/g)^2) over the states
};

// Throws Error(bad_input) without points, or where a number is not above 0.
Scaling scale(std::span<const ScalingPoint> points);

}  // namespace lanescape
