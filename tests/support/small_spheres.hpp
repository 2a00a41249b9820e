#pragma once

#include <stdexcept>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "hard_paths.hpp"
#include "landscape/kinematic_landscape.hpp"
#include "path/path_check.hpp"
#include "reference/hard_geodesic.hpp"

namespace lanescape::testing {

// 8 hard spheres, or 27 with seed 2, which the reference can follow along a path.
struct SmallSpheres {
  reference::Pair pair;
  Box box;
  ParticleLayout layout;
  KinematicMetric metric;

  explicit SmallSpheres(unsigned seed)
      : pair(reference::fluid(seed == 2u ? 3 : 2, 0.35, seed == 2u ? 4.0 : 6.0, seed)),
        box{pair.box},
        layout(std::vector<int>(pair.radii.size(), 0), 1),
        metric(hard_sphere(), layout) {}

  // Every fiftieth configuration of the reference's avoidance path, and its ends.
  std::vector<reference::Point> greedy() const {
    reference::AvoidanceOptions options;
    options.avoidance_step = 1e-3;
    options.record = 10'000'000;
    const reference::HardGeodesic found = find_avoidance_geodesic(pair.start, pair.finish, pair.radii, pair.box, options);
    if (found.outcome != reference::Outcome::reached) throw std::runtime_error("small spheres: no path");
    std::vector<reference::Point> nodes{pair.start};
    for (std::size_t k = 50; k + 50 < found.accepted.size(); k += 50) nodes.push_back(found.accepted[k].positions);
    nodes.push_back(pair.finish);
    return nodes;
  }
  HardSpherePath path() const { return {box, layout, pair.radii, metric, choose_isa("auto")}; }
  Polyline in_slots(const std::vector<reference::Point>& nodes) const {
    Polyline result;
    for (const reference::Point& node : nodes) result.push_back(layout.to_slots(node));
    return result;
  }
};

}  // namespace lanescape::testing
