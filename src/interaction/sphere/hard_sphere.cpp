#include "interaction/sphere/hard_sphere.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/error.hpp"

namespace lanescape {
namespace {

constexpr std::size_t float_padding = 16;  // of the widest single-precision vectors

std::size_t padded(std::size_t n, std::size_t unit) { return (n + unit - 1) / unit * unit; }

double distance_squared(const Box& box, const std::array<double, 3>& a, const std::array<double, 3>& b) {
  const double dx = box.nearest_image(0, b[0] - a[0]), dy = box.nearest_image(1, b[1] - a[1]),
               dz = box.nearest_image(2, b[2] - a[2]);
  return (dx * dx + dy * dy) + dz * dz;
}

// What it costs to compare a sphere with those in the cells around it, in comparisons of a kernel's lane with all others: 40 with
// AVX-512, 25 with AVX2 and 11 with SSE2, so that cells take over from N of about 1500, 1000 and 400 (docs/PERFORMANCE.md).
constexpr double cost_of_cells_per_lane = 5.0;

// Separations of slots as the kernels round them (kernels/sphere_overlap.cpp): every product and sum by itself.
class Separations {
 public:
  Separations(const Box& box, const AlignedArray& positions, const AlignedArray& radii)
      : box_(&box), positions_(positions.data()), radii_(radii.data()), slots_(radii.size()) {}

