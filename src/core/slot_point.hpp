#pragma once

#include <cstddef>

#include "core/aligned_array.hpp"
#include "core/point.hpp"

namespace lanescape {

// Vector i of an array that holds all x, all y, all z.
inline Point slot_point(const AlignedArray& array, std::size_t i) {
  const std::size_t slots = array.size() / 3;
  return {array[i], array[slots + i], array[2 * slots + i]};
}

}  // namespace lanescape
