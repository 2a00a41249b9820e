#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/point.hpp"
#include "neighbour/folded_axis.hpp"
#include "neighbour/kept_array.hpp"
#include "views/grid.hpp"

namespace lanescape {

// A particle or one of its periodic images, and where a search looks for it.
struct PairPoint {
  Point position;  // of the particle, as it was given
  Point boxes;     // whole boxes added to it
  std::int64_t particle;
  std::uint32_t species;
  std::uint32_t rank;  // in the order of particles and, for one particle, of boxes
};

// A particle whose neighbours are wanted.
struct PairRow {
  kernels::GroupRow place;  // in the grid's unit; `self` is its own point, no_point if it has none
  PairPoint particle;
};
inline constexpr std::uint32_t no_point = 0xffffffffU;

// The space in which pairs are searched.
struct PairSpace {
  Point edges{};  // of the box; those of open axes are 0
  Point origin{};
  std::array<bool, 3> periodic{true, true, true};
};

// Particles and those of their periodic images that can be within a cutoff of a particle in the box, sorted by the cells of a grid.
// Unlike PeriodicPoints it knows open axes, shifts for positions as they were given, and keeps its memory. The grid's unit of
// length is a power of two near the reach, so that squares in single precision neither overflow nor vanish, and any unit works.
class PairPoints {
 public:
  // Sorts the particles. O(N); O(N log N) where the space is sparse. `species` may be empty. `greatest`: of the coordinates of rows
  // to come, along each axis.
  void sort(const PairSpace& space, std::span<const double> positions, std::span<const std::int32_t> species, double cutoff,
            const Point& greatest);

  // The rows of the particles themselves, in the order of the grid.
  const PairRow* own_rows();
  // Writes a row for each position, without a point of its own, in the order of the grid; not thread-safe.
  void make_rows(std::span<const double> positions, std::span<const std::int32_t> species, PairRow* rows);

  // Whether a row lies on the grid; one that does not has no neighbours.
  bool is_on_grid(const PairRow& row) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(row.place.position[axis] >= -reach_ && row.place.position[axis] <= length_[axis] + reach_)) return false;
    return true;
  }

  std::size_t particles() const { return particles_; }
  std::size_t size() const { return size_; }
  const PairPoint* points() const { return points_.data(); }
  const kernels::PointGrid& grid() const { return grid_; }
  // How far a row's neighbours may be from it, and the distance below which they are surely within the cutoff, in the grid's unit.
  double reach() const { return reach_; }
  double certain(double cutoff) const;
  // The order of points: rank to point.
  const std::uint32_t* by_rank() const { return by_rank_.data(); }
  const std::uint32_t* ranks() const { return ranks_.data(); }
  // 0, 1, 2, ... for each point.
  const std::uint32_t* numbers() const { return numbers_.data(); }
  // Of a row, were the points spread evenly.
  double mean_neighbours() const;
  // Whether a row at these coordinates keeps within the rounding that the last sort allowed for.
  bool allows(const Point& greatest) const;

 private:
  struct Home {
    Point inside, boxes;
    std::array<std::int16_t, 3> least, most;  // images
  };
  struct Image {
    std::uint32_t particle, cell;
    std::array<std::int16_t, 3> boxes;
  };

  void fit(const PairSpace& space, std::span<const double> positions, double cutoff, const Point& greatest);
  std::uint64_t place_particles(std::span<const double> positions);
  Home home_of(const double* position) const;
  void find_images(Home& home) const;
  void shape_grid();
  void list_images();
  void sort_images(std::span<const double> positions, std::span<const std::int32_t> species);
  std::size_t cell_of(const Point& inside) const;
  std::uint32_t* clear_cells();
  std::size_t cell_count() const { return grid_.cells[0] * grid_.cells[1] * grid_.cells[2]; }

  std::array<FoldedAxis, 3> axes_;
  Point greatest_{}, length_{};  // length_: in the grid's unit
  double rounding_ = 0.0, scale_ = 1.0, reach_ = 0.0;
  std::size_t particles_ = 0, size_ = 0;
  kernels::PointGrid grid_{};
  KeptArray<Home> homes_;
  KeptArray<Image> images_;
  KeptArray<PairPoint> points_;
  KeptArray<PairRow> rows_;
  KeptArray<std::uint32_t> first_, next_, ranks_, by_rank_, numbers_, cells_;
  std::array<KeptArray<float>, 3> columns_;
};

}  // namespace lanescape
