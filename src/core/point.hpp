#pragma once

#include <array>
#include <cstddef>

namespace lanescape {

// A position, a separation or any other vector x, y, z.
using Point = std::array<double, 3>;

// Point k of 3N numbers x0 y0 z0 x1 ...
inline Point point_at(const double* points, std::size_t k) { return {points[3 * k], points[3 * k + 1], points[3 * k + 2]}; }
inline Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace lanescape
