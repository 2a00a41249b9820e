#include "reference/path_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "reference/hard_sphere.hpp"
#include "reference/separation.hpp"

namespace lanescape::reference {
namespace {

double norm(const Point& x) { return std::sqrt(dot(x, x)); }

void check_nodes(const std::vector<Point>& nodes) {
  if (nodes.size() < 3) throw std::invalid_argument("path_certificate: a path needs at least three nodes");
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    if (nodes[k].size() != nodes[k + 1].size() || nodes[k] == nodes[k + 1])
      throw std::invalid_argument("path_certificate: nodes " + std::to_string(k) + " and " + std::to_string(k + 1) +
                                  " are equal or differ in size");
}

/// tau_k = t_{k+1} - t_k, zero at both ends.
std::vector<Point> bends(const std::vector<Point>& nodes) {
  std::vector<Point> tangents, result(nodes.size(), Point(nodes.front().size(), 0.0));
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    const Point step = combine(nodes[k + 1], -1.0, nodes[k]);
    tangents.push_back(combine(Point(step.size(), 0.0), 1.0 / norm(step), step));
  }
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) result[k] = combine(tangents[k], -1.0, tangents[k - 1]);
  return result;
}

PathCertificate begin_certificate(const std::vector<Point>& nodes) {
  PathCertificate result;
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) result.length += distance(nodes[k], nodes[k + 1]);
  result.multipliers.assign(nodes.size(), 0.0);
  return result;
}

/// `rests`: tau - lambda n of each node.
void finish_certificate(PathCertificate& result, const std::vector<Point>& taus, const std::vector<Point>& rests) {
  double tau = 0.0, rest = 0.0;
  for (const Point& x : taus) tau = std::max(tau, norm(x));
  for (const Point& x : rests) rest = std::max(rest, norm(x));
  result.residual = tau > straight ? rest / tau : 0.0;
  for (const double violation : result.segment_violation) result.largest_violation = std::max(result.largest_violation, violation);
}

/// Where a pair is nearest on a segment.
struct Nearest {
  double fraction = 0.0;  // of the segment
  double gap = 0.0;       // [sigma]
  Point normal;           // 3N, unit length: minus the gradient of the gap
};

/// The pair moves in a straight line relative to each other, for each image of its own.
Nearest nearest(const Point& from, const Point& to, std::size_t i, std::size_t j, double contact, const Vector& box) {
  const Vector begin = separation(&from[3 * i], &from[3 * j], box);
  Vector moved, closest{};
  for (std::size_t a = 0; a < 3; ++a) moved[a] = (to[3 * j + a] - from[3 * j + a]) - (to[3 * i + a] - from[3 * i + a]);
  Nearest result{0.0, std::numeric_limits<double>::infinity(), Point(from.size(), 0.0)};
  for (int image = 0; image < 27; ++image) {
    Vector d{begin[0] + (image % 3 - 1) * box[0], begin[1] + (image / 3 % 3 - 1) * box[1], begin[2] + (image / 9 - 1) * box[2]};
    const double speed = dot(moved, moved);
    const double t = speed > 0.0 ? std::clamp(-dot(d, moved) / speed, 0.0, 1.0) : 0.0;
    for (std::size_t a = 0; a < 3; ++a) d[a] += t * moved[a];
    const double gap = std::sqrt(dot(d, d)) - contact;
    if (gap >= result.gap) continue;
    result.fraction = t;
    result.gap = gap;
    closest = d;
  }
  const double size = std::sqrt(2.0 * dot(closest, closest));
  for (std::size_t a = 0; a < 3; ++a) {
    result.normal[3 * i + a] = closest[a] / size;
    result.normal[3 * j + a] = -closest[a] / size;
  }
  return result;
}

}  // namespace

std::vector<double> non_negative_fit(const std::vector<Point>& columns, const Point& target) {
  std::vector<double> x(columns.size(), 0.0);
  Point rest = target;
  for (long sweep = 0; sweep < 100'000; ++sweep) {
    double change = 0.0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double better = std::max(0.0, x[c] + dot(columns[c], rest) / dot(columns[c], columns[c]));
      rest = combine(rest, x[c] - better, columns[c]);
      change = std::max(change, std::abs(better - x[c]));
      x[c] = better;
    }
    if (change <= 1e-13 * norm(target)) break;
  }
  return x;
}

PathCertificate soft_certificate(const std::vector<Point>& nodes, const Energy& energy, const Gradient& gradient,
                                 double landscape_energy, const CertificateOptions& options) {
  check_nodes(nodes);
  PathCertificate result = begin_certificate(nodes);
  for (const Point& node : nodes) result.excess.push_back(energy(node) - landscape_energy);
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
    double largest = std::max(result.excess[k], result.excess[k + 1]);
    const Point chord = combine(nodes[k + 1], -1.0, nodes[k]);
    for (long s = 1; s <= options.samples; ++s) {
      const double fraction = static_cast<double>(s) / static_cast<double>(options.samples + 1);
      largest = std::max(largest, energy(combine(nodes[k], fraction, chord)) - landscape_energy);
    }
    result.segment_violation.push_back(largest);
  }
  const std::vector<Point> taus = bends(nodes);
  std::vector<Point> rests = taus;
  Point n(nodes.front().size());
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
    if (std::max(result.segment_violation[k - 1], result.segment_violation[k]) <= -options.boundary_tolerance) continue;
    gradient(nodes[k], n);
    n = combine(Point(n.size(), 0.0), 1.0 / norm(n), n);
    result.multipliers[k] = std::max(0.0, dot(taus[k], n));
    rests[k] = combine(taus[k], -result.multipliers[k], n);
  }
  finish_certificate(result, taus, rests);
  return result;
}

PathCertificate hard_certificate(const std::vector<Point>& nodes, std::span<const double> radii, const Vector& box,
                                 const CertificateOptions& options) {
  check_nodes(nodes);
  for (const Point& node : nodes) check(node, radii, box);
  PathCertificate result = begin_certificate(nodes);
  for (const Point& node : nodes) result.excess.push_back(smallest_gap(node, radii, box));
  result.segment_violation.assign(nodes.size() - 1, -std::numeric_limits<double>::infinity());
  std::vector<std::vector<Point>> contacts(nodes.size());  // their normals
  for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    for (std::size_t i = 0; i < radii.size(); ++i)
      for (std::size_t j = i + 1; j < radii.size(); ++j) {
        const double contact = radii[i] + radii[j];
        const Nearest found = nearest(nodes[k], nodes[k + 1], i, j, contact, box);
        result.segment_violation[k] = std::max(result.segment_violation[k], -found.gap);
        if (found.gap >= options.contact_tolerance) continue;
        for (const std::size_t end : {k, k + 1}) {  // a contact at the other end is not one of this node
          const Vector d = separation(&nodes[end][3 * i], &nodes[end][3 * j], box);
          const bool here = std::sqrt(dot(d, d)) - contact < options.contact_tolerance;
          if (here || found.fraction != (end == k ? 1.0 : 0.0)) contacts[end].push_back(found.normal);
        }
      }
  const std::vector<Point> taus = bends(nodes);
  std::vector<Point> rests = taus;
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
    const std::vector<double> lambda = non_negative_fit(contacts[k], taus[k]);
    for (std::size_t c = 0; c < lambda.size(); ++c) {
      result.multipliers[k] += lambda[c];
      rests[k] = combine(rests[k], -lambda[c], contacts[k][c]);
    }
  }
  finish_certificate(result, taus, rests);
  return result;
}

}  // namespace lanescape::reference
