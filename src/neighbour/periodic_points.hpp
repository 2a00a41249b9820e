#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/box.hpp"
#include "neighbour/kept_array.hpp"
#include "views/grid.hpp"
#include "views/pair.hpp"

namespace lanescape {

// The particles of a box and those of their periodic images that lie within a margin of it, as points: species by species, and
// within a species by the cells of a grid over box and margin, so that points near in space are near in memory. With images as
// points of their own, separations are plain differences and the box may be of any size, down to a fraction of the margin.
// In a sparse box wide gaps between particles are narrowed first (ClosedGaps): separations within the margin stay as they are.
// Along an open axis there are no images and nothing is wrapped; the grid reaches as far as the particles do.
//
// Cells run fastest along z: the points of neighbouring cells of one column are one run. The order depends on the positions
// alone, not on the number of threads.
class PeriodicPoints {
 public:
  // `margins`: for each species, how far from the box its images matter [sigma]. `fixed_unit`: of the points as integers, a power
  // of two [sigma]; 0: there are none.
  PeriodicPoints(const Box& box, const ParticleLayout& layout, std::vector<double> margins, int threads, double fixed_unit = 0.0);

  // Sorts the points of these positions (layout's order, wrapped or not). O(N). Throws Error(bad_input) for a coordinate that is
  // not finite or more than 10^12 boxes away.
  void sort(const AlignedArray& positions);
  // The next sort is in this box.
  void set_box(const Box& box);
  // Whether wide gaps are narrowed.
  bool is_sparse() const { return sparse_; }
  // Keep the points of the last sort, each a part of them, one per thread. For a box that is not sparse and takes the place of the
  // present one with the next set_box(): points stay as many boxes away from their particles.
  void stretch_to(const Box& box, int part);
  // Counts of boxes, per coordinate in the layout's order, by which particles were shifted since the sort: their points stay where
  // they are once refreshed. `before`: those of the last call, or zeros.
  void shift_back(const AlignedArray& before, const AlignedArray& boxes, int part);
  // Updates the points of the particles in a range of slots, of slot_range slots, to new positions.
  void refresh(const AlignedArray& positions, std::size_t range);
  std::size_t ranges() const { return ranges_.size(); }

  // Copies one number of each particle into the fourth number of its points' records, until the next sort.
  void set_values(const AlignedArray& per_slot, std::size_t stride, int part);  // of a part of the points, one per thread

  std::size_t species() const { return grids_.size(); }
  std::size_t size() const { return size_; }
  // Records of kernels::point_width doubles.
  const double* points() const { return points_.data(); }
  const double* point(std::size_t k) const { return points_.data() + kernels::point_width * k; }
  // The same in units of fixed_unit(), modulo 2^32: records of kernels::point_width integers. Null if there are none.
  const std::int32_t* fixed_points() const { return fixed_unit_ > 0.0 ? fixed_points_.data() : nullptr; }
  double fixed_unit() const { return fixed_unit_; }
  // The slot of the particle that a point is, or is an image of.
  std::uint32_t slot(std::size_t k) const { return slots_[k]; }
  // Boxes to add to that particle's position.
  std::array<int, 3> boxes(std::size_t k) const;
  // The box that the points of the last sort fill, its wide gaps narrowed.
  const Box& box() const { return box_; }
  // Offsets of the points of a species that are in the box, one for each particle, in the order of points.
  std::span<const std::uint32_t> rows(std::size_t species) const {
    return {rows_.data() + grids_[species].first_particle, blocks_[species].count};
  }

  // A species' points as they were sorted, for kernels::KernelTable::points_within.
  kernels::PointGrid grid(std::size_t species) const;
  // The offset of each point, which is what a list holds of it; readable beyond the last as the grid is.
  const std::uint32_t* offsets() const { return offsets_.data(); }
  std::size_t memory() const;  // [bytes]

