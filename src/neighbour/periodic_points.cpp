#include "neighbour/periodic_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/slot_work.hpp"
#include "neighbour/closed_gaps.hpp"
#include "neighbour/least_cell.hpp"
#include "neighbour/point_cells.hpp"

namespace lanescape {
namespace {

// Each part counts the points of all cells, so that there should not be many.
constexpr std::size_t parts_of_thread = 2;
// Beyond, wrapping leaves too few digits.
constexpr double most_boxes_away = 1e12;

void check_boxes_away(double x, double boxes, double length) {
  if (std::abs(boxes) <= most_boxes_away) return;
  check_finite({&x, 1});
  throw_bad_input(fmt::format("coordinate {} of a particle is not allowed in a box of edge {}: at most {} boxes away are", x,
                              length, most_boxes_away));
}

// The nearest whole number, modulo 2^32.
std::int32_t in_units(double x) {
  // Added to a number below 2^51, this leaves no bits for a fraction and the rounded number, modulo 2^32, in the lowest 32.
  constexpr double shifter = 6755399441055744.0;
  return static_cast<std::int32_t>(std::bit_cast<std::uint64_t>(x + shifter));
}

}  // namespace

PeriodicPoints::PeriodicPoints(const Box& box, const ParticleLayout& layout, std::vector<double> margins, int threads,
                               double fixed_unit)
    : whole_box_(box),
      box_(box),
      blocks_(layout.blocks()),
      layout_slots_(layout.slots()),
      threads_(threads),
      fixed_unit_(fixed_unit),
      grids_(margins.size()),
      parts_(threads == 1 ? 1 : parts_of_thread * static_cast<std::size_t>(threads)),
      ranges_((layout.slots() + slot_range - 1) / slot_range) {
  for (std::size_t s = 0; s < margins.size(); ++s) grids_[s].margin = margins[s];
  set_box(box);
}

void PeriodicPoints::set_box(const Box& box) {
  whole_box_ = box_ = box;
  lowest_ = {};
  shape_grids();
  sparse_ = lanescape::is_sparse(box, particles_, largest_margin());
}

void PeriodicPoints::shape_grids() {
  cells_ = particles_ = 0;
  for (std::size_t s = 0; s < grids_.size(); ++s) {
    shape_grid(grids_[s], blocks_[s].count);
    grids_[s].first_cell = cells_;
    grids_[s].first_particle = particles_;
    cells_ += grids_[s].cells();
    particles_ += blocks_[s].count;
  }
}

double PeriodicPoints::largest_margin() const {
  double largest = 0.0;
  for (const Grid& grid : grids_) largest = std::max(largest, grid.margin);
  return largest;
}

void PeriodicPoints::shape_grid(Grid& grid, std::size_t particles) const {
  const double density = static_cast<double>(particles) / box_.volume();
  // A column is so wide that a run within the margin fills a vector; cells are flat, so that a run ends near the margin.
  const double least = least_cell_edge(box_, grid.margin, particles);
  const double wide = std::clamp(std::sqrt(points_per_run / (1.6 * grid.margin * density)), grid.margin / 3.0, grid.margin);
  const std::array<double, 3> edges = {
      std::max(wide, least), std::max(wide, least),
      std::max(grid.margin / 4.0, least * least * least / (std::max(wide, least) * std::max(wide, least)))};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double margin = box_.periodic[axis] ? grid.margin : 0.0, length = box_.length[axis] + 2.0 * margin;
    grid.shape.cells[axis] = std::max<std::size_t>(1, static_cast<std::size_t>(length / edges[axis]));
    grid.shape.low[axis] = lowest_[axis] - margin;
    grid.shape.edge[axis] = length / static_cast<double>(grid.shape.cells[axis]);
    grid.shape.cells_per_length[axis] = 1.0 / grid.shape.edge[axis];
  }
}

std::size_t PeriodicPoints::Grid::cell_of(const std::array<double, 3>& position) const {
  std::size_t cell = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    cell = cell * shape.cells[axis] + cell_along(position[axis] - shape.low[axis], shape.cells_per_length[axis], shape.cells[axis]);
  return cell;
}

template <class Visit>
void PeriodicPoints::for_each_slot(Visit visit) const {
  for (const kernels::SpeciesBlock& block : blocks_)
    for (std::size_t slot = block.begin; slot < block.begin + block.count; ++slot) visit(slot);
}

