#include "interaction/sphere/hard_sphere_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/coordinate_checks.hpp"
#include "core/float_environment.hpp"
#include "core/padded.hpp"

namespace lanescape {
namespace {

constexpr std::size_t float_padding = 16;  // of the widest single-precision vectors

// The cost of comparing a sphere with those in the cells around it, in comparisons of a kernel's lane with all others: 40 with
// AVX-512, 25 with AVX2 and 11 with SSE2, so that cells take over from N of about 1500, 1000 and 400 (docs/PERFORMANCE.md).
constexpr double cost_of_cells_per_lane = 5.0;

// Separations of slots as the kernels round them (kernels/sphere_overlap.cpp): each product and sum is rounded by itself.
class Separations {
 public:
  Separations(const Box& box, const AlignedArray& positions, const AlignedArray& radii)
      : box_(&box), positions_(positions.data()), radii_(radii.data()), slots_(radii.size()) {}

  Point position(std::size_t i) const { return {positions_[i], positions_[slots_ + i], positions_[2 * slots_ + i]}; }
  double squared(std::size_t i, std::size_t j) const {
    const Point d = box_->nearest_image(difference(position(j), position(i)));
    return dot(d, d);
  }
  bool within(double reach, std::size_t i, std::size_t j) const {
    const double range = (radii_[i] + radii_[j]) + reach;
    return squared(i, j) < range * range;
  }
  double gap(std::size_t i, std::size_t j) const { return std::sqrt(squared(i, j)) - (radii_[i] + radii_[j]); }

