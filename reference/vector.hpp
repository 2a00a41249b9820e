#pragma once

#include <array>

namespace lanescape::reference {

/// x, y and z of a point, a separation, a velocity or a box.
using Vector = std::array<double, 3>;

}  // namespace lanescape::reference
