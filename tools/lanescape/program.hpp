#pragma once

#include <toml++/toml.h>
#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/model.hpp"
#include "core/error.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "output_folder.hpp"

namespace lanescape::program {

using Json = nlohmann::ordered_json;

// Exit statuses, the contract with other people's scripts.
enum ExitStatus {
  done = 0,
  goal_not_reached = static_cast<int>(ErrorCode::goal_not_reached),
  bad_input_status = static_cast<int>(ErrorCode::bad_input),
  internal_error = static_cast<int>(ErrorCode::internal),
};

// The options of one subcommand: CLI11 reads them from the command line, and this remembers how to write their final values
// into the resolved run file, under the same names.
class Options {
 public:
  explicit Options(CLI::App& app) : app_(&app) {}

  template <class T>
  CLI::Option* add(const std::string& name, T& value, const std::string& description) {
    writers_.push_back([key = name.substr(2), &value](toml::table& table) { write(table, key, value); });
    CLI::Option* option = app_->add_option(name, value, description)->capture_default_str();
    // CLI11 2.1 takes an empty text for no value or zero, and brings counts that are negative or too large into range.
    if constexpr (std::is_same_v<T, std::uint64_t> || std::is_same_v<T, std::optional<std::uint64_t>>) option->check(&count_fault);
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::optional<double>>) option->check(&number_fault);
    return option;
  }
  // FILE or FILES, under the same name in small letters in the run file.
  template <class T>
  CLI::Option* add_positional(const std::string& name, T& value, const std::string& description) {
    writers_.push_back([key = CLI::detail::to_lower(name), &value](toml::table& table) { write(table, key, value); });
    return app_->add_option(name, value, description);
  }
  CLI::Option* add_flag(const std::string& name, bool& value, const std::string& description) {
    writers_.push_back([key = name.substr(2), &value](toml::table& table) { write(table, key, value); });
    return app_->add_flag(name, value, description);
  }
  toml::table resolved() const {
    toml::table table;
    for (const auto& writer : writers_) writer(table);
    return table;
  }
  CLI::App& app() { return *app_; }

 private:
  // What is wrong with the text of a number; empty where nothing is, as CLI11 wants it.
  static std::string count_fault(const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool sound = error == std::errc() && end == text.data() + text.size();
    return sound ? "" : "'" + text + "' is not allowed: a whole number from 0 to 18446744073709551615 is needed";
  }
  static std::string number_fault(const std::string& text) { return text.empty() ? "'' is not allowed: a number is needed" : ""; }

  static void write(toml::table& table, const std::string& key, bool value) { table.insert_or_assign(key, value); }
  static void write(toml::table& table, const std::string& key, double value) { table.insert_or_assign(key, value); }
  static void write(toml::table& table, const std::string& key, int value) {
    table.insert_or_assign(key, static_cast<std::int64_t>(value));
  }
  static void write(toml::table& table, const std::string& key, std::uint64_t value) {
    // TOML's integers have a sign; a text is read back just the same.
    if (value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      table.insert_or_assign(key, static_cast<std::int64_t>(value));
    else
      table.insert_or_assign(key, std::to_string(value));
  }
  static void write(toml::table& table, const std::string& key, const std::string& value) {
    if (!value.empty()) table.insert_or_assign(key, value);
  }
  static void write(toml::table& table, const std::string& key, const std::vector<std::string>& values) {
    toml::array array;
    for (const auto& value : values) array.push_back(value);
    if (!array.empty()) table.insert_or_assign(key, std::move(array));
  }
  template <class T>
  static void write(toml::table& table, const std::string& key, const std::optional<T>& value) {
    if (value) write(table, key, *value);
  }

  CLI::App* app_;
  std::vector<std::function<void(toml::table&)>> writers_;
};

// What every subcommand takes.
struct CommonOptions {
  std::uint64_t seed = 1;
  int threads = 1;
  std::string isa = "auto";
  bool quiet = false;
  std::string config, out, resume;

  void add_to(Options& options);
  // The instruction set asked for; `isa` then holds its name, so that the resolved run file does.
  Isa resolve_isa();
  // Refuses a thread count below 1.
  void check() const;
};

// Which model, and how a soft one is cut off.
struct SystemOptions {
  std::string model = "kob-andersen";
  std::string model_file;
  std::optional<double> cutoff;
  std::optional<std::string> images, truncation, composition, precision;

  void add_to(Options& options);
  // Throws Error(bad_input) for options of soft models with hard spheres.
  Model resolve() const;
  // Of soft models.
  Precision resolve_precision() const;
  // Refuses mixed precision in a box where it is not to be had.
  void check_precision_in(const Model& model, const Box& box, double skin = default_skin) const;
  // For a subcommand that knows Lennard-Jones mixtures only, which the message for others names.
  PairModel resolve_pair_model(const char* subcommand) const;
};

// The first frame of a file of soft particles, all of which must be sound, without overlaps; throws Error(bad_input) naming the
// file.
Configuration read_first_frame(const std::string& file, const Model& model);
// The first frame of a file of hard spheres, all of which must be sound, with its radii as they are: with any species, or the
// model's.
Configuration read_hard_frame(const std::string& file);
Configuration read_hard_frame(const std::string& file, const HardSphereModel& model);
// remove_rounding_overlaps() of interaction/ with the file's name before what it says.
double remove_rounding_overlaps_in(const std::string& file, Configuration& configuration, double tolerance);
// check_soft_separations() of interaction/ with the file's name before what it says.
void check_separations_in(const std::string& file, const Configuration& configuration, const Model& model);

// Runs of the program: one subcommand each. `run` computes, returns the JSON for stdout and sets the exit status.
struct Subcommand {
  CLI::App* app;
  std::function<Json(int& status)> run;
};

Subcommand add_info(CLI::App& app);
Subcommand add_energy(CLI::App& app);
Subcommand add_overlap(CLI::App& app);
Subcommand add_endpoints(CLI::App& app);
Subcommand add_path(CLI::App& app);
Subcommand add_diffusion(CLI::App& app);
Subcommand add_insert(CLI::App& app);
Subcommand add_verify(CLI::App& app);

// Watches for SIGINT and SIGTERM, and draws a progress bar with rate and remaining time where stderr is a terminal.
class TerminalMonitor final : public RunMonitor {
 public:
  explicit TerminalMonitor(bool quiet);
  ~TerminalMonitor() override;
  void progress(std::string_view stage, double done, double total) override;
  bool stop_requested() const override;

 private:
  struct Bar;
  std::unique_ptr<Bar> bar_;
};

// From now on SIGINT and SIGTERM ask running work to end at the next whole step; a second one kills.
void install_signal_handlers();

// The folder of --out or --resume, or none.
OutputFolder open_folder(const CommonOptions& common);

// The last act of a run: result.json and the resolved run file, where there is a folder, which is kept from here on.
void write_result(OutputFolder& folder, const std::string& subcommand, const toml::table& resolved, const Json& result);

// A line on stderr unless --quiet.
void say(const CommonOptions& common, const std::string& line);

}  // namespace lanescape::program
