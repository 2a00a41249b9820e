#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "interaction/sphere/check_overlap.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"
#include "program.hpp"

namespace lanescape::program {
namespace {

struct OverlapState {
  CommonOptions common;
  std::string file;
};

Json run_overlap(OverlapState& state, const Options& options, int& status) {
  state.common.check();
  const Isa isa = state.common.resolve_isa();
  const Configuration spheres = read_hard_frame(state.file);
  try {
    check_box_holds_spheres(spheres);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", state.file, error.what()));
  }
  OutputFolder folder = open_folder(state.common);
  // One species: slots are particles.
  const ParticleLayout layout(std::vector<int>(spheres.size(), 0), 1);
  HardSphereOverlap overlap(spheres.box, layout, spheres.radii, kernel_table(isa));
  const AlignedArray positions = layout.to_slots(spheres.positions);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& pair : overlap.pairs_within(positions, 0.0))
    pairs.emplace_back(static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
  std::sort(pairs.begin(), pairs.end());

  Json result;
  result["overlaps"] = pairs.size();
  result["pairs"] = Json::array();
  for (const auto& [i, j] : pairs) result["pairs"].push_back({i, j, sphere_gap(spheres, i, j)});
  const double smallest = overlap.smallest_gap(positions);
  result["smallest_gap"] = number_or_null(smallest);
  result["particles"] = spheres.size();
  result["packing_fraction"] = packing_fraction(spheres);
  result["isa"] = to_string(isa);
  status = done;
  write_result(folder, "overlap", options.resolved(), result);
  return result;
}

}  // namespace

Subcommand add_overlap(CLI::App& app) {
  const auto options =
      std::make_shared<Options>(app, "overlap", "Overlapping pairs of hard spheres in a file, and the smallest gap");
  const auto state = std::make_shared<OverlapState>();
  options->add_positional("FILE", state->file, "extended XYZ file with a radius column; its first frame is taken").required();
  state->common.add_to(*options);
  return {&options->app(), [=](int& status) { return run_overlap(*state, *options, status); }};
}

}  // namespace lanescape::program
