#include "flow/slab_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {

SlabGeometry::SlabGeometry(const Box& box, double buffer_width, double thickness)
    : length(box.length[0]),
      area(box.length[1] * box.length[2]),
      buffer(buffer_width),
      slices(std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(box.length[0] / thickness)))) {}

std::size_t SlabGeometry::slice_of(double x) const {
  const double slice = std::floor(x / slice_width());
  return slice < 0.0 ? 0 : std::min(slices - 1, static_cast<std::size_t>(slice));
}

double SlabGeometry::depth(std::size_t face, double x) const { return 1.0 - (face == 0 ? x : length - x) / buffer; }

}  // namespace lanescape
