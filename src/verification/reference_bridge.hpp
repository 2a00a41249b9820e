#pragma once

#include "configuration/configuration.hpp"
#include "configuration/lennard_jones_model.hpp"
#include "reference/lennard_jones.hpp"

namespace lanescape {

// What the scalar reference says about a configuration; results in the user's order of particles. O(N^2 images).
reference::Evaluation evaluate_reference(const LennardJonesModel& model, const Configuration& configuration);

}  // namespace lanescape
