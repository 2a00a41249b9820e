#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "end_point_options.hpp"
#include "program.hpp"
#include "run/configuration_pair.hpp"

namespace lanescape::program {

// The two end points of a file, checked. Radii that overlap by rounding, up to the relative tolerance, are scaled.
ConfigurationPair read_pair(const std::filesystem::path& file, const AnyModel& model, double tolerance);
// What its writer says was asked of the pair.
AskedDistance read_asked_distance(const std::filesystem::path& file);
// A pair that a run keeps in its folder, with radii scaled already.
ConfigurationPair read_kept_pair(const std::filesystem::path& file, const AnyModel& model, double tolerance);
// All pairs a resumed run was started with: its folder holds a copy of each.
std::vector<ConfigurationPair> read_kept_pairs(const OutputFolder& folder, const AnyModel& model, double tolerance);
// Says so where a pair of a file looks wrapped.
void warn_if_wrapped(const CommonOptions& common, const std::string& file, const ConfigurationPair& pair);

}  // namespace lanescape::program
