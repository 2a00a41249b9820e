#include "observables/radial_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/coordinate_checks.hpp"
#include "neighbour/sorted_cells.hpp"

namespace lanescape {

double RadialDistribution::default_range(const Box& box, std::size_t particles, double length_unit) {
  const double half = 0.5 * box.shortest();
  return particles <= most_for_half_the_box ? half : std::min(half, range_of_large_systems * length_unit);
}

RadialDistribution::RadialDistribution(const Box& box, const ParticleLayout& layout, std::size_t bins, double range)
    : box_(box),
      blocks_(layout.blocks()),
      slots_(layout.slots()),
      bins_(bins),
      range_(range),
      width_(range / static_cast<double>(bins)),
      counts_(blocks_.size() * blocks_.size() * bins, 0) {
  check_periodic(box, "radial distributions");
}

void RadialDistribution::add(const AlignedArray& position) {
  ++samples_;
  std::vector<SortedCells::Point> points;
  std::vector<std::size_t> species_of(slots_, 0);
  for (std::size_t s = 0; s < blocks_.size(); ++s)
    for (std::size_t slot = blocks_[s].begin; slot < blocks_[s].begin + blocks_[s].count; ++slot) {
      points.push_back({{position[slot], position[slots_ + slot], position[2 * slots_ + slot]}, static_cast<std::uint32_t>(slot)});
      species_of[slot] = s;
    }
  SortedCells(box_, range_, std::move(points)).for_each_pair([&](std::size_t i, std::size_t j, double) {
    double r2 = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      r2 += std::pow(box_.nearest_image(axis, position[axis * slots_ + j] - position[axis * slots_ + i]), 2);
    const auto bin = static_cast<std::size_t>(std::sqrt(r2) / width_);
    const auto [a, b] = std::minmax(species_of[i], species_of[j]);
    if (bin < bins_) ++counts_[(a * blocks_.size() + b) * bins_ + bin];
  });
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
