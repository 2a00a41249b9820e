#pragma once

#include <optional>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/model.hpp"
#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "landscape/kinematic_landscape.hpp"
#include "path/path_check.hpp"
#include "path/polyline.hpp"
#include "run/path_search.hpp"

namespace lanescape {

// A path of configurations as the stages below see it.
struct PathNodes {
  ParticleLayout layout;
  KinematicMetric metric;
  Polyline nodes;  // kinematic coordinates
};

// `path` has at least one configuration; all hold the same particles.
PathNodes path_nodes(const AnyModel& model, const std::vector<Configuration>& path);
PathNodes path_nodes(const Mixture& mixture, const ParticleLayout& layout, const std::vector<Configuration>& path);
// The way back: in the user's order, with box, species and sizes of `like`.
std::vector<Configuration> configurations_of(const Polyline& nodes, const ParticleLayout& layout, const KinematicMetric& metric,
                                             const Configuration& like);

struct CheckedPath {
  PathCheck check;
  double distance = 0.0;          // |R_f - R_i| [sigma]
  double landscape_energy = 0.0;  // E_L; of hard spheres 0 [epsilon]

  double ratio_squared() const { return distance * distance / (check.length * check.length); }
};

// The certificate of a path of any model, from its configurations alone. E_L is the higher energy of both ends unless it is given.
// Throws Error(bad_input) for what check_path() refuses, nodes that differ in their particles, a box too small for the spheres, and
// a landscape energy of hard spheres.
CheckedPath check_path(const AnyModel& model, const std::vector<Configuration>& path, std::optional<double> landscape_energy,
                       Isa isa, const PathCheckOptions& options = {});
// The same on any landscape of soft particles, in positions; what is checked of configurations is not.
CheckedPath check_path_on(const SoftLandscapeMaker& make, const PathNodes& path, std::optional<double> landscape_energy, Isa isa,
                          const PathCheckOptions& options = {});

}  // namespace lanescape
