#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/float_environment.hpp"
#include "core/parallel.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"
#include "interaction/sphere/segment_gaps.hpp"
#include "path/bend.hpp"
#include "path/path_check.hpp"
#include "path/shortening/non_negative.hpp"

namespace lanescape {
namespace {

// The unit vector, in kinematic coordinates, along which a pair in contact comes nearer: minus the gradient of its gap, which only
// six coordinates enter.
struct ContactNormal {
  std::array<std::int32_t, 2> slots;
  std::array<Point, 2> parts;
};

double product(const ContactNormal& a, const ContactNormal& b) {
  double sum = 0.0;
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q)
      if (a.slots[p] == b.slots[q]) sum += dot(a.parts[p], b.parts[q]);
  return sum;
}

// The certificate of a path of hard spheres. Each thread needs its own; they fill the results they share at different nodes.
class HardCheck {
 public:
  HardCheck(const HardSpherePath& path, const Polyline& nodes, const PathCheckOptions& options, PathCheck& check, BendNorms& norms)
      : metric_(&path.metric),
        nodes_(&nodes),
        algebra_(kernel_table(path.isa)),
        spheres_(path.box, path.layout, path.radii, kernel_table(path.isa)),
        gaps_(spheres_),
        several_(path.layout.size() > 1),
        tolerance_(options.contact_tolerance * 2.0 * *std::min_element(path.radii.begin(), path.radii.end())),
        scale_(nodes.front().size(), 1.0),
        bend_(algebra_, nodes),
        check_(&check),
        norms_(&norms) {
    metric_->to_positions(scale_);
  }

  // Of segments [begin, end), the nodes they start from, and after the last segment the end of the path.
  void add(std::size_t begin, std::size_t end) {
    std::vector<Approach> before, behind;
    AlignedArray from = positions(begin), to;
    if (begin > 0) {
      const AlignedArray previous = positions(begin - 1);
      before = contacts(previous, from, std::min(smallest_gap(previous), smallest_gap(from)), nullptr);
    }
    double gap = smallest_gap(from);
    for (std::size_t k = begin; k < end; ++k) {
      to = positions(k + 1);
      const double next = smallest_gap(to);
      check_->excess[k] = gap;
      behind = contacts(from, to, std::min(gap, next), &check_->segment_violation[k]);
      if (k > 0) add_bend(k, from, before, behind);
      before.swap(behind);
      from.swap(to);
      gap = next;
    }
    if (end + 1 == nodes_->size()) check_->excess[end] = gap;
  }

 private:
  AlignedArray positions(std::size_t k) const {
    AlignedArray result = (*nodes_)[k];
    metric_->to_positions(result);
    return result;
  }
  double smallest_gap(const AlignedArray& at) { return spheres_.smallest_gap(at); }

  // The approaches within the contact tolerance. `smallest` is the smaller of the gaps at both ends: the segment's own is at most
  // that.
  std::vector<Approach> contacts(const AlignedArray& from, const AlignedArray& to, double smallest, double* violation) {
    std::vector<Approach> result;
    if (!several_) {
      if (violation) *violation = -std::numeric_limits<double>::infinity();
      return result;
    }
    for (const Approach& approach : gaps_.below(from, to, std::max(tolerance_, smallest + tolerance_))) {
      smallest = std::min(smallest, approach.gap);
      if (approach.gap < tolerance_) result.push_back(approach);
    }
    if (violation) *violation = -smallest;
    return result;
  }

  ContactNormal normal(const Approach& contact) const {
    ContactNormal result{{contact.first, contact.second}, {}};
    double squared = 0.0;
    for (std::size_t p = 0; p < 2; ++p) {
      const double sign = (p == 0 ? 1.0 : -1.0) * scale_[static_cast<std::size_t>(result.slots[p])];
      for (std::size_t axis = 0; axis < 3; ++axis) result.parts[p][axis] = sign * contact.separation[axis];
      squared += dot(result.parts[p], result.parts[p]);
    }
    for (Point& part : result.parts)
      for (double& x : part) x /= std::sqrt(squared);
    return result;
  }