  std::array<double, 3> position(std::size_t i) const {
    return {positions_[i], positions_[slots_ + i], positions_[2 * slots_ + i]};
  }
  double squared(std::size_t i, std::size_t j) const { return distance_squared(*box_, position(i), position(j)); }
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
      pairs_(16 * layout.size() + 16) {}

kernels::SphereInput HardSphereOverlap::input(const AlignedArray& positions) {
  return {positions.data(),  radii_.data(),   radii_.size(),  {box_.length[0], box_.length[1], box_.length[2]},
          fractions_.data(), reaches_.data(), reaches_.size()};
}

bool HardSphereOverlap::cells_pay(double reach) const {
  if (search_ != SpherePairSearch::by_size) return search_ == SpherePairSearch::cells;
  const double candidates = SortedCells::mean_candidates(box_, 2.0 * largest_radius_ + reach, particles_);
  return static_cast<double>(particles_) > cost_of_cells_per_lane * static_cast<double>(table_->lanes) * candidates;
}

SortedCells HardSphereOverlap::sorted(const AlignedArray& positions, double reach) const {
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
  if (!cells_pay(0.0)) return table_->sphere_any_overlap(input(positions));
  const Separations separations(box_, positions, radii_);
  bool any = false;
  for_each_near_pair(positions, 0.0, [&](std::size_t i, std::size_t j) { any = any || separations.within(0.0, i, j); });
  return any;
}

double HardSphereOverlap::smallest_gap(const AlignedArray& positions) {
  if (particles_ < 2) return std::numeric_limits<double>::infinity();
  const Separations separations(box_, positions, radii_);
  // Nothing is known of gaps beyond the reach: it grows until there is one below.
  for (double reach = 0.2 * largest_radius_; cells_pay(reach); reach *= 2.0) {
    double smallest = std::numeric_limits<double>::infinity();
    for_each_near_pair(positions, reach,
                       [&](std::size_t i, std::size_t j) { smallest = std::min(smallest, separations.gap(i, j)); });
    if (smallest < reach) return smallest;
  }
  return table_->sphere_smallest_gap(input(positions));
}

const std::vector<kernels::SpherePair>& HardSphereOverlap::pairs_within(const AlignedArray& positions, double reach) {
  cells_pay(reach) ? find_pairs_by_cells(positions, reach) : find_pairs_among_all(positions, reach);
  return pairs_;
}

void HardSphereOverlap::find_pairs_among_all(const AlignedArray& positions, double reach) {
  pairs_.resize(pairs_.capacity());
  std::size_t count = table_->sphere_pairs_within(input(positions), reach, pairs_.data(), pairs_.size());
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

// Into the order of kernels::SpherePair: by tiles of rows, and within each of them.
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

HardSphereList::HardSphereList(HardSphereOverlap& spheres, double skin) : spheres_(&spheres) {
  // Of each pair the list knows one image. Another one is at least half a box away when the list is made and comes nearer by less
  // than the skin: it must not reach contact before the list is made anew.
  skin_ = std::max(0.0, std::min(skin, 0.5 * spheres.box().shortest() - 2.0 * spheres.largest_radius()));
}

void HardSphereList::renew_where_due(const AlignedArray& positions) {
  const std::size_t slots = positions.size() / 3;
  // A little less than half the skin: the displacement is rounded too.
  const double allowed = 0.499 * skin_;
  if (made_at_.empty() ||
      !(spheres_->table().largest_displacement_squared(made_at_.data(), positions.data(), slots, 0, slots) <= allowed * allowed))
    rebuild(positions);
}

void HardSphereList::rebuild(const AlignedArray& positions) {
  ++rebuilds_;
  made_at_ = positions;
  const auto& pairs = spheres_->pairs_within(positions, skin_);
  const AlignedArray& radii = spheres_->radii();
  const std::size_t slots = radii.size(), count = padded(pairs.size(), kernels::slot_padding);
  if (first_.empty() || first_.size() < count) {
    const std::size_t room = 2 * count + kernels::slot_padding;
    for (auto* array : {&first_, &second_}) array->resize(room);
    for (auto* arrays : {&shift_, &separation_, &force_})
      for (AlignedArray& array : *arrays) array.resize(room);
    for (auto* array : {&contact_, &squared_}) array->resize(room);
    places_.resize(room + 2 * kernels::slot_padding);
    list_ = {first_.data(), second_.data(), shift_[0].data(), shift_[1].data(), shift_[2].data(), contact_.data(), 0};
    contacts_ = {places_.data(),  separation_[0].data(), separation_[1].data(), separation_[2].data(),
                 squared_.data(), force_[0].data(),      force_[1].data(),      force_[2].data()};
  }
  list_.count = count;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto i = static_cast<std::size_t>(pairs[k].first), j = static_cast<std::size_t>(pairs[k].second);
    first_[k] = pairs[k].first;
    second_[k] = pairs[k].second;
    contact_[k] = radii[i] + radii[j];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double length = spheres_->box().length[axis];
      shift_[axis][k] = length * std::nearbyint((positions[axis * slots + j] - positions[axis * slots + i]) / length);
    }
  }
  for (std::size_t k = pairs.size(); k < count; ++k) {
    first_[k] = second_[k] = 0;
    contact_[k] = std::numeric_limits<double>::quiet_NaN();
    for (auto& shift : shift_) shift[k] = 0.0;
  }
}

bool HardSphereList::any_overlap(const AlignedArray& positions) {
  renew_where_due(positions);
  return spheres_->table().sphere_list_any_overlap(list_, positions.data(), positions.size() / 3);
}

ContactPairs HardSphereList::find_contacts(const AlignedArray& positions) {
  renew_where_due(positions);
  contact_count_ = spheres_->table().sphere_list_contacts(list_, positions.data(), positions.size() / 3, contacts_);
  return {places_.data(), first_.data(), second_.data(), contact_count_};
}

void HardSphereList::add_contact_forces(kernels::ContactPotential potential, AlignedArray& force) {
  spheres_->table().sphere_contact_forces(list_, contacts_, contact_count_, potential, force.data(), force.size() / 3);
}

double sphere_gap(const Configuration& configuration, std::size_t i, std::size_t j) {
  return std::sqrt(distance_squared(configuration.box, configuration.position(i), configuration.position(j))) -
         (configuration.radii[i] + configuration.radii[j]);
}

void check_box_holds_spheres(const Configuration& configuration) {
  const double largest = 2.0 * *std::max_element(configuration.radii.begin(), configuration.radii.end());
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(configuration.box.length[axis] >= 2.0 * largest))
      throw_bad_input(fmt::format("box edge {} along axis {} is not allowed: at least twice the largest diameter {} is needed",
                                  configuration.box.length[axis], axis + 1, largest));
}

void check_no_overlap(const Configuration& configuration, const kernels::KernelTable& table) {
  check_box_holds_spheres(configuration);
  // One species: slots are particles.
  const ParticleLayout layout(std::vector<int>(configuration.size(), 0), 1);
  HardSphereOverlap spheres(configuration.box, layout, configuration.radii, table);
  const auto& pairs = spheres.pairs_within(layout.to_slots(configuration.positions), 0.0);
  if (pairs.empty()) return;
  const auto gap = [&](const kernels::SpherePair& pair) {
    return sphere_gap(configuration, static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
  };
  const auto deepest = *std::min_element(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) { return gap(a) < gap(b); });
  throw_bad_input(fmt::format("particles {} and {} overlap by {}: spheres may touch but not overlap ({} such pairs)", deepest.first,
                              deepest.second, -gap(deepest), pairs.size()));
}

}  // namespace lanescape
