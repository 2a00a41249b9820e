#include "interaction/sphere/gap_list.hpp"

#include <algorithm>
#include <cmath>

#include "core/float_environment.hpp"

namespace lanescape {
namespace {

// A range of half a box beyond contact: with edges of at least two diameters, no image further away than the 26 around the nearest
// is within it.
double allowed_share(const Box& box, double range) { return std::min(1.0, 0.5 * box.shortest() / range); }

// The separation of two slots before any image is chosen.
Point separation(const AlignedArray& positions, std::size_t slots, std::size_t i, std::size_t j) {
  Point d;
  for (std::size_t axis = 0; axis < 3; ++axis) d[axis] = positions[axis * slots + j] - positions[axis * slots + i];
  return d;
}

}  // namespace

GapList::GapList(HardSphereOverlap& spheres, double reach, double skin)
    : spheres_(&spheres),
      reach_(reach * allowed_share(spheres.box(), reach + skin)),
      half_skin_(skin * allowed_share(spheres.box(), reach + skin), spheres.table()) {}

void GapList::add_images(const AlignedArray& positions, const kernels::SpherePair& pair) {
  const AlignedArray& radii = spheres_->radii();
  const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
  const double range = radii[i] + radii[j] + reach_ + half_skin_.skin();
  const Box& box = spheres_->box();
  const Point raw = separation(positions, radii.size(), i, j), nearest = box.nearest_image(raw);
  for (int cell = 0; cell < 27; ++cell) {
    const Point d{nearest[0] + box.length[0] * (cell % 3 - 1), nearest[1] + box.length[1] * (cell / 3 % 3 - 1),
                  nearest[2] + box.length[2] * (cell / 9 - 1)};
    if (dot(d, d) >= range * range) continue;
    gaps_.push_back({pair.first, pair.second, 0.0, {}});
    shifts_.push_back(difference(d, raw));
  }
}

void GapList::rebuild(const AlignedArray& positions) {
  ++rebuilds_;
  half_skin_.rebuilt_at(positions);
  gaps_.clear();
  shifts_.clear();
  for (const kernels::SpherePair& pair : spheres_->pairs_within(positions, reach_ + half_skin_.skin())) add_images(positions, pair);
}

const std::vector<PairGap>& GapList::at(const AlignedArray& positions) {
  const FloatEnvironment environment;
  if (half_skin_.is_due(positions)) rebuild(positions);
  const AlignedArray& radii = spheres_->radii();
  for (std::size_t k = 0; k < gaps_.size(); ++k) {
    PairGap& pair = gaps_[k];
    const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
    Point d = separation(positions, radii.size(), i, j);
    for (std::size_t axis = 0; axis < 3; ++axis) d[axis] += shifts_[k][axis];
    const double r = std::sqrt(dot(d, d));
    pair.gap = r - (radii[i] + radii[j]);
    pair.normal = r > 0.0 ? Point{d[0] / r, d[1] / r, d[2] / r} : Point{1.0, 0.0, 0.0};
  }
  return gaps_;
}

void GapList::exchange(Archive& archive) {
  AlignedArray reference = half_skin_.reference();
  archive.field("rebuilt_at", reference);
  if (archive.reading()) {
    half_skin_.forget();
    if (!reference.empty()) rebuild(reference);
  }
  archive.field("rebuilds", rebuilds_);
}

}  // namespace lanescape
