#include "neighbour/cluster_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace lanescape {
namespace {

using kernels::cluster_size;
using kernels::cluster_width;

// Beyond, wrapping leaves too few digits.
constexpr double most_boxes = 1e12;

// Units of which 2^31 are a place without a particle away from its cluster, along each axis. Clusters are at most two reaches long
// and one wide, so that places of two listed clusters differ by less than 1 + 2 sqrt(6) < 6 reaches; eight leave room for skins.
double unit_for(double reach) { return std::ldexp(1.0, std::ilogb(8.0 * reach) + 1 - 31); }

double home_of(double x, double length) {
  if (x >= 0.0 && x < length) return 0.0;
  const double boxes = -std::floor(x / length);
  if (std::abs(boxes) <= most_boxes) return boxes;
  check_finite({&x, 1});
  throw_bad_input(fmt::format("coordinate {} of a particle is not allowed in a box of edge {}: at most {} boxes away are", x,
                              length, most_boxes));
}

}  // namespace

ClusterColumns::ClusterColumns(const Box& box, const ParticleLayout& layout, const std::vector<double>& reaches, int threads)
    : box_(box),
      blocks_(layout.blocks()),
      layout_slots_(layout.slots()),
      threads_(threads),
      longest_(2.0 * *std::max_element(reaches.begin(), reaches.end())),
      fixed_unit_(unit_for(0.5 * longest_)),
      grids_(layout.blocks().size()) {}

std::array<double, 2> ClusterColumns::edge(std::size_t species) const {
  const Grid& grid = grids_[species];
  return {box_.length[0] / static_cast<double>(grid.count[0]), box_.length[1] / static_cast<double>(grid.count[1])};
}

void ClusterColumns::shape(Grid& grid, std::size_t particles) const {
  const double cube = std::cbrt(static_cast<double>(cluster_size) * box_.volume() / (static_cast<double>(particles) + 1e-3)),
               edge = std::min(cube, 0.5 * longest_);
  for (std::size_t axis = 0; axis < 2; ++axis)
    grid.count[axis] = static_cast<std::size_t>(std::max(1.0, std::nearbyint(std::ceil(box_.length[axis] / edge - 0.5))));
}

std::size_t ClusterColumns::column_of(const Grid& grid, const std::array<double, 3>& position) const {
  std::size_t column = 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto along = static_cast<std::size_t>(position[axis] / box_.length[axis] * static_cast<double>(grid.count[axis]));
    column = column * grid.count[axis] + std::min(along, grid.count[axis] - 1);
  }
  return grid.first_column + column;
}

ClusterColumns::Placed ClusterColumns::placed(const AlignedArray& positions, std::size_t slot) const {
  Placed one{static_cast<std::uint32_t>(slot), {}, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = positions[axis * layout_slots_ + slot], length = box_.length[axis];
    one.home[axis] = home_of(x, length);
    one.position[axis] = x + one.home[axis] * length;
  }
  return one;
}

void ClusterColumns::sort_into_columns(const AlignedArray& positions) {
  std::size_t columns = 0, particles = 0;
  for (std::size_t s = 0; s < grids_.size(); ++s) {
    shape(grids_[s], blocks_[s].count);
    grids_[s].first_column = columns;
    columns += grids_[s].count[0] * grids_[s].count[1];
    particles += blocks_[s].count;
  }
  first_placed_.assign(columns + 1, 0);
  column_of_slot_.resize(layout_slots_);
  for (std::size_t s = 0; s < grids_.size(); ++s)
    for_each_part(threads_, [&](int part) {
      for (std::size_t k = part_begin(blocks_[s].count, part, threads_); k < part_begin(blocks_[s].count, part + 1, threads_);
           ++k) {
        const std::size_t slot = blocks_[s].begin + k;
        column_of_slot_[slot] = static_cast<std::uint32_t>(column_of(grids_[s], placed(positions, slot).position));
      }
    });
  const auto for_each_slot = [&](auto visit) {
    for (const kernels::SpeciesBlock& block : blocks_)
      for (std::size_t slot = block.begin; slot < block.begin + block.count; ++slot) visit(slot);
  };
  for_each_slot([&](std::size_t slot) { ++first_placed_[column_of_slot_[slot] + 1]; });
  for (std::size_t column = 0; column < columns; ++column) first_placed_[column + 1] += first_placed_[column];
  placed_.resize(particles);
  std::vector<std::uint32_t> next(first_placed_.begin(), first_placed_.end() - 1);
  for_each_slot([&](std::size_t slot) { placed_[next[column_of_slot_[slot]]++].slot = static_cast<std::uint32_t>(slot); });
}

template <class Take>
void ClusterColumns::cut(std::size_t column, Take take) const {
  std::size_t first = first_placed_[column];
  for (std::size_t k = first; k < first_placed_[column + 1]; ++k)
    if (k - first == cluster_size || placed_[k].position[2] - placed_[first].position[2] > longest_) {
      take(first, k - first);
      first = k;
    }
  if (first < first_placed_[column + 1]) take(first, first_placed_[column + 1] - first);
}

