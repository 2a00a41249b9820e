#pragma once

#include <filesystem>

#include "program.hpp"

namespace lanescape::program {

// Draws the PNGs of a run's folder with tools/plot.py (matplotlib). What goes wrong there is a message, not a failure of the
// run, whose results are already written.
void draw_plots(const std::filesystem::path& folder, const CommonOptions& common);

}  // namespace lanescape::program
