#pragma once

#include <array>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "reference/insertion.hpp"
#include "reference/lennard_jones.hpp"

namespace lanescape {

// What the scalar reference says about a configuration; results in the user's order of particles. O(N^2 images).
reference::Evaluation evaluate_reference(const PairModel& model, const Configuration& configuration);

// What a probe of a species feels in a fluid; all images.
reference::Probe probe_reference(const PairModel& model, const Configuration& fluid, const std::array<double, 3>& position,
                                 int species);

}  // namespace lanescape
