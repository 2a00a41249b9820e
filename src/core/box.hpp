#pragma once

#include <algorithm>
#include <array>

namespace lanescape {

// An orthorhombic box, periodic along all three axes.
struct Box {
  std::array<double, 3> length{};  // [sigma]

  double volume() const { return length[0] * length[1] * length[2]; }
  double shortest() const { return *std::min_element(length.begin(), length.end()); }
  friend bool operator==(const Box&, const Box&) = default;
};

}  // namespace lanescape
