#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/error.hpp"
#include "host_report.hpp"
#include "io/extended_xyz.hpp"
#include "program.hpp"
#include "verification/cases.hpp"
#include "verification/host_kernel.hpp"
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
constexpr Scope own_kernels{"kernels", "checks of our own kernels"},
    host_kernels{"kernels", "checks of a host's kernel, with --library"};
constexpr Scope either_precision{"precision", "checks of a host's kernel, with --library"};

struct VerifyState {
  CommonOptions common;
  SystemOptions system;
  std::vector<std::string> files;
  std::string library, symbol, junit;

  bool of_host() const { return !library.empty(); }
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

// What says which model FILES are of: --precision is the host's.
SystemOptions model_options(const VerifyState& state) {
  SystemOptions options = state.system;
  options.precision.reset();
  return options;
}

RunKinds kinds_of(const VerifyState& state) {
  const AnyModel model = model_options(state).resolve();
  const RunKinds own = {kind_if(!state.files.empty(), runs_with_files, "with FILES", "without FILES"),
                        {state.of_host() ? host_kernels : own_kernels, state.of_host() ? "with --library" : "without --library"},
                        kind_if(state.of_host(), either_precision, "",
                                "with verify of our own kernels, which checks both precisions, double and mixed")};
  return joined({state.system.kinds(model, false), own});
}

Json verify_own_kernels(VerifyState& state, std::vector<PairCase> cases, JunitFile& junit) {
  // The instruction set that a flag or LANESCAPE_ISA names, or all available ones.
  const bool forced = forced_isa(state.common.isa).has_value();
  std::vector<Deviation> deviations;
  const std::vector<Isa> isas = forced ? std::vector{state.common.resolve_isa()} : available_isas();
  for (const Isa isa : isas) {
    say(state.common, fmt::format("verifying {}", to_string(isa)));
    for (Deviation& d : verify_kernels(isa, cases)) deviations.push_back(std::move(d));
  }
  junit.write(deviations);
  return to_json(deviations, isas, forced);
}

Json verify_host_kernel(VerifyState& state, const std::vector<PairCase>& cases, JunitFile& junit) {
  const HostPrecision precision = parse_host_precision(state.system.precision.value_or("double"));
  if (state.symbol.empty()) throw_bad_input("--library: the name of its function is needed, with --symbol");
  const std::vector<HostResult> results = run_host_kernel(state.library, state.symbol, cases);
  const HostReport report = compare_with_reference(cases, results, precision);
  junit.write(report);
  say(state.common, report.summary());
  return program::to_json(report, precision);
}

Json run_verify(VerifyState& state, Options& options, int& status) {
  state.common.check();
  options.settle(kinds_of(state));
  if (!state.of_host()) forced_isa(state.common.isa);  // refuses unknown ones
  std::vector<PairCase> cases = state.of_host() ? all_pair_cases() : pair_cases();
  add_files(cases, state.files, model_options(state).resolve_pair_model("verify"));
  OutputFolder folder = open_folder(state.common);
  JunitFile junit(state.junit);
  const Json result = state.of_host() ? verify_host_kernel(state, cases, junit) : verify_own_kernels(state, cases, junit);
  write_result(folder, "verify", options.resolved(), result);
  status = result["passed"].get<bool>() ? done : goal_not_reached;
  return result;
}

}  // namespace

Subcommand add_verify(CLI::App& app) {
  const auto options = std::make_shared<Options>(
      app, "verify", "Every kernel on every instruction set, or a host's own kernel, against the scalar reference");
  const auto state = std::make_shared<VerifyState>();
  options->add_positional("FILES", state->files, "extended XYZ files to check on besides the built-in cases");
  options->add("--library", state->library, "shared library with a host's own kernel to check (lanescape/host_kernel.h)");
  options->add("--symbol", state->symbol, "name of its function").only_for({host_kernels});
  options->add("--junit", state->junit, "also write the results to this file as JUnit XML");
  state->system.add_to(*options);
  options->at("--composition").refused("with verify: it is for starts that are made");
  for (const char* of_model : {"--model", "--model-file", "--cutoff", "--truncation"})
    options->at(of_model).only_for({runs_with_files});
  options->at("--images").refused("with verify: it checks both image rules, all and minimum");
  options->at("--precision").only_for({either_precision}).described("of a host's kernel: double, or single [double]");
  state->common.add_to(*options);
  options->at("--isa").only_for({own_kernels});
  return {&options->app(), [=](int& status) { return run_verify(*state, *options, status); }};
}

}  // namespace lanescape::program
