#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "configuration/configuration.hpp"
#include "core/box.hpp"

namespace lanescape {

// Finds near pairs of points that do not move (CellGrid is for those that do). Points are sorted by the cells of a periodic
// grid, so that points near in space are near in memory. An axis with room for fewer than three cells has one. Wide gaps of a
// sparse box are narrowed first (ClosedGaps). An open axis becomes a periodic one with an empty stretch that is wider than the
// reach. Construction is O(N).
class SortedCells {
 public:
  struct Point {
    std::array<double, 3> position;  // may be unwrapped, by up to 10^6 boxes [sigma]
    std::uint32_t number;            // chosen by the caller
  };

  // Prepares to find pairs nearer than `reach` [sigma].
  SortedCells(const Box& box, double reach, std::vector<Point> points);
  // The points are numbered as the particles of the configuration.
  SortedCells(const Configuration& configuration, double reach);

  // Calls visit(i, j, squared) with the numbers of any two points nearer to each other than the reach, each pair once, in no
  // particular order, and the square of their distance, that of their nearest images. The error of a distance is below margin(),
  // and pairs up to that much beyond the reach are visited too: however a caller rounds distances, no pair is missed.
  template <class Visit>
  void for_each_pair(Visit visit) const;
  double margin() const { return margin_; }  // [sigma]

  // The mean number of others with which a particle is compared, if `particles` are spread evenly.
  static double mean_candidates(const Box& box, double reach, std::size_t particles);

 private:
  struct Run {
    std::size_t begin, end;  // of points
  };
  struct Found {
    double squared;
    std::uint32_t number;
  };

  static std::array<std::size_t, 3> shape(const Box& box, double reach, std::size_t particles);
  std::size_t cell_of(const std::array<double, 3>& wrapped) const;
  void runs_after(std::size_t x, std::size_t y, std::size_t z, std::vector<Run>& runs) const;
  void add_column(std::size_t x, std::size_t y, std::size_t z, std::vector<Run>& runs) const;
  std::size_t next(std::size_t axis, std::size_t cell) const { return cell + 1 < cells_[axis] ? cell + 1 : 0; }
  std::size_t last(std::size_t axis, std::size_t cell) const { return (cell > 0 ? cell : cells_[axis]) - 1; }
  double distance_squared(const std::array<double, 3>& a, const std::array<double, 3>& b) const;

  // Makes open axes periodic: moves points so that none is below 0, and lengthens edges.
  void enclose(std::vector<Point>& points, double reach);
  // Narrows the wide gaps of a sparse box: moves its points and shortens its edges.
  void close_wide_gaps(std::vector<Point>& points, double reach);

  Box box_;
  double margin_, reach_;  // margin included
  std::array<std::size_t, 3> cells_;
  std::array<double, 3> cells_per_length_{};
  std::vector<Point> points_;         // wrapped, by cell, z fastest: neighbouring cells of a column follow each other
  std::vector<std::uint32_t> first_;  // of each cell's points, and the end
};

inline double SortedCells::distance_squared(const std::array<double, 3>& a, const std::array<double, 3>& b) const {
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = std::fabs(b[axis] - a[axis]), nearest = std::min(d, box_.length[axis] - d);
    squared += nearest * nearest;
  }
  return squared;
}

template <class Visit>
void SortedCells::for_each_pair(Visit visit) const {
  const double squared_reach = reach_ * reach_;
  std::vector<Run> runs;
  std::vector<Found> found;  // one extra element: an entry is written before the test
  for (std::size_t x = 0, cell = 0; x < cells_[0]; ++x)
    for (std::size_t y = 0; y < cells_[1]; ++y)
      for (std::size_t z = 0; z < cells_[2]; ++z, ++cell) {
        if (first_[cell] == first_[cell + 1]) continue;
        runs_after(x, y, z, runs);
        std::size_t most = 1;
        for (const Run& run : runs) most += run.end - run.begin;
        if (found.size() < most) found.resize(most);
        for (std::size_t self = first_[cell]; self < first_[cell + 1]; ++self) {
          const Point& point = points_[self];
          runs[0].begin = self + 1;
          // Without branches: they would be unpredictable.
          std::size_t count = 0;
          for (const Run& run : runs)
            for (std::size_t k = run.begin; k < run.end; ++k) {
              found[count] = {distance_squared(point.position, points_[k].position), points_[k].number};
              count += found[count].squared < squared_reach;
            }
          for (std::size_t k = 0; k < count; ++k) visit(point.number, found[k].number, found[k].squared);
        }
      }
}

}  // namespace lanescape
