#pragma once

#include <filesystem>

#include "program.hpp"

namespace lanescape::program {

// Draws the PNGs of a run's folder with tools/plot.py (matplotlib). An error there is a message and no failure of
// the run, whose results are already written.
void draw_plots(const std::filesystem::path& folder, const CommonOptions& common);

}  // namespace lanescape::program
