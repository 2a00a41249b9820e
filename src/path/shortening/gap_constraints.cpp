#include "path/shortening/gap_constraints.hpp"

#include <algorithm>
#include <cmath>

#include "core/float_environment.hpp"
#include "core/parallel.hpp"
#include "core/slot_point.hpp"

namespace lanescape {
namespace {

// Slack times multiplier stays within this factor of the barrier.
constexpr double neighbourhood = 1e3;

Point unit_vector(const Point& d) {
  const double length = std::sqrt(dot(d, d));
  return length > 0.0 ? Point{d[0] / length, d[1] / length, d[2] / length} : Point{1.0, 0.0, 0.0};
}

// Where a constraint holds: that of the closest approach, at the node behind the segment, and planes at either node.
enum Place : std::uint64_t { at_approach, at_node, plane_before, plane_behind };
constexpr std::uint64_t places = 3;  // their bits of a key

std::uint64_t key_of(const Approach& pair, Place place) {
  std::uint64_t result = static_cast<std::uint64_t>(pair.first) << 22 | static_cast<std::uint64_t>(pair.second);
  for (const std::int32_t image : pair.image) result = result << 6 | static_cast<std::uint64_t>(image & 63);
  return result << 2 | static_cast<std::uint64_t>(place);
}

bool by_key(const GapConstraint& a, const GapConstraint& b) { return a.key < b.key; }

// Null where there is none among these, which are in the order of their keys.
const GapConstraint* find_constraint(const std::vector<GapConstraint>& sorted, const GapConstraint& wanted) {
  const auto found = std::lower_bound(sorted.begin(), sorted.end(), wanted, by_key);
  return found != sorted.end() && found->key == wanted.key ? &*found : nullptr;
}

// What is known of a constraint; planes that are new share the multiplier of their closest approach.
struct Known {
  Known(const std::vector<GapConstraint>& sorted, GapConstraint wanted) : constraint(find_constraint(sorted, wanted)) {
    const std::uint64_t place = wanted.key & places;
    if (constraint || place < plane_before) return;
    wanted.key -= place;
    constraint = find_constraint(sorted, wanted);
    if (constraint) share = constraint->shares[place - plane_before];
  }
  double multiplier() const { return share * constraint->multiplier; }
  const GapConstraint* constraint;
  double share = 1.0;
};

// The unit normal of the plane that touches a sphere of radius `contact` and goes through `end`, on the side of `other`.
Point tangent_through(const Point& end, const Point& other, double contact) {
  const Point e = unit_vector(end);
  const double along = dot(other, e), length = std::sqrt(dot(end, end));
  const Point f = unit_vector({other[0] - along * e[0], other[1] - along * e[1], other[2] - along * e[2]});
  const double cosine = std::min(1.0, contact / length), sine = std::sqrt(1.0 - cosine * cosine);
  return {cosine * e[0] + sine * f[0], cosine * e[1] + sine * f[1], cosine * e[2] + sine * f[2]};
}

}  // namespace

SphereCoordinates::SphereCoordinates(const ParticleLayout& layout) : first_(layout.slots(), 0) {
  for (std::size_t particle = 0; particle < layout.size(); ++particle) {
    const std::size_t slot = layout.slot_of(particle);
    first_[slot] = slots_of_.size();
    for (std::size_t axis = 0; axis < 3; ++axis) slots_of_.push_back(axis * layout.slots() + slot);
  }
}

struct GapConstraints::Scratch {
  explicit Scratch(const HardSpherePath& path)
      : spheres(path.box, path.layout, path.radii, kernel_table(path.isa)), gaps(spheres) {}
  HardSphereOverlap spheres;
  SegmentGaps gaps;
};

// The constraints of one segment.
class GapConstraints::Builder {
 public:
  Builder(const GapConstraints& owner, Scratch& scratch, bool first, bool last)
      : owner_(&owner), scratch_(&scratch), first_(first), last_(last) {}

  void add(const Approach& pair, const AlignedArray& from, const AlignedArray& to, std::vector<GapConstraint>& out) const {
    if (pair.first == pair.second) return;
    const AlignedArray& radii = scratch_->spheres.radii();
    const double contact = radii[static_cast<std::size_t>(pair.first)] + radii[static_cast<std::size_t>(pair.second)];
    const Point before = separation_at(from, pair, owner_->box_), behind = separation_at(to, pair, owner_->box_);
    const auto plane = [&](const Point& normal, const Point& d, std::array<double, 2> shares, Place place) {
      const double gap = dot(normal, d) - contact;
      if (gap >= owner_->options_.reach) return false;
      out.push_back(constraint(pair, normal, gap, shares, place));
      return true;
    };
    const auto follow = [&](const Point& d, std::array<double, 2> shares, Place place) {
      if (!plane(unit_vector(d), d, shares, place)) return false;
      out.back().distance = std::sqrt(dot(d, d));
      return true;
    };
    if (!last_) follow(behind, {0.0, 1.0}, at_node);
    if (owner_->shape_ == Shape::planes && !first_ && !last_) {
      const Point normal = unit_vector(pair.separation);
      plane(normal, before, {1.0, 0.0}, plane_before);
      plane(normal, behind, {0.0, 1.0}, plane_behind);
    } else if (first_) {
      if (pair.fraction < 1.0) plane(tangent_through(before, behind, contact), behind, {0.0, 1.0}, at_approach);
    } else if (last_) {
      if (pair.fraction > 0.0) plane(tangent_through(behind, before, contact), before, {1.0, 0.0}, at_approach);
    } else if (follow(pair.separation, {1.0 - pair.fraction, pair.fraction}, at_approach) && pair.fraction > 0.0 &&
               pair.fraction < 1.0) {
      add_turns(pair, difference(behind, before), out.back());
    }
  }

