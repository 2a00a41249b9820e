#include "neighbour/probe_cells.hpp"

#include <algorithm>
#include <cmath>

#include "neighbour/least_cell.hpp"

namespace lanescape {
namespace {

// The number of points that fills a vector in the middle column of a probe's reach.
constexpr double points_per_probe_run = 8.0;
// Cells are low, so that a run ends near the reach.
constexpr double cells_per_reach = 6.0;

std::size_t cell_along(const kernels::GridShape& shape, std::size_t axis, double x) {
  const double cell = (x - shape.low[axis]) * shape.cells_per_length[axis];
  if (!(cell > 0.0)) return 0;
  return cell < static_cast<double>(shape.cells[axis]) ? static_cast<std::size_t>(cell) : shape.cells[axis] - 1;
}

}  // namespace

ProbeCells::ProbeCells(const Box& box, double reach, std::size_t expected) : box_(box), reach_(reach) {
  const double density = static_cast<double>(std::max<std::size_t>(expected, 1)) / box.volume();
  const double least = least_cell_edge(box, reach, std::max<std::size_t>(expected, 1));
  const double width = std::max(least, std::clamp(std::sqrt(points_per_probe_run / (2.0 * reach * density)), reach / 4.0, reach));
  const std::array<double, 3> edges = {
      width, width, std::max({reach / cells_per_reach, 0.25 / (width * width * density), least * least * least / (width * width)})};
  std::size_t columns = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double margin = box.periodic[axis] ? reach : 0.0, length = box.length[axis] + 2.0 * margin;
    shape_.cells[axis] = std::max<std::size_t>(1, static_cast<std::size_t>(length / edges[axis]));
    shape_.low[axis] = -margin;
    shape_.edge[axis] = length / static_cast<double>(shape_.cells[axis]);
    shape_.cells_per_length[axis] = 1.0 / shape_.edge[axis];
    if (axis < 2) columns *= shape_.cells[axis];
  }
  limit_.resize(columns);
  assign({});
}

ProbeCells::Place ProbeCells::place_of(const Point& point) const {
  return {cell_along(shape_, 0, point[0]) * shape_.cells[1] + cell_along(shape_, 1, point[1]), cell_along(shape_, 2, point[2])};
}

template <class Visit>
void ProbeCells::for_each_image(const Point& point, Visit visit) const {
  std::array<int, 3> least{}, most{};
  Point home{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = box_.length[axis];
    home[axis] = box_.wrapped(axis, point[axis]);
    if (!box_.periodic[axis]) continue;
    least[axis] = -static_cast<int>(std::floor((home[axis] + reach_) / length));
    most[axis] = static_cast<int>(std::floor((length + reach_ - home[axis]) / length));
  }
  for (int a = least[0]; a <= most[0]; ++a)
    for (int b = least[1]; b <= most[1]; ++b)
      for (int c = least[2]; c <= most[2]; ++c)
        visit(Point{home[0] + a * box_.length[0], home[1] + b * box_.length[1], home[2] + c * box_.length[2]});
}

void ProbeCells::assign(const std::vector<Point>& points, const std::vector<double>& diameters) {
  std::vector<Image> images;
  for (std::size_t i = 0; i < points.size(); ++i)
    for_each_image(points[i], [&](const Point& image) { images.push_back({image, diameters.empty() ? 0.0 : diameters[i]}); });
  size_ = points.size();
  lay_out(images);
}

// A counting sort.
void ProbeCells::lay_out(const std::vector<Image>& images) {
  const std::size_t columns = limit_.size(), stride = shape_.cells[2] + 1;
  first_.assign(columns * stride, 0);
  for (const Image& image : images) {
    const Place place = place_of(image.position);
    ++first_[place.column * stride + place.cell];
  }
  const std::size_t room = 4 + images.size() / columns / 4;
  // Counts become ends; points are then stored from the last to the first.
  std::uint32_t next = 0;
  for (std::size_t column = 0; column < columns; ++column) {
    for (std::size_t cell = 0; cell < stride; ++cell) next = first_[column * stride + cell] += next;
    next += static_cast<std::uint32_t>(room);
    limit_[column] = next;
  }
  for (auto& column : columns_) column.assign(next + kernels::slot_padding, 0.0);
  for (std::size_t k = images.size(); k-- > 0;) {
    const Place place = place_of(images[k].position);
    const std::uint32_t at = --first_[place.column * stride + place.cell];
    for (std::size_t axis = 0; axis < 3; ++axis) columns_[axis][at] = images[k].position[axis];
    columns_[3][at] = images[k].diameter;
  }
}

std::vector<ProbeCells::Image> ProbeCells::all_images() const {
  std::vector<Image> images;
  const std::size_t stride = shape_.cells[2] + 1;
  for (std::size_t column = 0; column < limit_.size(); ++column)
    for (std::uint32_t k = first_[column * stride]; k < first_[column * stride + stride - 1]; ++k)
      images.push_back({{columns_[0][k], columns_[1][k], columns_[2][k]}, columns_[3][k]});
  return images;
}

void ProbeCells::insert(const Point& point, double diameter) {
  for_each_image(point, [&](const Point& image) { insert_image({image, diameter}); });
  ++size_;
}

void ProbeCells::insert_image(const Image& image) {
  const Place place = place_of(image.position);
  std::uint32_t* first = first_.data() + place.column * (shape_.cells[2] + 1);
  if (first[shape_.cells[2]] == limit_[place.column]) {
    std::vector<Image> images = all_images();
    images.push_back(image);
    lay_out(images);
    return;
  }
  const std::uint32_t at = first[place.cell + 1], end = first[shape_.cells[2]];
  for (std::size_t column = 0; column < 4; ++column) {
    double* x = columns_[column].data();
    std::move_backward(x + at, x + end, x + end + 1);
    x[at] = column < 3 ? image.position[column] : image.diameter;
  }
  for (std::size_t cell = place.cell + 1; cell <= shape_.cells[2]; ++cell) ++first[cell];
}

bool ProbeCells::remove(const Point& point, std::optional<double> diameter) {
  std::size_t removed = 0;
  for_each_image(point, [&](const Point& image) {
    const Place place = place_of(image);
    std::uint32_t* first = first_.data() + place.column * (shape_.cells[2] + 1);
    std::uint32_t at = first[place.cell];
    const std::uint32_t cell_end = first[place.cell + 1], end = first[shape_.cells[2]];
    while (at < cell_end &&
           (Point{columns_[0][at], columns_[1][at], columns_[2][at]} != image || (diameter && columns_[3][at] != *diameter)))
      ++at;
    if (at == cell_end) return;
    for (auto& column : columns_) std::move(column.begin() + at + 1, column.begin() + end, column.begin() + at);
    for (std::size_t cell = place.cell + 1; cell <= shape_.cells[2]; ++cell) --first[cell];
    ++removed;
  });
  if (removed > 0) --size_;
  return removed > 0;
}

kernels::ProbeSpecies ProbeCells::view() const {
  kernels::ProbeSpecies view{};
  put_points(view);
  return view;
}

void ProbeCells::put_points(kernels::ProbeSpecies& view) const {
  static_cast<kernels::GridShape&>(view) = shape_;
  view.first = first_.data();
  view.x = columns_[0].data();
  view.y = columns_[1].data();
  view.z = columns_[2].data();
  view.diameters = columns_[3].data();
}

}  // namespace lanescape
