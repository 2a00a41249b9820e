#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/model.hpp"
#include "core/error.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "io/extended_xyz.hpp"
#include "json.hpp"
#include "options.hpp"
#include "output_folder.hpp"

namespace lanescape::program {

// Exit statuses, the contract with other people's scripts.
enum ExitStatus {
  done = 0,
  goal_not_reached = static_cast<int>(ErrorCode::goal_not_reached),
  bad_input_status = static_cast<int>(ErrorCode::bad_input),
  internal_error = static_cast<int>(ErrorCode::internal),
  interrupted_status = static_cast<int>(ErrorCode::interrupted),
};

// Of a run that ended. One that was interrupted may still reach its goal when it is resumed.
inline ExitStatus status_of_run(bool reached, bool interrupted) {
  return interrupted ? interrupted_status : reached ? done : goal_not_reached;
}

// What every subcommand takes.
struct CommonOptions {
  std::uint64_t seed = 1;
  int threads = 1;
  std::string isa = "auto";
  bool quiet = false;
  std::string config, out, resume, resume_or_start;

  void add_to(Options& options);
  // The requested instruction set. Puts its name into `isa`, and so into the resolved run file.
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
  // Throws Error(bad_input) for values that the model does not allow. Options::settle() refuses options without an effect.
  AnyModel resolve() const;
  // The family of the resolved model, whether it has a name or a file, and whether the run generates its particles.
  RunKinds kinds(const AnyModel& resolved, bool generates_start) const;
  // Of soft models.
  Precision resolve_precision() const;
  // Refuses mixed precision in a box that has no neighbour list.
  void check_precision_in(const AnyModel& model, const Box& box, double skin = default_skin) const;
  // The model as one of pair potentials; the message that refuses others names the subcommand.
  PairModel resolve_pair_model(const char* subcommand) const;
  // Likewise as one of sites in states.
  StateMixtureModel resolve_state_mixture(const char* subcommand) const;
};

// The first frame of a file of soft particles. Throws Error(bad_input) naming the file if any frame is malformed or the first one
// has overlaps. `open_axes`: whether the subcommand can use slabs and clusters.
Configuration read_first_frame(const std::string& file, const AnyModel& model, OpenAxes open_axes = OpenAxes::refused);
// The first frame of a file of hard spheres with its radii, of any species or of the model's. Throws Error(bad_input) if any frame
// is malformed.
Configuration read_hard_frame(const std::string& file);
Configuration read_hard_frame(const std::string& file, const HardSphereModel& model);
// remove_rounding_overlaps() of interaction/, whose messages then start with the file's name.
double remove_rounding_overlaps_in(const std::string& file, Configuration& configuration, double tolerance);
// check_soft_separations() of interaction/, whose messages then start with the file's name.
void check_separations_in(const std::string& file, const Configuration& configuration, const AnyModel& model);

// Runs of the program: one subcommand each. `run` computes, returns the JSON for stdout and sets the exit status.
struct Subcommand {
  CLI::App* app;
  std::function<Json(int& status)> run;
};

// All of them; one is required.
std::vector<Subcommand> add_subcommands(CLI::App& app);
Subcommand add_flow(CLI::App& app);
Subcommand add_info(CLI::App& app);
Subcommand add_energy(CLI::App& app);
Subcommand add_overlap(CLI::App& app);
Subcommand add_endpoints(CLI::App& app);
Subcommand add_path(CLI::App& app);
Subcommand add_shorten(CLI::App& app);
Subcommand add_diffusion(CLI::App& app);
Subcommand add_insert(CLI::App& app);
Subcommand add_slab(CLI::App& app);
Subcommand add_analyze(CLI::App& app);
Subcommand add_verify(CLI::App& app);
Subcommand add_cases(CLI::App& app);
Subcommand add_check(CLI::App& app);

// Watches for SIGINT and SIGTERM, and draws a progress bar with rate and remaining time where stderr is a terminal.
class TerminalMonitor final : public RunMonitor {
 public:
  explicit TerminalMonitor(bool quiet);
  ~TerminalMonitor() override;
  void progress(std::string_view stage, double done, double total) override;
  void notice(std::string_view line) override;
  bool stop_requested() const override;

 private:
  struct Bar;
  bool quiet_;
  std::unique_ptr<Bar> bar_;
};

// SIGINT and SIGTERM then ask running work to end at the next whole step; a second signal kills.
void install_signal_handlers();

// The folder of --out or --resume, or none.
OutputFolder open_folder(const CommonOptions& common);

// Writes result.json and the resolved run file if there is a folder, and keeps the folder.
void write_result(OutputFolder& folder, const std::string& subcommand, const toml::table& resolved, const Json& result);
// The same at the end of a run that can be interrupted. The result then says with which status, so that a finished run is known.
void write_result(OutputFolder& folder, const std::string& subcommand, const toml::table& resolved, Json& result, int status);

// A line on stderr unless --quiet.
void say(const CommonOptions& common, const std::string& line);

}  // namespace lanescape::program
