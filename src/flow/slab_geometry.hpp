#pragma once

#include <cstddef>

#include "core/box.hpp"

namespace lanescape {

// A slab with open faces at x = 0 and x = L, a buffer of one width at each, and slices of about one thickness between the faces.
struct SlabGeometry {
  double length = 0.0, area = 0.0;  // L, and of a face
  double buffer = 0.0;              // width
  std::size_t slices = 0;

  SlabGeometry(const Box& box, double buffer_width, double thickness);

  double slice_width() const { return length / static_cast<double>(slices); }
  double slice_middle(std::size_t slice) const { return (static_cast<double>(slice) + 0.5) * slice_width(); }
  // The slice that x lies in; what has left counts in that at its face.
  std::size_t slice_of(double x) const;
  // How far x lies in the buffer of face 0 (x = 0) or 1 (x = L), in widths of it: 1 at the face, more beyond; 0 or less outside.
  double depth(std::size_t face, double x) const;
  // The share of a face's force that a particle bears goes with this weight. It rises from zero at the buffer's inner edge so
  // steeply that few particles come to the face against it: with the square of the depth twice as many leave (README.md).
  double weight(std::size_t face, double x) const {
    const double depth = std::max(0.0, this->depth(face, x)), squared = depth * depth;
    return squared * squared;
  }
};

}  // namespace lanescape
