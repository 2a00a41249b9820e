#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "io/toml.hpp"

namespace lanescape::program {

// Key of a result: the exit status of the run that it belongs to.
inline constexpr const char* exit_status_key = "exit_status";

// Refuses options, of the command line or of a run file, that differ from those that the run in a folder was started with. `stored`
// is that run's resolved run file. Options that change no result are not compared.
void refuse_contradictions(const CLI::App& subcommand, const toml::table& stored, const std::string& stored_file);
void refuse_contradictions(const CLI::App& subcommand, const toml::table& given, const toml::table& stored,
                           const std::string& stored_file);

// What a run that has ended left in its folder.
struct FinishedRun {
  std::string result;  // the text of result.json
  int status;
};
// Nothing if the run was interrupted or killed, or does not say how it ended.
std::optional<FinishedRun> finished_run(const std::filesystem::path& folder);

}  // namespace lanescape::program
