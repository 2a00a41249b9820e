#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "io/toml.hpp"
#include "result_table.hpp"
#include "run_json.hpp"

namespace lanescape::program {

// One setting that tells groups of runs apart.
struct SettingColumn {
  const char* name;       // of its column
  const char* prefix;     // before its value in the names of groups
  const char* unwritten;  // the value that names leave out
};

// In the order of columns and names.
std::span<const SettingColumn> setting_columns();
// The name of the runs with these settings, but for those in `without`: of a group if there are none.
std::string name_of_settings(const ResultRow& settings, std::span<const std::string> without = {});

// The state at which a pair of end points was made.
struct PairState {
  std::size_t particles;
  std::optional<double> density, packing_fraction, temperature, distance;
  std::optional<double> measured_distance;
  std::optional<std::string> distance_species;
};
// From the first end of a pair's file.
PairState read_pair_state(const std::filesystem::path& file, bool hard);

// The settings of a run from its run.toml and result.json, and of path and shorten from their first pair.
ResultRow settings_of(const std::filesystem::path& folder, const std::string& subcommand, const toml::table& options,
                      const RunJson& result);

// A number without the noise of its computation: 9 digits.
double rounded(double value, int digits = 9);

}  // namespace lanescape::program