void ClusterColumns::sort(const AlignedArray& positions) {
  sort_into_columns(positions);
  const std::size_t columns = first_placed_.size() - 1;
  first_.assign(columns + 1, 0);
  for_each_part(threads_, [&](int part) {
    for (std::size_t column = part_begin(columns, part, threads_); column < part_begin(columns, part + 1, threads_); ++column) {
      for (std::size_t k = first_placed_[column]; k < first_placed_[column + 1]; ++k)
        placed_[k] = placed(positions, placed_[k].slot);
      std::sort(placed_.begin() + first_placed_[column], placed_.begin() + first_placed_[column + 1],
                [](const Placed& a, const Placed& b) {
                  return a.position[2] != b.position[2] ? a.position[2] < b.position[2] : a.slot < b.slot;
                });
      cut(column, [&](std::size_t, std::size_t) { ++first_[column + 1]; });
    }
  });
  for (std::size_t column = 0; column < columns; ++column) first_[column + 1] += first_[column];
  bounds_.resize(first_[columns]);
  filled_.resize(first_[columns]);
  slots_.resize(cluster_size * clusters());
  for (AlignedArray* array : {&homes_, &shifts_}) array->resize(cluster_width * clusters());
  points_.resize(cluster_width * clusters());
  for_each_part(threads_, [&](int part) {
    for (std::size_t column = part_begin(columns, part, threads_); column < part_begin(columns, part + 1, threads_); ++column) {
      std::size_t cluster = first_[column];
      cut(column, [&](std::size_t first, std::size_t count) { put_cluster(cluster++, placed_.data() + first, count); });
    }
  });
}

void ClusterColumns::put_cluster(std::size_t cluster, Placed* particles, std::size_t count) {
  filled_[cluster] = static_cast<std::uint8_t>(count);
  Bounds& bounds = bounds_[cluster] = {particles[0].position, particles[0].position};
  for (std::size_t place = 0; place < cluster_size; ++place) {
    const Placed& particle = particles[place < count ? place : 0];
    slots_[cluster_size * cluster + place] = particle.slot;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      homes_[cluster_width * cluster + cluster_size * axis + place] = particle.home[axis];
      bounds.low[axis] = std::min(bounds.low[axis], particle.position[axis]);
      bounds.high[axis] = std::max(bounds.high[axis], particle.position[axis]);
    }
  }
  find_shifts(cluster, {});
}

void ClusterColumns::find_shifts(std::size_t cluster, const AlignedArray& boxes) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t place = 0; place < cluster_size; ++place) {
      const std::size_t k = cluster_width * cluster + cluster_size * axis + place;
      const double since = boxes.empty() ? 0.0 : boxes[axis * layout_slots_ + slot(cluster, place)];
      shifts_[k] = (homes_[k] - since) * box_.length[axis] + (place < filled_[cluster] ? 0.0 : fixed_unit_ * 0x1p31);
    }
}

void ClusterColumns::shift_back(const AlignedArray& boxes) {
  for_each_part(threads_, [&](int part) {
    for (std::size_t c = part_begin(clusters(), part, threads_); c < part_begin(clusters(), part + 1, threads_); ++c)
      find_shifts(c, boxes);
  });
}

void ClusterColumns::refresh(const AlignedArray& positions, int part) {
  // Added to a number below 2^51, this leaves no bits for a fraction and the rounded number, modulo 2^32, in the lowest 32.
  constexpr double shifter = 6755399441055744.0;
  const double per_length = 1.0 / fixed_unit_;
  for (std::size_t c = part_begin(clusters(), part, threads_); c < part_begin(clusters(), part + 1, threads_); ++c) {
    const std::uint32_t* slots = slots_.data() + cluster_size * c;
    const double *x = positions.data(), *shift = shifts_.data() + cluster_width * c;
    std::int32_t* point = points_.data() + cluster_width * c;
    for (std::size_t axis = 0; axis < 3; ++axis, x += layout_slots_, shift += cluster_size, point += cluster_size)
      for (std::size_t place = 0; place < cluster_size; ++place)
        point[place] =
            static_cast<std::int32_t>(std::bit_cast<std::uint64_t>((x[slots[place]] + shift[place]) * per_length + shifter));
  }
}

std::size_t ClusterColumns::memory() const {
  return (first_.capacity() + first_placed_.capacity() + column_of_slot_.capacity() + slots_.capacity() + points_.capacity()) *
             sizeof(std::uint32_t) +
         placed_.capacity() * sizeof(Placed) + bounds_.capacity() * sizeof(Bounds) + filled_.capacity() +
         (homes_.capacity() + shifts_.capacity()) * sizeof(double);
}

}  // namespace lanescape