// A search relies on points lying in their cells, and in single precision on coordinates no larger than the grid.
void PeriodicPoints::reach_out(const AlignedArray& positions) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (whole_box_.periodic[axis]) continue;
    const double length = whole_box_.length[axis];
    double low = 0.0, high = length;
    for_each_slot([&](std::size_t slot) {
      const double x = positions[axis * layout_slots_ + slot];
      check_boxes_away(x, x / length, length);
      low = std::min(low, x);
      high = std::max(high, x);
    });
    lowest_[axis] = low;
    box_.length[axis] = high - low;
  }
  sparse_ = lanescape::is_sparse(box_, particles_, largest_margin());
  if (!sparse_) shape_grids();
}

void PeriodicPoints::close_wide_gaps(const AlignedArray& positions) {
  home_shifts_.resize(layout_slots_);
  home_boxes_.resize(layout_slots_);
  lowest_ = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> coordinates;
    for_each_slot([&](std::size_t slot) { coordinates.push_back(positions[axis * layout_slots_ + slot]); });
    check_finite(coordinates);
    const double least = 2.0 * largest_margin();
    const ClosedGaps closed = whole_box_.periodic[axis] ? close_gaps(std::move(coordinates), whole_box_.length[axis], least)
                                                        : close_open_gaps(std::move(coordinates), least);
    box_.length[axis] = closed.length;
    std::size_t k = 0;
    for_each_slot([&](std::size_t slot) {
      home_shifts_[slot][axis] = closed.shifts[k];
      home_boxes_[slot][axis] = closed.boxes[k++];
      check_boxes_away(positions[axis * layout_slots_ + slot], home_boxes_[slot][axis], whole_box_.length[axis]);
    });
  }
  shape_grids();
}

template <bool sparse>
std::array<double, 3> PeriodicPoints::home_of(const AlignedArray& positions, std::size_t slot) const {
  std::array<double, 3> home{};
  if constexpr (sparse) return home;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double x = positions[axis * layout_slots_ + slot], length = box_.length[axis];
    if ((x >= 0.0 && x < length) || !box_.periodic[axis]) continue;
    home[axis] = -std::floor(x / length);
    check_boxes_away(x, home[axis], length);
  }
  return home;
}

template <bool sparse>
std::array<double, 3> PeriodicPoints::shift_of(const Image& image, const std::array<double, 3>& home) const {
  std::array<double, 3> shift{};
  for (std::size_t axis = 0; axis < 3; ++axis) shift[axis] = (image.boxes[axis] + home[axis]) * box_.length[axis];
  if constexpr (sparse)
    for (std::size_t axis = 0; axis < 3; ++axis) shift[axis] += home_shifts_[image.slot][axis];
  return shift;
}

std::array<int, 3> PeriodicPoints::boxes(std::size_t k) const {
  std::array<int, 3> boxes{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double home_shift = sparse_ ? home_shifts_[slots_[k]][axis] : 0.0, home = sparse_ ? home_boxes_[slots_[k]][axis] : 0.0;
    boxes[axis] = static_cast<int>(std::lround((shifts_[k][axis] - home_shift) / box_.length[axis] + home));
  }
  return boxes;
}

template <bool sparse>
void PeriodicPoints::list_images_of(const AlignedArray& positions, std::size_t slot, const Grid& grid, Part& part) const {
  const std::array<double, 3> home = home_of<sparse>(positions, slot);
  std::array<double, 3> x{};
  std::array<std::int16_t, 3> least{}, most{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = box_.length[axis];
    x[axis] = positions[axis * layout_slots_ + slot];
    const double wrapped = x[axis] + (sparse ? home_shifts_[slot][axis] : home[axis] * length);
    if ((wrapped >= grid.margin && wrapped <= length - grid.margin) || !box_.periodic[axis]) continue;
    const double down = std::floor((wrapped + grid.margin) / length), up = std::floor((length + grid.margin - wrapped) / length);
    least[axis] = down > 0.0 ? static_cast<std::int16_t>(-down) : std::int16_t{0};
    most[axis] = up > 0.0 ? static_cast<std::int16_t>(up) : std::int16_t{0};
  }
  Image image{static_cast<std::uint32_t>(slot), 0, {}};
  auto& [a, b, c] = image.boxes;
  for (a = least[0]; a <= most[0]; ++a)
    for (b = least[1]; b <= most[1]; ++b)
      for (c = least[2]; c <= most[2]; ++c) {
        const std::array<double, 3> shift = shift_of<sparse>(image, home);
        image.cell =
            static_cast<std::uint32_t>(grid.first_cell + grid.cell_of({x[0] + shift[0], x[1] + shift[1], x[2] + shift[2]}));
        ++part.places[image.cell];
        part.images.push_back(image);
      }
}

