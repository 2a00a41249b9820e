#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/model.hpp"
#include "core/archive.hpp"
#include "dispatch/isa.hpp"
#include "path/path_check.hpp"

namespace lanescape {

// A whole path with all that is needed to check it again (docs/FORMATS.md, "Whole paths").
struct PathFile {
  AnyModel model;
  std::string method, isa;                    // what found it
  std::optional<double> landscape_energy;     // E_L of soft particles [epsilon]
  std::vector<Configuration> nodes;           // in the user's order, unwrapped, from R_i to R_f
  std::vector<std::vector<double>> tangents;  // of each segment, unit vectors in kinematic coordinates, user's order
  std::vector<double> multipliers, excess;    // of each node (PathCheck)
  std::vector<double> segment_violation;      // of each segment (PathCheck)
};

// A path and what its certificate says about nodes and segments. Throws what path/path_check.hpp's check_polyline() throws.
PathFile path_file(const AnyModel& model, std::vector<Configuration> nodes, std::optional<double> landscape_energy,
                   const PathCheck& check, const std::string& method, Isa isa);

// HDF5, written atomically, doubles bit for bit.
void write_path_file(const std::filesystem::path& file, const PathFile& path);
// Throws Error(bad_input), with a message that starts with the file, for a file that is no path, cut short or damaged, and for
// contents that do not go together: fewer than 3 nodes, coordinates that are not finite, hard spheres without radii.
PathFile read_path_file(const std::filesystem::path& file);
// Whether the file is HDF5, by its first bytes; false where it cannot be read.
bool is_path_file(const std::filesystem::path& file);

// All frames of an extended XYZ file as nodes, at least 3, and E_L where a comment has the key landscape_energy. Without tangents
// and what a certificate says. Throws Error(bad_input) as ExtendedXyzReader does.
PathFile read_path_frames(const std::filesystem::path& file, const AnyModel& model);
// The key of E_L in comments of frames.
inline constexpr const char* landscape_energy_key = "landscape_energy";

}  // namespace lanescape
