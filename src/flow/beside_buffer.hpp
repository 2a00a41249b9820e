#pragma once

#include <span>

#include "flow/outside.hpp"
#include "flow/slab_geometry.hpp"

namespace lanescape {

// Means of the fluid in a layer of the thickness of a slice beside the buffer of one face, and how full that is.
class BesideBuffer {
 public:
  BesideBuffer(const SlabGeometry& geometry, std::size_t face, double mass);

  // One configuration, x0 y0 z0 x1 ..., and in some of them the energies of its particles, else none.
  void add(std::span<const double> positions, std::span<const double> velocities, std::span<const double> energies);
  // Puts the means into a report; NaN where there was no particle.
  void put_means(FaceReport& report) const;

 private:
  bool contains(double x) const { return x >= low_ && x < high_; }

  const SlabGeometry* geometry_;
  std::size_t face_;
  double low_, high_, volume_, mass_;
  double samples_ = 0.0, count_ = 0.0, kinetic_ = 0.0, potential_ = 0.0, potential_count_ = 0.0, in_buffer_ = 0.0;
  Point momentum_{};
};

}  // namespace lanescape
