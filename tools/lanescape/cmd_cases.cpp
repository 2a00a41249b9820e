#include "host_cases.hpp"
#include "program.hpp"

namespace lanescape::program {
namespace {

Json run_cases(CommonOptions& common, Options& options, int& status) {
  common.check();
  common.resolve_isa();  // refuses unknown ones
  options.settle({});
  if (common.folder_kind().scope.name.empty()) throw_bad_input("--out: a folder for the files of the cases is needed");
  const std::vector<PairCase> cases = all_pair_cases();
  OutputFolder folder = open_folder(common);
  folder.write(cases_file, [&](std::ostream& out) { out << text_of_cases(cases); });
  folder.write(positions_file, [&](std::ostream& out) { out << text_of_positions(cases); });
  Json result;
  result["cases"] = cases.size();
  result["files"] = {cases_file, positions_file};
  result["results"] = host_results_file;
  write_result(folder, "cases", options.resolved(), result);
  status = done;
  return result;
}

}  // namespace

Subcommand add_cases(CLI::App& app) {
  const auto options = std::make_shared<Options>(
      app, "cases", "Writes the cases that a host's kernel is checked on, for check to compare its results");
  const auto common = std::make_shared<CommonOptions>();
  common->add_to(*options);
  return {&options->app(), [=](int& status) { return run_cases(*common, *options, status); }};
}

}  // namespace lanescape::program
