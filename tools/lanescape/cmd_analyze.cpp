#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "analysis_groups.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "program.hpp"

namespace lanescape::program {
namespace {

struct AnalyzeState {
  CommonOptions common;
  std::vector<std::string> folders;
  std::uint64_t bootstrap = 2000;
};

void check_folders(const std::vector<std::string>& folders) {
  std::set<std::filesystem::path> known;
  for (const std::string& folder : folders) {
    std::error_code ignored;
    const auto place = std::filesystem::weakly_canonical(folder, ignored);
    if (!known.insert(place).second) throw_bad_input(fmt::format("{}: the run is named twice", folder));
  }
}

std::vector<AnalysedRun> read_runs(const AnalyzeState& state) {
  check_folders(state.folders);
  std::vector<AnalysedRun> runs(state.folders.size());
  for_each_block(state.common.threads, runs.size(), [&](std::size_t k) { runs[k] = read_analysed_run(state.folders[k]); });
  return runs;
}

void write_files(OutputFolder& folder, const std::vector<RunGroup>& groups) {
  if (!folder.exists()) return;
  write_table(folder, "groups.csv", groups_table(groups), "");
  write_table(folder, "means.csv", means_table(groups), "");
  write_table(folder, "distributions.csv", distributions_table(groups), "");
}

Json run_analyze(AnalyzeState& state, Options& options, int& status) {
  state.common.check();
  state.common.resolve_isa();  // refuses unknown ones
  options.settle({});
  if (state.bootstrap < 100 || state.bootstrap > 1000000)
    throw_bad_input(fmt::format("--bootstrap: {} is not allowed: from 100 to 1000000", state.bootstrap));
  std::vector<RunGroup> groups = group_runs(read_runs(state));
  const BootstrapOptions bootstrap{
      .resamples = static_cast<std::size_t>(state.bootstrap), .seed = state.common.seed, .threads = state.common.threads};
  for (RunGroup& group : groups) average(group, bootstrap);
  OutputFolder folder = open_folder(state.common);
  Json result;
  result["groups"] = groups_json(groups);
  result["bootstrap"] = state.bootstrap;
  write_files(folder, groups);
  status = done;
  write_result(folder, "analyze", options.resolved(), result, status);
  return result;
}

}  // namespace

Subcommand add_analyze(CLI::App& app) {
  const auto options = std::make_shared<Options>(
      app, "analyze", "Pool finished runs over a sweep: means with errors, distributions, fits, and D against (DeltaR/g)^2");
  const auto state = std::make_shared<AnalyzeState>();
  options->add_positional("RUN", state->folders, "folders of finished runs of endpoints, path, shorten and diffusion").required();
  options->add("--bootstrap", state->bootstrap, "resamples of the 95 % intervals of means");
  state->common.add_to(*options);
  return {&options->app(), [=](int& status) { return run_analyze(*state, *options, status); }};
}

}  // namespace lanescape::program
