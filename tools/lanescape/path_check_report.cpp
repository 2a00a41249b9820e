#include "path_check_report.hpp"

#include <fmt/format.h>

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
                      const std::vector<Configuration>& nodes, std::optional<double> landscape_energy, const std::string& method,
                      Isa isa, int threads) {
  const CheckedPath found = check_path(model, nodes, landscape_energy, isa, {.threads = threads});
  write_path_file(folder.path() / fmt::format("path-{:04}.h5", number + 1),
                  path_file(model, nodes, landscape_energy, found.check, method, isa));
}

}  // namespace lanescape::program