 private:
  struct Grid {
    double margin = 0.0;
    kernels::PointGrid shape{};  // its pointers are set when it is handed out
    std::size_t first_cell = 0;  // among the cells of all species, one after the other
    std::size_t first_particle = 0;
    std::size_t cells() const { return shape.cells[0] * shape.cells[1] * shape.cells[2]; }
    std::size_t cell_of(const std::array<double, 3>& position) const;
  };
  struct Image {
    std::uint32_t slot;
    std::uint32_t cell;                 // once sorted, the point
    std::array<std::int16_t, 3> boxes;  // from the particle's own point in the box
    bool is_own() const { return (boxes[0] | boxes[1] | boxes[2]) == 0; }
  };
  // The images of the particles in a range of slots, among those of a part.
  struct Range {
    std::size_t part, begin, end;
  };
  // The work of a sort is cut into parts, several for each thread: ranges of slots, cells or points.
  struct Part {
    AlignedVector<Image> images;          // of its particles, in the order of their slots
    AlignedVector<std::uint32_t> places;  // per cell: the number of these; then where the next of them goes
    std::size_t points = 0, rows = 0;     // in its cells; among its points
  };

  double largest_margin() const;
  void shape_grids();
  void shape_grid(Grid& grid, std::size_t particles) const;
  template <class Visit>
  void for_each_slot(Visit visit) const;  // that has a particle
  // Along open axes: sets the box and its grids to where particles are, and whether that is sparse.
  void reach_out(const AlignedArray& positions);
  // Narrows the wide gaps of a sparse box: sets the box, its grids and the home shifts.
  void close_wide_gaps(const AlignedArray& positions);
  // Whole boxes that bring a particle into the box, where no home shifts do.
  template <bool sparse>
  std::array<double, 3> home_of(const AlignedArray& positions, std::size_t slot) const;
  template <bool sparse>
  std::array<double, 3> shift_of(const Image& image, const std::array<double, 3>& home) const;
  template <bool sparse>
  void list_images(const AlignedArray& positions, std::size_t part);
  template <bool sparse>
  void list_images_of(const AlignedArray& positions, std::size_t slot, const Grid& grid, Part& part) const;
  // Where the points of each cell begin, and those that each part has in it.
  void place_cells();
  void count_points(std::size_t part);
  void place_points(std::size_t part, std::size_t next);
  template <bool sparse>
  void sort_points(const AlignedArray& positions);
  template <bool sparse>
  void put_points(const AlignedArray& positions, std::size_t part);
  template <bool with_integers>
  void refresh_range(const AlignedArray& positions, std::size_t range);
  void number_points();
  void put_rows(std::size_t part, std::size_t next);
  // Of the points [begin, end).
  void fix_points(std::size_t begin, std::size_t end);
  std::size_t first_range(std::size_t part) const { return ranges_.size() * part / parts_.size(); }

  Box whole_box_, box_;
  Point lowest_{};  // of the grids without their margins: 0 along periodic axes
  std::vector<kernels::SpeciesBlock> blocks_;
  std::size_t layout_slots_;
  int threads_;
  double fixed_unit_;
  std::vector<Grid> grids_;
  std::size_t cells_ = 0, particles_ = 0;  // of all species
  std::size_t size_ = 0, numbered_ = 0;
  KeptArray<double> points_;
  KeptArray<std::int32_t> fixed_points_;
  KeptArray<std::uint32_t> slots_;
  KeptArray<std::array<double, 3>> shifts_;
  KeptArray<std::uint32_t> first_;  // of each cell's points; one more at the end
  KeptArray<std::uint32_t> rows_, offsets_;
  bool sparse_ = false;
  // Of a sparse box, per slot: the shift that brings a particle into box_, and the boxes among it.
  std::vector<std::array<double, 3>> home_shifts_, home_boxes_;
  std::array<KeptArray<float>, 3> columns_;
  // Scratch of a sort, kept to reuse its memory.
  std::vector<Part> parts_;
  std::vector<Range> ranges_;
  KeptArray<Image> sorted_;
};

}  // namespace lanescape
