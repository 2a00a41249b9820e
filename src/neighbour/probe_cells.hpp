#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/box.hpp"
#include "views/probe.hpp"

namespace lanescape {

// Points of one species of a periodic box and those of their images that a probe in the box can feel, by the columns of a grid.
// Points can be put in and taken out, at the cost of moving what lies behind them in their column.
class ProbeCells {
 public:
  using Point = std::array<double, 3>;

  // `reach`: how far a probe feels [sigma]; `expected`: about how many points there will be in the box.
  ProbeCells(const Box& box, double reach, std::size_t expected);

  // Takes these points, wrapped or not, in place of all others. O(N).
  // `diameters`: of each, or none [sigma].
  void assign(const std::vector<Point>& points, const std::vector<double>& diameters = {});
  void insert(const Point& point, double diameter = 0.0);
  // Takes out a point that is in; false where there is none with these coordinates, to the bit.
  bool remove(const Point& point);

  std::size_t size() const { return size_; }  // points in the box
  // For the kernels; the pair is the caller's to set. Valid until the next change.
  kernels::ProbeSpecies view() const;

 private:
  struct Image {
    Point position;
    double diameter;
  };
  struct Place {
    std::size_t column, cell;
  };
  Place place_of(const Point& point) const;
  // Calls visit(image) for each image of a point that lies in the grid, itself first.
  template <class Visit>
  void for_each_image(const Point& point, Visit visit) const;
  void insert_image(const Image& image);
  // Moves all points into columns with room for a quarter more, and four.
  void lay_out(const std::vector<Image>& images);
  std::vector<Image> all_images() const;

  Box box_;
  double reach_;
  std::size_t size_ = 0;
  kernels::GridShape shape_{};
  AlignedVector<std::uint32_t> first_;   // cells[2] + 1 per column
  std::vector<std::uint32_t> limit_;     // of each column's points
  std::array<AlignedArray, 4> columns_;  // x, y, z, diameters
};

}  // namespace lanescape
