#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/box.hpp"
#include "views/cluster.hpp"

namespace lanescape {

// The particles of a box in clusters of eight (kernels/views/cluster.hpp): each species in columns along z, sorted by z within a
// column and cut into clusters about as long as they are wide. Clusters are numbered species by species, column by column, from
// low to high z. The order depends on positions alone.
class ClusterColumns {
 public:
  // `reaches`: how far pairs of species are listed, species x species [sigma].
  ClusterColumns(const Box& box, const ParticleLayout& layout, const std::vector<double>& reaches, int threads);

  // In a box of this shape. A box that carries the particles along keeps columns, clusters and homes.
  void set_box(const Box& box) { box_ = box; }
  const Box& box() const { return box_; }
  // Sorts particles (layout's order, wrapped or not) into clusters. Throws Error(bad_input) for a coordinate that is not finite.
  void sort(const AlignedArray& positions);
  // Takes the whole boxes by which particles were shifted since then; empty: none.
  void shift_back(const AlignedArray& boxes);
  // Puts the clusters of a part, one per thread, at new positions.
  void refresh(const AlignedArray& positions, int part);

  double fixed_unit() const { return fixed_unit_; }
  std::size_t clusters() const { return filled_.size(); }
  // The record of a cluster, in units of fixed_unit().
  const std::int32_t* points(std::size_t cluster) const { return points_.data() + kernels::cluster_width * cluster; }
  std::size_t filled(std::size_t cluster) const { return filled_[cluster]; }
  std::uint32_t slot(std::size_t cluster, std::size_t place) const { return slots_[kernels::cluster_size * cluster + place]; }

  // Where the particles of a cluster lay in the box when it was made.
  struct Bounds {
    std::array<double, 3> low, high;
  };
  const Bounds& bounds(std::size_t cluster) const { return bounds_[cluster]; }

  // The columns of a species, y index fastest.
  struct Grid {
    std::array<std::size_t, 2> count{1, 1};
    std::size_t first_column = 0;  // among all
  };
  std::size_t species() const { return grids_.size(); }
  const Grid& grid(std::size_t species) const { return grids_[species]; }
  std::array<double, 2> edge(std::size_t species) const;  // of a column
  std::size_t columns() const { return first_.size() - 1; }
  std::size_t first_cluster(std::size_t column) const { return first_[column]; }

  std::size_t memory() const;  // [bytes]

 private:
  struct Placed {
    std::uint32_t slot;
    std::array<double, 3> home, position;  // boxes to add; in the box
  };
  void shape(Grid& grid, std::size_t particles) const;
  std::size_t column_of(const Grid& grid, const std::array<double, 3>& position) const;
  Placed placed(const AlignedArray& positions, std::size_t slot) const;
  void sort_into_columns(const AlignedArray& positions);
  // Cuts the sorted particles of a column and calls take(first, count) for each cluster.
  template <class Take>
  void cut(std::size_t column, Take take) const;
  void put_cluster(std::size_t cluster, Placed* particles, std::size_t count);
  void find_shifts(std::size_t cluster, const AlignedArray& boxes);

  Box box_;
  std::vector<kernels::SpeciesBlock> blocks_;
  std::size_t layout_slots_;
  int threads_;
  double longest_;  // a cluster may be [sigma]
  double fixed_unit_;
  std::vector<Grid> grids_;
  std::vector<std::uint32_t> first_;         // cluster of each column; one more at the end
  std::vector<std::uint32_t> first_placed_;  // particle of each column
  std::vector<Placed> placed_;               // by columns
  std::vector<std::uint32_t> column_of_slot_;
  std::vector<Bounds> bounds_;
  std::vector<std::uint8_t> filled_;
  AlignedVector<std::uint32_t> slots_;  // cluster_size each; where there is no particle, the first one's
  AlignedArray homes_, shifts_;         // boxes, and what to add to coordinates [sigma]: records as those of points
  AlignedVector<std::int32_t> points_;
};

}  // namespace lanescape
