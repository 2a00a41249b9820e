#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/model.hpp"
#include "core/error.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "options.hpp"
#include "output_folder.hpp"

namespace lanescape::program {

using Json = nlohmann::ordered_json;

}  // namespace lanescape::program

// Compiled once, in json.cpp.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace lanescape::program {

// Exit statuses, the contract with other people's scripts.
enum ExitStatus {
  done = 0,
  goal_not_reached = static_cast<int>(ErrorCode::goal_not_reached),
  bad_input_status = static_cast<int>(ErrorCode::bad_input),
  internal_error = static_cast<int>(ErrorCode::internal),
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
  // Whether the run has a folder for its files, by --out or by --resume.
  RunKind folder_kind() const;
};

// Which model, and how a soft one is cut off.
struct SystemOptions {
  std::string model = "kob-andersen";
  std::string model_file;
  std::optional<double> cutoff;
  std::optional<std::string> images, truncation, composition, precision;

  void add_to(Options& options);
  // Throws Error(bad_input) for values that the model does not allow. Options::settle() refuses those that it has no use for.
  Model resolve() const;
  // The family of the resolved model, whether it has a name or a file, and whether the run generates its particles.
  RunKinds kinds(const Model& resolved, bool generates_start) const;
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
Subcommand add_slab(CLI::App& app);
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
