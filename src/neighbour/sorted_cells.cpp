#include "neighbour/sorted_cells.hpp"

#include <utility>

#include "core/coordinate_checks.hpp"
#include "neighbour/closed_gaps.hpp"

namespace lanescape {
namespace {

// In units of the longest edge. 10^6 boxes away a coordinate has an error of 2 10^-10 edges, a separation a few times that.
constexpr double relative_margin = 1e-8;

double margin_in(const Box& box) { return relative_margin * *std::max_element(box.length.begin(), box.length.end()); }

std::vector<SortedCells::Point> points_of(const Configuration& configuration) {
  std::vector<SortedCells::Point> points(configuration.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {configuration.position(i), static_cast<std::uint32_t>(i)};
  return points;
}

}  // namespace

std::array<std::size_t, 3> SortedCells::shape(const Box& box, double reach, std::size_t particles) {
  // More cells than particles would cost memory and time.
  const double edge = std::max(reach, std::cbrt(box.volume() / static_cast<double>(std::max<std::size_t>(particles, 1))));
  std::array<std::size_t, 3> cells{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double most = std::min(box.length[axis] / edge, static_cast<double>(std::max<std::size_t>(particles, 1)));
    cells[axis] = most >= 3.0 ? static_cast<std::size_t>(most) : 1;
  }
  return cells;
}

double SortedCells::mean_candidates(const Box& box, double reach, std::size_t particles) {
  double candidates = static_cast<double>(particles);
  for (const std::size_t cells : shape(box, reach + margin_in(box), particles))
    candidates *= std::min(1.0, 3.0 / static_cast<double>(cells));
  return candidates;
}

SortedCells::SortedCells(const Configuration& configuration, double reach)
    : SortedCells(configuration.box, reach, points_of(configuration)) {}

// A counting sort.
SortedCells::SortedCells(const Box& box, double reach, std::vector<Point> points)
    : box_(box), margin_(margin_in(box)), reach_(reach + margin_), points_(points.size()) {
  if (box.has_open_axis()) enclose(points, reach);
  if (is_sparse(box_, points.size(), reach)) close_wide_gaps(points, reach);
  cells_ = shape(box_, reach_, points.size());
  for (std::size_t axis = 0; axis < 3; ++axis) cells_per_length_[axis] = static_cast<double>(cells_[axis]) / box_.length[axis];
  std::vector<std::uint32_t> cell(points.size());
  first_.assign(cells_[0] * cells_[1] * cells_[2] + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto& position = points[i].position;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(position[axis] >= 0.0 && position[axis] < box_.length[axis])) position[axis] = box_.wrapped(axis, position[axis]);
    cell[i] = static_cast<std::uint32_t>(cell_of(position));
    ++first_[cell[i]];
  }
  // Ends become beginnings, as points are stored from the last to the first.
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  for (std::size_t i = points.size(); i-- > 0;) points_[--first_[cell[i]]] = points[i];
}

void SortedCells::enclose(std::vector<Point>& points, double reach) {
  const std::array<bool, 3> periodic = std::exchange(box_.periodic, {true, true, true});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (periodic[axis]) continue;
    double low = 0.0, high = box_.length[axis];
    for (const Point& point : points) {
      check_finite({&point.position[axis], 1});
      low = std::min(low, point.position[axis]);
      high = std::max(high, point.position[axis]);
    }
    for (Point& point : points) point.position[axis] -= low;
    box_.length[axis] = high - low;
  }
  const double gap = 2.0 * (reach + margin_in(box_));
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!periodic[axis]) box_.length[axis] += gap;
  margin_ = margin_in(box_);
  reach_ = reach + margin_;
}

void SortedCells::close_wide_gaps(std::vector<Point>& points, double reach) {
  double largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> coordinates;
    coordinates.reserve(points.size());
    for (const Point& point : points) coordinates.push_back(point.position[axis]);
    check_finite(coordinates);
    const ClosedGaps closed = close_gaps(std::move(coordinates), box_.length[axis], 4.0 * reach);
    box_.length[axis] = closed.length;
    for (std::size_t i = 0; i < points.size(); ++i) {
      double& x = points[i].position[axis];
      largest = std::max({largest, std::abs(x), std::abs(closed.shifts[i])});
      x += closed.shifts[i];
    }
  }
  margin_ = std::max(margin_in(box_), 1e-15 * largest);
  reach_ = reach + margin_;
}

std::size_t SortedCells::cell_of(const std::array<double, 3>& wrapped) const {
  std::size_t cell = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t along = static_cast<std::size_t>(wrapped[axis] * cells_per_length_[axis]);
    cell = cell * cells_[axis] + std::min(along, cells_[axis] - 1);  // rounding can reach the far face
  }
  return cell;
}

// A cell is compared with itself and with the later half of the cells around it.
void SortedCells::runs_after(std::size_t x, std::size_t y, std::size_t z, std::vector<Run>& runs) const {
  const std::size_t column = (x * cells_[1] + y) * cells_[2], above = column + next(2, z);
  runs.assign(1, {first_[column + z], first_[column + z + 1]});
  if (cells_[2] > 1) runs.push_back({first_[above], first_[above + 1]});
  if (cells_[1] > 1) add_column(x, next(1, y), z, runs);
  if (cells_[0] == 1) return;
  add_column(next(0, x), y, z, runs);
  if (cells_[1] == 1) return;
  add_column(next(0, x), last(1, y), z, runs);
  add_column(next(0, x), next(1, y), z, runs);
}

// The three cells around z of a column follow each other, but at the faces.
void SortedCells::add_column(std::size_t x, std::size_t y, std::size_t z, std::vector<Run>& runs) const {
  const std::size_t n = cells_[2], column = (x * cells_[1] + y) * n;
  const std::size_t begin = z > 0 ? z - 1 : 0, end = std::min(z + 2, n);
  runs.push_back({first_[column + begin], first_[column + end]});
  if (n > 1 && z == 0) runs.push_back({first_[column + n - 1], first_[column + n]});
  if (n > 1 && z == n - 1) runs.push_back({first_[column], first_[column + 1]});
}

}  // namespace lanescape
