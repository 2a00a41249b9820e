#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/extended_xyz.hpp"
#include "program.hpp"
#include "verification/cases.hpp"
#include "verification/junit.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape::program {
namespace {

// The user's own files, under both image rules.
void add_files(std::vector<PairCase>& cases, const std::vector<std::string>& files, const PairModel& model) {
  for (const std::string& file : files)
    for (const Frame& frame : read_frames(file, model)) {
      check_separations_in(file, frame.configuration, model);
      for (const ImageRule rule : {ImageRule::all, ImageRule::minimum}) {
        PairModel with_rule = model;
        with_rule.images = rule;
        cases.push_back({fmt::format("{} ({} images)", file, to_string(rule)), with_rule, frame.configuration});
      }
    }
}

constexpr Scope runs_with_files{"files", "checks on FILES"};

struct VerifyState {
  CommonOptions common;
  SystemOptions system;
  std::vector<std::string> files;
  std::string junit;
};

// `forced`: whether one instruction set was asked for.
Json to_json(const std::vector<Deviation>& deviations, const std::vector<Isa>& isas, bool forced) {
  Json result;
  result["passed"] = std::all_of(deviations.begin(), deviations.end(), [](const Deviation& d) { return d.passed(); });
  for (const Deviation& d : deviations)
    result["kernels"].push_back({{"kernel", d.kernel},
                                 {"isa", d.isa},
                                 {"cases", d.cases},
                                 {"worst", d.worst},
                                 {"tolerance", d.tolerance},
                                 {"worst_case", d.worst_case},
                                 {"passed", d.passed()}});
  for (const Isa isa : every_isa)
    if (std::find(isas.begin(), isas.end(), isa) == isas.end())
      result["skipped"].push_back(
          {{"isa", to_string(isa)}, {"reason", forced ? "not asked for" : "not available on this processor"}});
  return result;
}

Json run_verify(VerifyState& state, Options& options, int& status) {
  state.common.check();
  // The instruction set that a flag or LANESCAPE_ISA names, or all available ones.
  const bool forced = forced_isa(state.common.isa).has_value();
  const std::vector<Isa> isas = forced ? std::vector{state.common.resolve_isa()} : available_isas();
  const AnyModel model = state.system.resolve();
  options.settle(
      joined({state.system.kinds(model, false), {kind_if(!state.files.empty(), runs_with_files, "with FILES", "without FILES")}}));
  std::vector<PairCase> cases = pair_cases();
  add_files(cases, state.files, state.system.resolve_pair_model("verify"));
  OutputFolder folder = open_folder(state.common);
  std::optional<TemporaryFile> junit;  // made first: a path that cannot be written is bad input
  if (!state.junit.empty()) junit.emplace(state.junit);

  std::vector<Deviation> deviations;
  for (const Isa isa : isas) {
    say(state.common, fmt::format("verifying {}", to_string(isa)));
    for (Deviation& d : verify_kernels(isa, cases)) deviations.push_back(std::move(d));
  }
  const Json result = to_json(deviations, isas, forced);
  if (junit) {
    junit->write([&](std::ostream& out) { write_junit(out, deviations); });
    junit->commit();
  }
  write_result(folder, "verify", options.resolved(), result);
  status = result["passed"].get<bool>() ? done : goal_not_reached;
  return result;
}

}  // namespace

Subcommand add_verify(CLI::App& app) {
  const auto options =
      std::make_shared<Options>(app, "verify", "Every kernel on every instruction set against the scalar reference");
  const auto state = std::make_shared<VerifyState>();
  options->add_positional("FILES", state->files, "extended XYZ files to check on besides the built-in cases");
  options->add("--junit", state->junit, "also write the results to this file as JUnit XML");
  state->system.add_to(*options);
  options->at("--composition").refused("with verify: it is for starts that are made");
  for (const char* of_model : {"--model", "--model-file", "--cutoff", "--truncation"})
    options->at(of_model).only_for({runs_with_files});
  options->at("--images").refused("with verify: it checks both image rules, all and minimum");
  options->at("--precision").refused("with verify: it checks both precisions, double and mixed");
  state->common.add_to(*options);
  return {&options->app(), [=](int& status) { return run_verify(*state, *options, status); }};
}

}  // namespace lanescape::program