 private:
  // Of the point nearest to the other sphere on a segment along `move`.
  void add_turns(const Approach& pair, const Point& move, GapConstraint& c) const {
    const double length = std::sqrt(dot(move, move));
    for (std::size_t node = 0; node < 2; ++node)
      for (std::size_t sphere = 0; sphere < 2; ++sphere) {
        const double scale = c.scales[sphere] / length;
        const double along = scale * c.shares[node], across = (node == 0 ? -1.0 : 1.0) * scale;
        for (std::size_t axis = 0; axis < 3; ++axis)
          c.turns[node][sphere][axis] = along * move[axis] + across * pair.separation[axis];
      }
  }
  GapConstraint constraint(const Approach& pair, const Point& normal, double gap, std::array<double, 2> shares, Place place) const {
    const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
    return {key_of(pair, place),
            {owner_->coordinates_.first_of(i), owner_->coordinates_.first_of(j)},
            normal,
            {-owner_->scale_[i], owner_->scale_[j]},
            shares,
            gap - owner_->options_.margin};
  }

  const GapConstraints* owner_;
  Scratch* scratch_;
  bool first_, last_;
};

GapConstraints::GapConstraints(const HardSpherePath& path, const Options& options)
    : box_(path.box), metric_(path.metric), options_(options), coordinates_(path.layout), scale_(path.layout.dimension(), 1.0) {
  metric_.to_positions(scale_);
  for (int part = 0; part < options.threads; ++part) scratch_.push_back(std::make_unique<Scratch>(path));
}

GapConstraints::~GapConstraints() = default;

void GapConstraints::build(const Polyline& nodes, SegmentGapConstraints& segments) {
  const std::size_t count = nodes.size() - 1;
  segments.resize(count);
  smallest_.assign(count, options_.reach);
  evaluations_ += count;
  for_each_part(options_.threads, [&](int part) {
    const FloatEnvironment environment;
    Scratch& scratch = *scratch_[static_cast<std::size_t>(part)];
    AlignedArray from, to;
    for (std::size_t k = part_begin(count, part, options_.threads); k < part_begin(count, part + 1, options_.threads); ++k) {
      if (to.empty())
        metric_.to_positions(from = nodes[k]);
      else
        from.swap(to);
      metric_.to_positions(to = nodes[k + 1]);
      segments[k].clear();
      const Builder builder(*this, scratch, k == 0, k + 1 == count);
      for (const Approach& pair : scratch.gaps.below(from, to, options_.reach)) {
        smallest_[k] = std::min(smallest_[k], pair.gap);
        builder.add(pair, from, to, segments[k]);
      }
      std::sort(segments[k].begin(), segments[k].end(), by_key);
    }
  });
}

void GapConstraints::follow(const Polyline& nodes, double barrier, Shape shape) {
  const SegmentGapConstraints before = std::move(segments_);
  shape_ = shape;
  build(nodes, segments_);
  for (std::size_t k = 0; k < segments_.size(); ++k)
    for (GapConstraint& now : segments_[k]) {
      const Known known(before[k], now);
      now.slack = std::max(now.gap, known.constraint ? known.constraint->slack : std::sqrt(barrier));
      const double central = barrier / now.slack;
      now.stiffness = known.constraint && now.distance > 0.0 ? known.multiplier() / now.distance : 0.0;
      now.multiplier =
          known.constraint ? std::clamp(known.multiplier(), central / neighbourhood, central * neighbourhood) : central;
    }
}

SegmentGapConstraints GapConstraints::at(const Polyline& nodes) {
  SegmentGapConstraints result;
  build(nodes, result);
  for (std::size_t k = 0; k < result.size(); ++k)
    for (GapConstraint& now : result[k])
      if (const GapConstraint* const known = find_constraint(segments_[k], now)) now.multiplier = known->multiplier;
  return result;
}

double GapConstraints::smallest_gap() const { return *std::min_element(smallest_.begin(), smallest_.end()); }

void GapConstraints::exchange(Archive& archive) {
  archive.field("evaluations", evaluations_);
  std::vector<std::uint64_t> counts;
  for (const std::vector<GapConstraint>& segment : segments_) counts.push_back(segment.size());
  archive.field("constraint_counts", counts);
  if (archive.reading())
    for (std::size_t k = 0; k < counts.size(); ++k) segments_[k].assign(counts[k], GapConstraint{});
  std::vector<std::uint64_t> keys;
  std::vector<double> slacks, multipliers, shares;
  for (const std::vector<GapConstraint>& segment : segments_)
    for (const GapConstraint& c : segment) {
      keys.push_back(c.key);
      slacks.push_back(c.slack);
      multipliers.push_back(c.multiplier);
      shares.insert(shares.end(), c.shares.begin(), c.shares.end());
    }
  archive.field("constraint_keys", keys);
  archive.field("slacks", slacks);
  archive.field("multipliers", multipliers);
  archive.field("shares", shares);
  std::size_t next = 0;
  for (std::vector<GapConstraint>& segment : segments_)
    for (GapConstraint& c : segment) {
      c.key = keys[next];
      c.slack = slacks[next];
      c.multiplier = multipliers[next];
      c.shares = {shares[2 * next], shares[2 * next + 1]};
      ++next;
    }
}

}  // namespace lanescape
