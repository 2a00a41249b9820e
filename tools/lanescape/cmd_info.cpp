#include <fstream>

#include "lanescape/lanescape.hpp"
#include "program.hpp"

namespace lanescape::program {
namespace {

std::string cpu_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string compiler_name() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace

Subcommand add_info(CLI::App& app) {
  const auto options = std::make_shared<Options>(app, "info", "Version, compiler, processor, instruction sets and threads");
  const auto common = std::make_shared<CommonOptions>();
  common->add_to(*options);
  return {&options->app(), [=](int&) {
            common->check();
            const Isa active = common->resolve_isa();
            OutputFolder folder = open_folder(*common);
            Json result;
            result["version"] = version();
            result["compiler"] = compiler_name();
            result["cpu"] = cpu_name();
            result["isas"] = instruction_sets();
            result["isa"] = to_string(active);
            result["lanes"] = kernel_table(active).lanes;
            result["threads"] = common->threads;
            write_result(folder, "info", options->resolved(), result);
            return result;
          }};
}

}  // namespace lanescape::program
