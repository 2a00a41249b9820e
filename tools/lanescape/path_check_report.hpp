#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "program.hpp"
#include "run/path_file.hpp"

namespace lanescape::program {

// A path of HDF5, with its own model, or the frames of an extended XYZ file as nodes of `model`. Throws Error(bad_input).
PathFile read_whole_path(const std::filesystem::path& file, const AnyModel& model);

// The certificate of a written path, computed from its nodes alone. With a file of two end points, the path must run between them,
// in either direction, and be of the same system. Throws Error(bad_input), with a message that names the file.
Json check_file(const std::string& file, const PathFile& path, const std::string& pair_file, double overlap_tolerance, Isa isa,
                int threads);

// Writes a path that is given by all of its nodes, with its certificate, to DIR/path-0001.h5 of number 0.
void write_whole_path(const OutputFolder& folder, std::size_t number, const AnyModel& model,
                      const std::vector<Configuration>& nodes, std::optional<double> landscape_energy, const PathCheck& check,
                      const std::string& method, Isa isa);
// A row for each node: what a figure along the path shows (docs/FORMATS.md).
void write_node_table(std::ostream& out, const AnyModel& model, const std::vector<Configuration>& nodes, const PathCheck& check,
                      Isa isa);

}  // namespace lanescape::program
