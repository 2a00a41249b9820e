#include "neighbour/pair_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "neighbour/point_cells.hpp"

namespace lanescape {
namespace {

// The search gives offsets of records as 32-bit numbers.
constexpr std::uint64_t most_points = 0xffffffffU / 4;

kernels::GroupRow row_place(const Point& inside, std::uint32_t self) { return {{inside[0], inside[1], inside[2]}, self}; }

}  // namespace

void PairPoints::sort(const PairSpace& space, std::span<const double> positions, std::span<const std::int32_t> species,
                      double cutoff, const Point& greatest) {
  particles_ = positions.size() / 3;
  fit(space, positions, cutoff, greatest);
  const std::uint64_t count = place_particles(positions);
  if (count > most_points)
    throw_bad_input(fmt::format("{} particles have {:.3g} images within the cutoff {} of the box: at most {:.3g} are allowed",
                                particles_, static_cast<double>(count), cutoff, static_cast<double>(most_points)));
  size_ = static_cast<std::size_t>(count);
  shape_grid();
  list_images();
  sort_images(positions, species);
}

void PairPoints::fit(const PairSpace& space, std::span<const double> positions, double cutoff, const Point& greatest) {
  rounding_ = 0.0;
  double in_reach = 1.0;  // cubes of the cutoff in the box
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::span<const double> along = positions.empty() ? positions : positions.subspan(axis);
    axes_[axis].fit(along, space.periodic[axis], space.edges[axis], space.origin[axis]);
    // Generous, so that rows to come are rarely beyond it.
    greatest_[axis] = std::max(greatest[axis], 16.0 * (space.edges[axis] + std::abs(space.origin[axis])));
    rounding_ += axes_[axis].rounding(greatest_[axis]);
    in_reach *= std::max(1.0, axes_[axis].length() / cutoff);
  }
  const auto particles = static_cast<double>(particles_);
  if (!(in_reach <= particles)) {
    rounding_ = 0.0;
    for (std::size_t axis = 0; axis < 3 && particles_ > 0; ++axis) {
      const double of_axis = axes_[axis].is_periodic() ? axes_[axis].rounding(greatest_[axis]) : 0.0;
      axes_[axis].narrow_gaps(positions.subspan(axis), 2.0 * (cutoff + of_axis));
      rounding_ += axes_[axis].rounding(greatest_[axis]);
    }
  }
  const double reach = cutoff + rounding_;
  scale_ = std::scalbn(1.0, -std::ilogb(reach));
  reach_ = scale_ * reach;
  for (std::size_t axis = 0; axis < 3; ++axis) length_[axis] = scale_ * axes_[axis].length();
}

PairPoints::Home PairPoints::home_of(const double* position) const {
  Home home{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const FoldedAxis::Place place = axes_[axis].place(position[axis]);
    home.inside[axis] = scale_ * place.inside;
    home.boxes[axis] = place.boxes;
  }
  return home;
}

void PairPoints::find_images(Home& home) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = home.inside[axis], length = length_[axis];
    if (!axes_[axis].is_periodic() || (x >= reach_ && x <= length - reach_)) continue;
    home.least[axis] = static_cast<std::int16_t>(-std::max(0.0, std::floor((x + reach_) / length)));
    home.most[axis] = static_cast<std::int16_t>(std::max(0.0, std::floor((length + reach_ - x) / length)));
  }
}

std::uint64_t PairPoints::place_particles(std::span<const double> positions) {
  Home* homes = homes_.room_for(particles_);
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < particles_; ++i) {
    homes[i] = home_of(positions.data() + 3 * i);
    find_images(homes[i]);
    std::uint64_t images = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      images *= static_cast<std::uint64_t>(1 + homes[i].most[axis] - homes[i].least[axis]);
    count += images;
  }
  return count;
}

void PairPoints::shape_grid() {
  Point length{};
  double volume = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) volume *= length[axis] = length_[axis] + 2.0 * reach_;
  // A column is so wide that a run within reach fills a vector; cells are flat, so that a run ends near the reach. There are about
  // four cells per point: empty space does not cost memory.
  const double points = static_cast<double>(size_), least = std::cbrt(volume / (4.0 * points + 64.0));
  const double wide =
      std::max(least, std::clamp(std::sqrt(points_per_run * volume / (1.6 * reach_ * (points + 1.0))), reach_ / 3.0, reach_));
  double edges[3] = {wide, wide, std::max(reach_ / 4.0, least * least * least / (wide * wide))};
  do {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      grid_.cells[axis] = std::max<std::size_t>(1, static_cast<std::size_t>(length[axis] / edges[axis]));
      grid_.low[axis] = -reach_;
      grid_.edge[axis] = length[axis] / static_cast<double>(grid_.cells[axis]);
      grid_.cells_per_length[axis] = 1.0 / grid_.edge[axis];
      edges[axis] *= 2.0;
    }
  } while (cell_count() > 16 * size_ + 256);
}

