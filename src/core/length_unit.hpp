#pragma once

#include <cmath>

namespace lanescape {

// The unit of length for particles whose largest diameter is `size`: the largest power of two that is no larger. Interactions are
// evaluated in it, so that kernels and lists see numbers near 1 whatever the caller's unit is; a change of unit by a power of two
// rounds nothing. Lengths that users leave to the library, such as steps, are given in it.
inline double length_unit_of(double size) { return std::ldexp(1.0, std::ilogb(size)); }

}  // namespace lanescape
