#include "configuration/space_order.hpp"

#include <cmath>
#include <utility>

#include "core/coordinate_checks.hpp"

namespace lanescape {
namespace {

constexpr double far = 5.0;                // [mean spacing of particles]
constexpr double allowed_disorder = 0.25;  // from the best, 0, to none left, 1

}  // namespace

SpaceOrder::SpaceOrder(std::vector<int> species, std::vector<double> diameters, std::size_t species_count)
    : species_(std::move(species)),
      diameters_(std::move(diameters)),
      species_count_(species_count),
      layout_(ParticleLayout::in_users_order({{}, species_, {}, {}, diameters_}, species_count)) {}

bool SpaceOrder::renew(std::span<const double> positions, const Box& box, std::uint64_t rebuilds) {
  if (layout_.size() < ParticleLayout::sorted_from) return false;
  if (!order_.empty()) {
    if (rebuilds < looked_at_) looked_at_ = 0;  // another list was made
    if (rebuilds < looked_at_ + rebuilds_per_look) return false;
    looked_at_ = rebuilds;
    if (disorder(positions, box) <= at_best_ + allowed_disorder * (1.0 - at_best_)) return false;
  }
  check_finite_particles(positions);
  put(order_in_space(positions, box));
  at_best_ = disorder(positions, box);
  looked_at_ = 0;
  return true;
}

double SpaceOrder::disorder(std::span<const double> positions, const Box& box) const {
  const double spacing = std::cbrt(box.volume() / static_cast<double>(order_.size()));
  std::size_t far_apart = 0;
  for (std::size_t k = 1; k < order_.size(); ++k) {
    const Point d = box.nearest_image(difference(point_at(positions.data(), order_[k]), point_at(positions.data(), order_[k - 1])));
    if (dot(d, d) > far * far * spacing * spacing) ++far_apart;
  }
  return static_cast<double>(far_apart) / static_cast<double>(order_.size());
}

void SpaceOrder::put(std::span<const std::size_t> order) {
  layout_ = ParticleLayout::in_order({{}, species_, {}, {}, diameters_}, species_count_, order);
  order_ = layout_.order();
}

void SpaceOrder::exchange(Archive& archive) {
  std::vector<std::uint64_t> order(order_.begin(), order_.end());
  archive.field("order", order);
  archive.field("order_looked_at", looked_at_);
  archive.field("order_at_best", at_best_);
  if (!archive.reading()) return;
  order_.clear();
  if (order.empty())
    layout_ = ParticleLayout::in_users_order({{}, species_, {}, {}, diameters_}, species_count_);
  else
    put(std::vector<std::size_t>(order.begin(), order.end()));
}

}  // namespace lanescape
