#pragma once

#include <span>
#include <vector>

#include "reference/geodesic.hpp"
#include "reference/path_sum.hpp"
#include "reference/vector.hpp"

/// The certificate of a path of straight segments, to check the one in src. Equations: PHYSICS 4. Masses are equal.
namespace lanescape::reference {

struct CertificateOptions {
  double boundary_tolerance = 1e-3;  // [epsilon], a node is on the boundary from E_L - this on, at it or on a segment next to it
  double contact_tolerance = 1e-6;   // [sigma], a pair touches below this gap, at the node or on a segment next to it
  long samples = 200;                // of V inside each segment
};

struct PathCertificate {
  double length = 0.0;                    // [sigma]
  double largest_violation = 0.0;         // along segments, at least 0. Soft: of V - E_L [epsilon]; hard: overlap [sigma]
  double residual = 0.0;                  // max |tau - lambda n| / max |tau|; 0 where no |tau| exceeds `straight`
  std::vector<double> excess;             // of each node. Soft: V - E_L [epsilon]; hard: smallest gap [sigma]
  std::vector<double> multipliers;        // of each node: lambda, of hard spheres summed over contacts; 0 at both ends
  std::vector<double> segment_violation;  // of each segment. Soft: largest V - E_L [epsilon]; hard: minus the smallest gap [sigma]
};

/// Bends below this are rounding: a turn by x changes a length by x^2/8 of it.
inline constexpr double straight = 1e-7;

/// Both throw std::invalid_argument for fewer than three nodes, nodes of different sizes and neighbouring nodes that are equal.
PathCertificate soft_certificate(const std::vector<Point>& nodes, const Energy& energy, const Gradient& gradient,
                                 double landscape_energy, const CertificateOptions& options = {});
/// For segments that move no pair by half a box edge.
PathCertificate hard_certificate(const std::vector<Point>& nodes, std::span<const double> radii, const Vector& box,
                                 const CertificateOptions& options = {});

/// The x >= 0 with the least |sum_c x_c columns_c - target|, one coordinate after the other until nothing changes.
std::vector<double> non_negative_fit(const std::vector<Point>& columns, const Point& target);

}  // namespace lanescape::reference
