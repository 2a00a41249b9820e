#pragma once

#include <cstddef>

#include "views/layout.hpp"

namespace lanescape {

// The least multiple of `unit` that is at least n: how long an array of n elements is made for kernels.
constexpr std::size_t padded(std::size_t n, std::size_t unit = kernels::slot_padding) { return (n + unit - 1) / unit * unit; }

}  // namespace lanescape
