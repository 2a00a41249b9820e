#include "run/neighbour_configuration.hpp"

#include <functional>
#include <memory>

#include "configuration/model_traits.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"

namespace lanescape {
namespace {

// As in the source.
constexpr double largest_move = 0.10, least_displacement = 0.10;  // per axis; |R' - R| in 3N space; in units of length
// Moves before it counts as failed: a configuration so tight has no R'. Each move uses two draws of random numbers.
constexpr std::uint32_t most_moves = 1'000'000;

// Whether kinematic coordinates are allowed. Made anew for each use, so that no list of an earlier one affects any bit.
using AllowedRegion = std::function<bool(const AlignedArray& q)>;

AllowedRegion allowed_region(const SearchSetup& setup) {
  if (setup.options.method->is_hard) {
    const auto spheres = std::make_shared<HardSphereOverlap>(setup.pair.start.box, setup.prepared.layout, setup.pair.start.radii,
                                                             kernel_table(setup.isa));
    return [spheres, metric = setup.prepared.metric](AlignedArray q) {
      metric.to_positions(q);
      return !spheres->any_overlap(q);
    };
  }
  const std::shared_ptr<SoftLandscape> landscape = path_landscape(setup);
  return [landscape, energy = setup.prepared.landscape_energy](const AlignedArray& q) { return landscape->energy(q) <= energy; };
}

}  // namespace

AlignedArray kinematic_coordinates(const SearchSetup& setup, const std::vector<double>& positions) {
  return setup.prepared.metric.coordinates(setup.prepared.layout, positions);
}

std::optional<std::vector<double>> neighbour_configuration(const SearchSetup& setup, const std::vector<double>& from,
                                                           const CounterRandom& random, std::uint64_t step, std::uint32_t particle,
                                                           const RunMonitor& monitor) {
  const AllowedRegion allowed = allowed_region(setup);
  const VectorAlgebra algebra(kernel_table(setup.isa));
  const double unit = length_unit(setup.model);
  const AlignedArray origin = kinematic_coordinates(setup, from);
  std::vector<double> now = from;
  const auto particles = static_cast<std::uint32_t>(from.size() / 3);
  for (std::uint32_t move = 0; move < most_moves; ++move) {
    if (move % 1000 == 999 && monitor.stop_requested()) return std::nullopt;
    const std::size_t moved = random.below(particles, step, particle, 2 * move + 1);
    const Point by = random.uniform_point(step, particle, 2 * move + 2);
    std::vector<double> next = now;
    for (std::size_t axis = 0; axis < 3; ++axis) next[3 * moved + axis] += unit * largest_move * (2.0 * by[axis] - 1.0);
    const AlignedArray q = kinematic_coordinates(setup, next);
    if (!allowed(q)) continue;
    now = std::move(next);
    if (algebra.distance(q, origin) > unit * least_displacement) return now;
  }
  return std::vector<double>{};
}

}  // namespace lanescape
