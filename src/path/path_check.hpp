#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/box.hpp"
#include "dispatch/isa.hpp"
#include "landscape/kinematic_landscape.hpp"
#include "landscape/soft_landscape.hpp"
#include "path/polyline.hpp"

namespace lanescape {

// The certificate of a path (PHYSICS 4), computed from its nodes alone: how far it leaves the allowed region, and how far it is
// from the Kuhn-Tucker condition of a shortest path. It shows that a path is stationary, not that no other is shorter.
//
// The shortest path makes sum |R_{k+1} - R_k| stationary with V <= E_L at its nodes: -tau_k + lambda_k n_k = 0, lambda_k >= 0, with
// tau_k = t_{k+1} - t_k the difference of the unit tangents behind and before node k and n_k = grad V/|grad V|. So a path bends
// towards the forbidden region, around which it is taut like a string: tau_k points along +grad V. For hard spheres the constraints
// are the gaps of pairs, r_ij - s_ij >= 0, and n_c = -grad gap/|grad gap|.

struct PathCheckOptions {
  // A node is on the boundary, and may bend, where V comes above E_L - boundary_tolerance at it or on a segment next to it
  // [epsilon].
  double boundary_tolerance = 1e-3;
  // A pair is in contact at a node where its gap comes below this at it or on a segment next to it [smallest diameter]. A path on
  // the boundary touches between its nodes, which lie outside by about s_ij h^2/8 for bends by h.
  double contact_tolerance = 1e-6;
  std::size_t samples = 10;  // of V inside each segment, at least 2; a parabola through the highest refines them
  int threads = 1;           // no effect on any result

  // Throws Error(bad_input) naming the option that is out of range.
  void check() const;
};

struct PathCheck {
  double length = 0.0;             // [sigma]
  double largest_violation = 0.0;  // soft: of V - E_L [epsilon], hard: of s_ij - r_ij [sigma], over nodes and segments; at least 0
  // max_k |tau_k - lambda_k n_k| / max_k |tau_k|; 0 for a path that is straight up to rounding.
  double kuhn_tucker_residual = 0.0;
  // Of each node. Soft: V - E_L [epsilon]; hard: the smallest gap [sigma], infinity for a single sphere.
  std::vector<double> excess;
  // Of each node: lambda; hard: the sum over its contacts. 0 off the boundary and at both ends.
  std::vector<double> multipliers;
  // Of each segment, ends included. Soft: the largest V - E_L [epsilon]; hard: minus the smallest gap [sigma].
  std::vector<double> segment_violation;
};

// All throw Error(bad_input) for fewer than 3 nodes and for what check_polyline() refuses. A landscape has the coordinates of the
// nodes: KinematicLandscape where masses differ. E_L is `landscape_energy` [epsilon].
PathCheck check_path(SoftLandscape& landscape, double landscape_energy, const Polyline& nodes,
                     const PathCheckOptions& options = {});
// The same on as many threads as asked for, each with landscapes of its own.
PathCheck check_path(const SoftLandscapeMaker& make_landscape, double landscape_energy, const Polyline& nodes,
                     const PathCheckOptions& options = {});

// What the path of hard spheres moves through.
struct HardSpherePath {
  const Box& box;
  const ParticleLayout& layout;
  const std::vector<double>& radii;  // per particle in the user's order [sigma]
  const KinematicMetric& metric;
  Isa isa;
};
PathCheck check_path(const HardSpherePath& path, const Polyline& nodes, const PathCheckOptions& options = {});

}  // namespace lanescape
