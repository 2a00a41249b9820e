#include "path_check_report.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "pair_files.hpp"
#include "run/given_path.hpp"
#include "run/path_nodes.hpp"

namespace lanescape::program {
namespace {

CheckedPath checked(const std::string& file, const PathFile& path, Isa isa, int threads) {
  try {
    return check_path(path.model, path.nodes, path.landscape_energy, isa, {.threads = threads});
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", file, error.what()));
  }
}

}  // namespace

PathFile read_whole_path(const std::filesystem::path& file, const AnyModel& model) {
  return is_path_file(file) ? read_path_file(file) : read_path_frames(file, model);
}

Json check_file(const std::string& file, const PathFile& path, const std::string& pair_file, double overlap_tolerance, Isa isa,
                int threads) {
  Stopwatch clock;
  if (!pair_file.empty()) {
    std::vector<Configuration> nodes = path.nodes;
    match_ends(nodes, path.model, read_pair(pair_file, path.model, overlap_tolerance), file);
  }
  const CheckedPath found = checked(file, path, isa, threads);
  clock.lap();
  Json json;
  json["length_before"] = nullptr;  // nothing was shortened
  json["length"] = found.check.length;
  json["distance"] = found.distance;
  json["ratio_squared"] = found.ratio_squared();
  json["largest_violation"] = found.check.largest_violation;
  json["kuhn_tucker_residual"] = found.check.kuhn_tucker_residual;
  json["nodes"] = path.nodes.size();
  json["landscape_energy"] = is_hard(path.model) ? Json() : Json(found.landscape_energy);
  if (!path.method.empty()) json["method"] = path.method;
  json["model"] = mixture_of(path.model).name;
  json["isa"] = to_string(isa);
  json["seconds"] = clock.seconds();
  return json;
}

void write_whole_path(const OutputFolder& folder, std::size_t number, const AnyModel& model,
                      const std::vector<Configuration>& nodes, std::optional<double> landscape_energy, const PathCheck& check,
                      const std::string& method, Isa isa) {
  write_path_file(folder.path() / fmt::format("path-{:04}.h5", number + 1),
                  path_file(model, nodes, landscape_energy, check, method, isa));
}

void write_node_table(std::ostream& out, const AnyModel& model, const std::vector<Configuration>& nodes, const PathCheck& check,
                      Isa isa) {
  const Polyline path = path_nodes(model, nodes).nodes;
  const VectorAlgebra algebra(kernel_table(isa));
  fmt::print(out, "length,distance_to_goal,{},multiplier,participation_ratio\n", is_hard(model) ? "smallest_gap" : "excess");
  double length = 0.0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    // Of the segment that ends here; at the start, of the one that begins there.
    const std::size_t end = std::max<std::size_t>(k, 1);
    const auto moments = algebra.displacement_moments(path[end - 1], path[end]);
    if (k > 0) length += std::sqrt(moments.second);
    fmt::print(out, "{},{},{},{},{}\n", length, algebra.distance(path[k], path.back()), check.excess[k], check.multipliers[k],
               moments.second * moments.second / moments.fourth / static_cast<double>(nodes[k].size()));
  }
}

}  // namespace lanescape::program
