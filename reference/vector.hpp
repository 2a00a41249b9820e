#pragma once

#include <array>

namespace lanescape::reference {

/// x, y and z of a point, a separation, a velocity or a box.
using Vector = std::array<double, 3>;

inline double dot(const Vector& a, const Vector& b) { return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]; }

}  // namespace lanescape::reference