  double gap_at(const AlignedArray& node, const Approach& contact) const {
    const Point d = separation_at(node, contact, spheres_.box());
    return std::sqrt(dot(d, d)) -
           (spheres_.radii()[static_cast<std::size_t>(contact.first)] + spheres_.radii()[static_cast<std::size_t>(contact.second)]);
  }

  // The directions of the contacts of a node. A contact at the far end of a segment is one of that node, unless it holds here too.
  std::vector<ContactNormal> normals(const AlignedArray& node, const std::vector<Approach>& before,
                                     const std::vector<Approach>& behind) const {
    std::vector<ContactNormal> result;
    for (const Approach& contact : before)
      if (contact.fraction > 0.0 || gap_at(node, contact) < tolerance_) result.push_back(normal(contact));
    for (const Approach& contact : behind)
      if (contact.fraction < 1.0 || gap_at(node, contact) < tolerance_) result.push_back(normal(contact));
    return result;
  }

  double projection(const AlignedArray& tau, const ContactNormal& n) const {
    const std::size_t slots = tau.size() / 3;
    double sum = 0.0;
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t axis = 0; axis < 3; ++axis)
        sum += n.parts[p][axis] * tau[axis * slots + static_cast<std::size_t>(n.slots[p])];
    return sum;
  }

  void add_bend(std::size_t k, const AlignedArray& node, const std::vector<Approach>& before, const std::vector<Approach>& behind) {
    AlignedArray rest = bend_.at(k);
    const double size = algebra_.norm(rest);
    const std::vector<ContactNormal> columns = normals(node, before, behind);
    std::vector<double> gram, projections;
    for (const ContactNormal& a : columns) {
      projections.push_back(projection(rest, a));
      for (const ContactNormal& b : columns) gram.push_back(product(a, b));
    }
    const std::vector<double> lambda = non_negative_least_squares(gram, projections);
    const std::size_t slots = rest.size() / 3;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      check_->multipliers[k] += lambda[c];
      for (std::size_t p = 0; p < 2; ++p)
        for (std::size_t axis = 0; axis < 3; ++axis)
          rest[axis * slots + static_cast<std::size_t>(columns[c].slots[p])] -= lambda[c] * columns[c].parts[p][axis];
    }
    norms_->set(k, size, algebra_.norm(rest), bend_.floor());
  }

  const KinematicMetric* metric_;
  const Polyline* nodes_;
  VectorAlgebra algebra_;
  HardSphereOverlap spheres_;
  SegmentGaps gaps_;
  bool several_;
  double tolerance_;    // [sigma]
  AlignedArray scale_;  // dr/dq of each coordinate; that along x is at its slot
  Bend bend_;
  PathCheck* check_;
  BendNorms* norms_;
};

}  // namespace

PathCheck check_path(const HardSpherePath& path, const Polyline& nodes, const PathCheckOptions& options) {
  const FloatEnvironment environment;
  options.check();
  const VectorAlgebra algebra(kernel_table(path.isa));
  check_polyline(algebra, nodes, 3);
  const std::size_t segments = nodes.size() - 1;
  PathCheck check;
  BendNorms norms(nodes.size());
  check.length = polyline_length(algebra, nodes);
  check.excess.resize(nodes.size());
  check.multipliers.assign(nodes.size(), 0.0);
  check.segment_violation.resize(segments);
  const int parts = static_cast<int>(std::min(static_cast<std::size_t>(options.threads), segments));
  for_each_part(parts, [&](int part) {
    HardCheck(path, nodes, options, check, norms).add(part_begin(segments, part, parts), part_begin(segments, part + 1, parts));
  });
  check.largest_violation = std::max(0.0, *std::max_element(check.segment_violation.begin(), check.segment_violation.end()));
  check.kuhn_tucker_residual = norms.residual();
  return check;
}

}  // namespace lanescape