std::size_t PairPoints::cell_of(const Point& inside) const {
  std::size_t cell = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    cell = cell * grid_.cells[axis] + cell_along(inside[axis] - grid_.low[axis], grid_.cells_per_length[axis], grid_.cells[axis]);
  return cell;
}

std::uint32_t* PairPoints::clear_cells() {
  std::uint32_t* next = next_.room_for(cell_count() + 1);
  std::fill(next, next + cell_count() + 1, 0U);
  return next;
}

void PairPoints::list_images() {
  Image* image = images_.room_for(size_);
  std::uint32_t* counts = clear_cells();
  for (std::size_t i = 0; i < particles_; ++i) {
    const Home& home = homes_[i];
    std::array<std::int16_t, 3> boxes{};
    auto& [a, b, c] = boxes;
    for (a = home.least[0]; a <= home.most[0]; ++a)
      for (b = home.least[1]; b <= home.most[1]; ++b)
        for (c = home.least[2]; c <= home.most[2]; ++c) {
          Point inside{};
          for (std::size_t axis = 0; axis < 3; ++axis) inside[axis] = home.inside[axis] + boxes[axis] * length_[axis];
          const std::size_t cell = cell_of(inside);
          *image++ = {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(cell), boxes};
          ++counts[cell];
        }
  }
}

void PairPoints::sort_images(std::span<const double> positions, std::span<const std::int32_t> species) {
  std::uint32_t *first = first_.room_for(cell_count() + 1), *next = next_.data();
  std::exclusive_scan(next, next + cell_count() + 1, first, 0U);
  std::copy(first, first + cell_count(), next);
  PairPoint* points = points_.room_for(size_);
  std::uint32_t *ranks = ranks_.room_for(size_ + read_ahead), *by_rank = by_rank_.room_for(size_);
  std::array<float*, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    columns[axis] = columns_[axis].room_for(size_ + read_ahead);
    std::fill(columns[axis] + size_, columns[axis] + size_ + read_ahead, 0.0F);
  }
  std::uint32_t* numbers = numbers_.room_for(size_ + read_ahead);
  std::iota(numbers, numbers + size_ + read_ahead, 0U);
  std::fill(ranks + size_, ranks + size_ + read_ahead, 0U);
  for (std::size_t e = 0; e < size_; ++e) {
    const Image& image = images_[e];
    const std::size_t i = image.particle, k = next[image.cell]++;
    const Home& home = homes_[i];
    PairPoint& point = points[k];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point.position[axis] = positions[3 * i + axis];
      point.boxes[axis] = home.boxes[axis] + image.boxes[axis];
      columns[axis][k] = static_cast<float>(home.inside[axis] + image.boxes[axis] * length_[axis]);
    }
    point.particle = static_cast<std::int64_t>(i);
    point.species = species.empty() ? 0U : static_cast<std::uint32_t>(species[i]);
    point.rank = ranks[k] = static_cast<std::uint32_t>(e);
    by_rank[e] = static_cast<std::uint32_t>(k);
  }
  grid_.first = first;
  grid_.x = columns[0];
  grid_.y = columns[1];
  grid_.z = columns[2];
}

const PairRow* PairPoints::own_rows() {
  PairRow* row = rows_.room_for(particles_);
  for (std::size_t k = 0; k < size_; ++k) {
    const PairPoint& point = points_[k];
    const Home& home = homes_[static_cast<std::size_t>(point.particle)];
    if (point.boxes == home.boxes) *row++ = {row_place(home.inside, static_cast<std::uint32_t>(k)), point};
  }
  return rows_.data();
}

void PairPoints::make_rows(std::span<const double> positions, std::span<const std::int32_t> species, PairRow* rows) {
  const std::size_t count = positions.size() / 3;
  Home* homes = homes_.room_for(count);
  std::uint32_t *cells = cells_.room_for(count), *next = clear_cells();
  for (std::size_t i = 0; i < count; ++i) {
    homes[i] = home_of(positions.data() + 3 * i);
    cells[i] = static_cast<std::uint32_t>(cell_of(homes[i].inside));
    ++next[cells[i]];
  }
  std::exclusive_scan(next, next + cell_count() + 1, next, 0U);
  for (std::size_t i = 0; i < count; ++i) {
    PairRow& row = rows[next[cells[i]]++];
    const double* position = positions.data() + 3 * i;
    row = {row_place(homes[i].inside, no_point),
           {{position[0], position[1], position[2]},
            homes[i].boxes,
            static_cast<std::int64_t>(i),
            species.empty() ? 0U : static_cast<std::uint32_t>(species[i]),
            0}};
  }
}

double PairPoints::mean_neighbours() const {
  double in_reach = 4.2 * reach_ * reach_ * reach_;
  for (const double length : length_) in_reach /= length + 2.0 * reach_;
  return in_reach * static_cast<double>(size_);
}

double PairPoints::certain(double cutoff) const { return scale_ * (cutoff - rounding_); }

bool PairPoints::allows(const Point& greatest) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (axes_[axis].is_periodic() && !(greatest[axis] <= greatest_[axis])) return false;
  return true;
}

}  // namespace lanescape
