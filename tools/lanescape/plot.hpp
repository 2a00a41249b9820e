#pragma once

#include <filesystem>

namespace lanescape::program {

// Throws Error(bad_input) where --plot cannot work: no plot.py beside the program, or no Python that runs it. To be called before a
// run, which may take hours.
void check_plots();

// Draws the PNGs of a run's folder with plot.py (matplotlib). Where that fails, a line on stderr says so, and `status` is no longer
// `done`; the results are already written.
void draw_plots(const std::filesystem::path& folder, int& status);

}  // namespace lanescape::program