template <bool sparse>
void PeriodicPoints::list_images(const AlignedArray& positions, std::size_t part) {
  Part& own = parts_[part];
  own.images.clear();
  own.places.assign(cells_, 0);
  for (std::size_t range = first_range(part); range < first_range(part + 1); ++range) {
    const std::size_t begin = range * slot_range, end = begin + slot_range, first = own.images.size();
    for (std::size_t s = 0; s < grids_.size(); ++s) {
      const kernels::SpeciesBlock& block = blocks_[s];
      for (std::size_t slot = std::max(begin, block.begin); slot < std::min(end, block.begin + block.count); ++slot)
        list_images_of<sparse>(positions, slot, grids_[s], own);
    }
    ranges_[range] = {part, first, own.images.size()};
  }
}

// A counting sort: each part of the particles counts its images per cell and stores them after those of earlier parts, so that the
// order does not depend on how many parts there are.
void PeriodicPoints::sort(const AlignedArray& positions) {
  if (whole_box_.has_open_axis()) reach_out(positions);
  if (sparse_) close_wide_gaps(positions);
  sparse_ ? sort_points<true>(positions) : sort_points<false>(positions);
}

template <bool sparse>
void PeriodicPoints::sort_points(const AlignedArray& positions) {
  const auto for_each = [&](const auto& body) { for_each_block(threads_, parts_.size(), body); };
  for_each([&](std::size_t part) { list_images<sparse>(positions, part); });
  place_cells();
  sorted_.room_for(size_);
  slots_.room_for(size_);
  shifts_.room_for(size_);
  points_.room_for(kernels::point_width * size_);
  if (fixed_unit_ > 0.0) fixed_points_.room_for(kernels::point_width * size_);
  for (auto& column : columns_) std::fill_n(column.room_for(size_ + read_ahead) + size_, read_ahead, 0.0F);
  for_each([&](std::size_t part) {
    for (Image& image : parts_[part].images) {
      const std::uint32_t point = parts_[part].places[image.cell]++;
      sorted_[point] = image;
      image.cell = point;
    }
  });
  for_each([&](std::size_t part) { put_points<sparse>(positions, part); });
  number_points();
  rows_.room_for(particles_);
  std::size_t rows = 0;
  for (Part& part : parts_) rows += std::exchange(part.rows, rows);
  for_each([&](std::size_t part) { put_rows(part, parts_[part].rows); });
}

// The same after every sort: written once, until there are more points.
void PeriodicPoints::number_points() {
  if (const std::size_t n = size_ + read_ahead; n > numbered_) {
    numbered_ = n + n / 16;
    offsets_.room_for(numbered_);
    for_each_part(threads_, [&](int part) {
      for (std::size_t k = part_begin(numbered_, part, threads_); k < part_begin(numbered_, part + 1, threads_); ++k)
        offsets_[k] = static_cast<std::uint32_t>(kernels::point_width * k);
    });
  }
}

void PeriodicPoints::count_points(std::size_t part) {
  std::size_t points = 0;
  for (const Part& other : parts_)
    for (std::size_t cell = cells_ * part / parts_.size(); cell < cells_ * (part + 1) / parts_.size(); ++cell)
      points += other.places[cell];
  parts_[part].points = points;
}

void PeriodicPoints::place_points(std::size_t part, std::size_t next) {
  for (std::size_t cell = cells_ * part / parts_.size(); cell < cells_ * (part + 1) / parts_.size(); ++cell) {
    first_[cell] = static_cast<std::uint32_t>(next);
    for (Part& other : parts_) next += std::exchange(other.places[cell], static_cast<std::uint32_t>(next));
  }
}

void PeriodicPoints::place_cells() {
  for_each_block(threads_, parts_.size(), [&](std::size_t part) { count_points(part); });
  size_ = 0;
  for (Part& part : parts_) size_ += std::exchange(part.points, size_);
  first_.room_for(cells_ + 1);
  first_[cells_] = static_cast<std::uint32_t>(size_);
  for_each_block(threads_, parts_.size(), [&](std::size_t part) { place_points(part, parts_[part].points); });
}

template <bool sparse>
void PeriodicPoints::put_points(const AlignedArray& positions, std::size_t part) {
  std::size_t rows = 0;
  const std::size_t begin = size_ * part / parts_.size(), end = size_ * (part + 1) / parts_.size();
  for (std::size_t k = begin; k < end; ++k) {
    const Image& image = sorted_[k];
    const std::array<double, 3> shift = shift_of<sparse>(image, home_of<sparse>(positions, image.slot));
    slots_[k] = image.slot;
    shifts_[k] = shift;
    rows += image.is_own();
    double* point = points_.data() + kernels::point_width * k;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[axis] = positions[axis * layout_slots_ + image.slot] + shift[axis];
      columns_[axis][k] = static_cast<float>(point[axis]);
    }
    point[3] = 0.0;
  }
  parts_[part].rows = rows;
  if (fixed_unit_ > 0.0) fix_points(begin, end);
}

