#include "host_cases.hpp"
#include "host_report.hpp"
#include "program.hpp"

namespace lanescape::program {
namespace {

struct CheckState {
  CommonOptions common;
  std::string folder, precision = "double", junit;
};

Json run_check(CheckState& state, Options& options, int& status) {
  state.common.check();
  state.common.resolve_isa();  // refuses unknown ones
  options.settle({});
  const HostPrecision precision = parse_host_precision(state.precision);
  const std::vector<PairCase> cases = all_pair_cases();
  const std::vector<HostResult> results = read_host_results(state.folder, cases);
  OutputFolder folder = open_folder(state.common);
  JunitFile junit(state.junit);
  const HostReport report = compare_with_reference(cases, results, precision);
  junit.write(report);
  say(state.common, report.summary());
  const Json result = to_json(report, precision);
  write_result(folder, "check", options.resolved(), result);
  status = report.passed() ? done : goal_not_reached;
  return result;
}

}  // namespace

Subcommand add_check(CLI::App& app) {
  const auto options = std::make_shared<Options>(
      app, "check", "Results of a host's kernel on the cases that cases wrote, against the scalar reference");
  const auto state = std::make_shared<CheckState>();
  options->add_positional("DIR", state->folder, "folder of cases, with the host's results in host_results.json").required();
  options->add("--precision", state->precision, "of the host's kernel: double, or single");
  options->add("--junit", state->junit, "also write the results to this file as JUnit XML, one test case per case");
  state->common.add_to(*options);
  return {&options->app(), [=](int& status) { return run_check(*state, *options, status); }};
}

}  // namespace lanescape::program
