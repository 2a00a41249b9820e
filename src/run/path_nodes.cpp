#include "run/path_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "configuration/model_traits.hpp"
#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "interaction/sphere/check_overlap.hpp"
#include "landscape/make_landscape.hpp"

namespace lanescape {
namespace {

void check_same_particles(const AnyModel& model, const std::vector<Configuration>& path) {
  if (path.size() < 3) throw_bad_input(fmt::format("a path of {} nodes is not allowed: at least 3 are needed", path.size()));
  const Configuration& first = path.front();
  check_edges(first.box.length);
  for (std::size_t k = 0; k < path.size(); ++k) {
    const auto differs = [&](const char* what) {
      throw_bad_input(fmt::format("node {} of the path has other {} than the first: all nodes hold the same system", k, what));
    };
    if (!(path[k].box == first.box)) differs("box edges");
    if (path[k].species != first.species) differs("particles");
    if (path[k].radii != first.radii) differs("radii");
    if (path[k].diameters != first.diameters) differs("diameters");
  }
  if (!is_hard(model)) return;
  if (first.radii.size() != first.size()) throw_bad_input("the path has no radii: each hard sphere needs one");
  check_box_holds_spheres(first);
}

double distance_of_ends(const Polyline& nodes, Isa isa) {
  return VectorAlgebra(kernel_table(isa)).distance(nodes.front(), nodes.back());
}

}  // namespace

PathNodes path_nodes(const AnyModel& model, const std::vector<Configuration>& path) {
  const Mixture& mixture = mixture_of(model);
  return path_nodes(mixture, ParticleLayout::in_space_order(path.front(), mixture.species.size()), path);
}

PathNodes path_nodes(const Mixture& mixture, const ParticleLayout& layout, const std::vector<Configuration>& path) {
  PathNodes result{layout, KinematicMetric(mixture, layout), {}};
  for (const Configuration& node : path) result.nodes.push_back(result.metric.coordinates(layout, node.positions));
  return result;
}

std::vector<Configuration> configurations_of(const Polyline& nodes, const ParticleLayout& layout, const KinematicMetric& metric,
                                             const Configuration& like) {
  std::vector<Configuration> path(nodes.size(), like);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    AlignedArray positions = nodes[k];
    metric.to_positions(positions);
    layout.put_user(positions, path[k].positions);
  }
  return path;
}

CheckedPath check_path(const AnyModel& model, const std::vector<Configuration>& path, std::optional<double> landscape_energy,
                       Isa isa, const PathCheckOptions& options) {
  check_same_particles(model, path);
  for (const Configuration& node : path) check_finite_particles(node.positions);
  const PathNodes made = path_nodes(model, path);
  const Configuration& first = path.front();
  if (is_hard(model)) {
    if (landscape_energy) throw_bad_input("hard spheres have no landscape energy: without it only");
    CheckedPath result;
    result.distance = distance_of_ends(made.nodes, isa);
    result.check = check_path(HardSpherePath{first.box, made.layout, first.radii, made.metric, isa}, made.nodes, options);
    return result;
  }
  const auto make = [&] { return make_landscape(model, first.box, made.layout, isa, {.skin = path_skin}); };
  return check_path_on(make, made, landscape_energy, isa, options);
}

CheckedPath check_path_on(const SoftLandscapeMaker& make, const PathNodes& path, std::optional<double> landscape_energy, Isa isa,
                          const PathCheckOptions& options) {
  const auto make_kinematic = [&] { return in_kinematic_coordinates(make(), path.metric); };
  const auto end_energy = [&](const AlignedArray& end) { return make_kinematic()->energy(end); };
  CheckedPath result;
  result.distance = distance_of_ends(path.nodes, isa);
  result.landscape_energy =
      landscape_energy ? *landscape_energy : std::max(end_energy(path.nodes.front()), end_energy(path.nodes.back()));
  result.check = check_path(make_kinematic, result.landscape_energy, path.nodes, options);
  return result;
}

}  // namespace lanescape
