#pragma once

#include <cstddef>
#include <vector>

#include <lanescape/lanescape.h>
#include <lanescape/path.hpp>

namespace lanescape::capi {

// The defaults for NULL.
PathSettings path_settings_of(const lanescape_path_settings* given);
// Copies one frame of a path to the caller.
void copy_frame(const std::vector<std::vector<double>>& frames, std::size_t frame, double* positions);

}  // namespace lanescape::capi
