#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/box.hpp"
#include "views/probe.hpp"

namespace lanescape {

// Points of one species of a box and those of their images that a probe in the box can feel, by the columns of a grid. Points can
// be inserted and removed, at the cost of moving those after them in their column. Points beyond the faces of an open axis are in
// the outermost cells, and there a search looks for a probe beyond them.
class ProbeCells {
 public:
  using Point = std::array<double, 3>;

  // `reach`: the largest cutoff of a probe [sigma]; `expected`: the approximate number of points in the box.
  ProbeCells(const Box& box, double reach, std::size_t expected);

  // Replaces all points by these, wrapped or not. O(N).
  // `diameters`: of each, or none [sigma].
  void assign(const std::vector<Point>& points, const std::vector<double>& diameters = {});
  void insert(const Point& point, double diameter = 0.0);
  // Removes a point; false if none has these coordinates to the bit, and this diameter if one is given.
  bool remove(const Point& point, std::optional<double> diameter = {});

  std::size_t size() const { return size_; }  // points in the box
  // The view for kernels; the caller sets the pair. Valid until the next change.
  kernels::ProbeSpecies view() const;
  void put_points(kernels::ProbeSpecies& view) const;  // leaves its pair

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
