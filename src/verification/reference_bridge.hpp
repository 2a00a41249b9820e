#pragma once

#include <array>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "reference/insertion.hpp"
#include "reference/pair_sum.hpp"

namespace lanescape {

// Evaluates the scalar reference, in the user's order of particles. O(N^2) times the number of images.
reference::Evaluation evaluate_reference(const PairModel& model, const Configuration& configuration);

// Evaluates the scalar reference of a probe of one species in a fluid; all images count.
reference::Probe probe_reference(const PairModel& model, const Configuration& fluid, const std::array<double, 3>& position,
                                 int species, double diameter = 1.0);

}  // namespace lanescape