 private:
  const Box* box_;
  const double *positions_, *radii_;
  std::size_t slots_;
};

}  // namespace

HardSphereOverlap::HardSphereOverlap(const Box& box, const ParticleLayout& layout, const std::vector<double>& radii,
                                     const kernels::KernelTable& table, SpherePairSearch search)
    : table_(&table),
      box_(box),
      search_(search),
      particles_(layout.size()),
      radii_(layout.per_slot(radii, std::numeric_limits<double>::quiet_NaN())),
      largest_radius_(radii.empty() ? 0.0 : *std::max_element(radii.begin(), radii.end())),
      fractions_(3 * padded(layout.slots(), float_padding)),
      reaches_(padded(layout.slots(), float_padding)),
      pairs_(16 * layout.size() + 16) {
  check_periodic(box, "hard spheres");
}

kernels::SphereInput HardSphereOverlap::input(const AlignedArray& positions) {
  return {positions.data(),  radii_.data(),   radii_.size(),  {box_.length[0], box_.length[1], box_.length[2]},
          fractions_.data(), reaches_.data(), reaches_.size()};
}

bool HardSphereOverlap::cells_are_cheaper(double reach) const {
  if (search_ != SpherePairSearch::by_size) return search_ == SpherePairSearch::cells;
  const double candidates = SortedCells::mean_candidates(box_, 2.0 * largest_radius_ + reach, particles_);
  return static_cast<double>(particles_) > cost_of_cells_per_lane * static_cast<double>(table_->lanes) * candidates;
}

SortedCells HardSphereOverlap::sorted(const AlignedArray& positions, double reach) const {
  check_finite(positions);
  const Separations separations(box_, positions, radii_);
  std::vector<SortedCells::Point> points;
  points.reserve(particles_);
  for (std::size_t slot = 0; slot < radii_.size(); ++slot)
    if (!std::isnan(radii_[slot])) points.push_back({separations.position(slot), static_cast<std::uint32_t>(slot)});
  return {box_, 2.0 * largest_radius_ + reach, std::move(points)};
}

// Calls visit(i, j), i < j, for all pairs that can have a gap below the reach, in any order.
template <class Visit>
void HardSphereOverlap::for_each_near_pair(const AlignedArray& positions, double reach, Visit visit) const {
  const SortedCells cells = sorted(positions, reach);
  cells.for_each_pair([&](std::uint32_t i, std::uint32_t j, double squared) {
    const double range = radii_[i] + radii_[j] + reach + cells.margin();
    if (squared < range * range) visit(std::min(i, j), std::max(i, j));
  });
}

bool HardSphereOverlap::any_overlap(const AlignedArray& positions) {
  const FloatEnvironment environment;
  if (!cells_are_cheaper(0.0)) {
    const bool any = table_->sphere_any_overlap(input(positions));
    if (any) check_finite(positions);
    return any;
  }
  const Separations separations(box_, positions, radii_);
  bool any = false;
  for_each_near_pair(positions, 0.0, [&](std::size_t i, std::size_t j) { any = any || separations.within(0.0, i, j); });
  return any;
}

double HardSphereOverlap::smallest_gap(const AlignedArray& positions) {
  const FloatEnvironment environment;
  check_finite(positions);
  if (particles_ < 2) return std::numeric_limits<double>::infinity();
  const Separations separations(box_, positions, radii_);
  // The cells know no gaps beyond the reach: it grows until a gap is below it.
  for (double reach = 0.2 * largest_radius_; cells_are_cheaper(reach); reach *= 2.0) {
    double smallest = std::numeric_limits<double>::infinity();
    for_each_near_pair(positions, reach,
                       [&](std::size_t i, std::size_t j) { smallest = std::min(smallest, separations.gap(i, j)); });
    if (smallest < reach) return smallest;
  }
  return table_->sphere_smallest_gap(input(positions));
}

const std::vector<kernels::SpherePair>& HardSphereOverlap::pairs_within(const AlignedArray& positions, double reach) {
  const FloatEnvironment environment;
  cells_are_cheaper(reach) ? find_pairs_by_cells(positions, reach) : find_pairs_among_all(positions, reach);
  return pairs_;
}

void HardSphereOverlap::find_pairs_among_all(const AlignedArray& positions, double reach) {
  pairs_.resize(pairs_.capacity());
  std::size_t count = table_->sphere_pairs_within(input(positions), reach, pairs_.data(), pairs_.size());
  if (count == kernels::sphere_pairs_broken) check_finite(positions);
  if (count > pairs_.size()) {
    pairs_.resize(2 * count);
    count = table_->sphere_pairs_within(input(positions), reach, pairs_.data(), pairs_.size());
  }
  pairs_.resize(count);
}

void HardSphereOverlap::find_pairs_by_cells(const AlignedArray& positions, double reach) {
  const Separations separations(box_, positions, radii_);
  pairs_.clear();
  for_each_near_pair(positions, reach, [&](std::size_t i, std::size_t j) {
    if (separations.within(reach, i, j)) pairs_.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
  });
  sort_pairs();
}

// Sorts the pairs into the order of kernels::SpherePair: by tiles of rows first, then within each tile.
void HardSphereOverlap::sort_pairs() {
  const auto columns = static_cast<std::int32_t>(table_->sphere_pair_columns);
  const auto in_order = [columns](const kernels::SpherePair& a, const kernels::SpherePair& b) {
    return std::tuple(a.second / columns, a.first, a.second) < std::tuple(b.second / columns, b.first, b.second);
  };
  const auto tile = [](const kernels::SpherePair& pair) {
    return static_cast<std::size_t>(pair.first) / kernels::sphere_pair_rows;
  };
  tile_ends_.assign(radii_.size() / kernels::sphere_pair_rows, 0);
  for (const auto& pair : pairs_) ++tile_ends_[tile(pair)];
  std::size_t before = 0;
  for (std::size_t& end : tile_ends_) before += std::exchange(end, before);
  unsorted_.swap(pairs_);
  pairs_.resize(unsorted_.size());
  for (const auto& pair : unsorted_) pairs_[tile_ends_[tile(pair)]++] = pair;
  auto begin = pairs_.begin();
  for (const std::size_t end : tile_ends_) {
    const auto tile_end = pairs_.begin() + static_cast<std::ptrdiff_t>(end);
    std::sort(begin, tile_end, in_order);
    begin = tile_end;
  }
}

}  // namespace lanescape