void PeriodicPoints::put_rows(std::size_t part, std::size_t next) {
  for (std::size_t k = size_ * part / parts_.size(); k < size_ * (part + 1) / parts_.size(); ++k)
    if (sorted_[k].is_own()) rows_[next++] = static_cast<std::uint32_t>(kernels::point_width * k);
}

void PeriodicPoints::stretch_to(const Box& box, int part) {
  for (std::size_t k = part_begin(size(), part, threads_); k < part_begin(size(), part + 1, threads_); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (double& shift = shifts_[k][axis]; shift != 0.0) shift = std::round(shift / box_.length[axis]) * box.length[axis];
}

void PeriodicPoints::shift_back(const AlignedArray& before, const AlignedArray& boxes, int part) {
  for (std::size_t k = part_begin(size(), part, threads_); k < part_begin(size(), part + 1, threads_); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t of = axis * layout_slots_ + slots_[k];
      const double was = before.empty() ? 0.0 : before[of];
      if (was == boxes[of]) continue;
      // From counts each time, so that a shift does not depend on how the boxes came about.
      const double length = box_.length[axis], whole = whole_box_.length[axis],
                   home = sparse_ ? home_shifts_[slots_[k]][axis] : 0.0;
      const double count = std::round((shifts_[k][axis] + was * whole - home) / length);
      shifts_[k][axis] = sparse_ ? count * length + home - boxes[of] * whole : (count - boxes[of]) * length;
    }
}

void PeriodicPoints::refresh(const AlignedArray& positions, std::size_t range) {
  fixed_unit_ > 0.0 ? refresh_range<true>(positions, range) : refresh_range<false>(positions, range);
}

template <bool with_integers>
void PeriodicPoints::refresh_range(const AlignedArray& positions, std::size_t range) {
  const double *x = positions.data(), *y = x + layout_slots_, *z = y + layout_slots_, per_length = 1.0 / fixed_unit_;
  const Image* images = parts_[ranges_[range].part].images.data();
  for (std::size_t m = ranges_[range].begin; m < ranges_[range].end; ++m) {
    const std::size_t slot = images[m].slot, k = images[m].cell;
    const std::array<double, 3>& shift = shifts_[k];
    const double at[3] = {x[slot] + shift[0], y[slot] + shift[1], z[slot] + shift[2]};
    for (std::size_t axis = 0; axis < 3; ++axis) points_[kernels::point_width * k + axis] = at[axis];
    if constexpr (with_integers)
      for (std::size_t axis = 0; axis < 3; ++axis) fixed_points_[kernels::point_width * k + axis] = in_units(at[axis] * per_length);
  }
}

void PeriodicPoints::set_values(const AlignedArray& per_slot, std::size_t stride, int part) {
  const std::size_t begin = part_begin(size(), part, threads_), end = part_begin(size(), part + 1, threads_);
  for (std::size_t k = begin; k < end; ++k) points_[kernels::point_width * k + 3] = per_slot[stride * slots_[k]];
  if (fixed_unit_ > 0.0) fix_points(begin, end);
}

void PeriodicPoints::fix_points(std::size_t begin, std::size_t end) {
  const double per_length = 1.0 / fixed_unit_;
  for (std::size_t k = kernels::point_width * begin; k < kernels::point_width * end; ++k)
    fixed_points_[k] = in_units(points_[k] * per_length);
}

kernels::PointGrid PeriodicPoints::grid(std::size_t species) const {
  kernels::PointGrid view = grids_[species].shape;
  view.first = first_.data() + grids_[species].first_cell;
  view.x = columns_[0].data();
  view.y = columns_[1].data();
  view.z = columns_[2].data();
  return view;
}

std::size_t PeriodicPoints::memory() const {
  const auto bytes_of = [](const auto& array) { return array.capacity() * sizeof(*array.data()); };
  std::size_t bytes = bytes_of(points_) + bytes_of(fixed_points_) + bytes_of(slots_) + bytes_of(shifts_) + bytes_of(first_) +
                      bytes_of(rows_) + bytes_of(offsets_) + bytes_of(sorted_);
  for (const auto& column : columns_) bytes += bytes_of(column);
  for (const Part& part : parts_) bytes += bytes_of(part.images) + bytes_of(part.places);
  bytes += bytes_of(ranges_);
  return bytes;
}

}  // namespace lanescape
