#include "observables/radial_distribution.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace lanescape {

RadialDistribution::RadialDistribution(const Box& box, const ParticleLayout& layout, std::size_t bins)
    : box_(box),
      blocks_(layout.blocks()),
      slots_(layout.slots()),
      bins_(bins),
      width_(0.5 * box.shortest() / static_cast<double>(bins)),
      counts_(blocks_.size() * blocks_.size() * bins, 0) {}

void RadialDistribution::add(const AlignedArray& position) {
  ++samples_;
  for (std::size_t a = 0; a < blocks_.size(); ++a)
    for (std::size_t b = a; b < blocks_.size(); ++b) {
      std::uint64_t* counts = counts_.data() + (a * blocks_.size() + b) * bins_;
      for (std::size_t i = blocks_[a].begin; i < blocks_[a].begin + blocks_[a].count; ++i)
        for (std::size_t j = a == b ? i + 1 : blocks_[b].begin; j < blocks_[b].begin + blocks_[b].count; ++j) {
          double r2 = 0.0;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const double d = position[axis * slots_ + j] - position[axis * slots_ + i];
            r2 += std::pow(box_.nearest_image(axis, d), 2);
          }
          const auto bin = static_cast<std::size_t>(std::sqrt(r2) / width_);
          if (bin < bins_) ++counts[bin];
        }
    }
}

double RadialDistribution::value(std::size_t a, std::size_t b, std::size_t bin) const {
  if (a > b) std::swap(a, b);
  const double na = static_cast<double>(blocks_[a].count), nb = static_cast<double>(blocks_[b].count);
  const double pairs = a == b ? 0.5 * na * (na - 1.0) : na * nb;
  const double inner = static_cast<double>(bin) * width_, outer = inner + width_;
  const double shell = 4.0 / 3.0 * std::numbers::pi * (outer * outer * outer - inner * inner * inner);
  const double ideal = static_cast<double>(samples_) * pairs * shell / box_.volume();
  return ideal > 0.0 ? static_cast<double>(counts_[(a * blocks_.size() + b) * bins_ + bin]) / ideal : 0.0;
}

void RadialDistribution::exchange(Archive& archive) {
  archive.field("rdf_samples", samples_);
  archive.field("rdf_counts", counts_);
}

}  // namespace lanescape
