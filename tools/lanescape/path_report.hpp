#pragma once

#include <cstddef>
#include <optional>

#include "program.hpp"
#include "run/path_run.hpp"

namespace lanescape::program {

// A path in JSON.
Json path_json(const PathResult& path, const PathMethod& method, const Mixture& mixture);
// Adds the model, its images or the factor that scaled radii of a file, instruction set and precision.
void add_system(Json& json, const SystemOptions& system, const AnyModel& model, std::optional<double> radius_factor, Isa isa);
// DIR/path-0001.extxyz, DIR/path-0001-steps.csv and DIR/path-0001-particles.csv of number 0.
void write_path_files(OutputFolder& folder, std::size_t number, const PathResult& path, const Mixture& mixture);

}  // namespace lanescape::program
