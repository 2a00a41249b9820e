#pragma once

#include "configuration/pair_model.hpp"
#include "core/box.hpp"

namespace lanescape {

// A box in which single particles are looked at one at a time, and the unit of length for it.
class ProbeBox {
 public:
  ProbeBox(const Box& box, double unit) : box_(box), unit_(unit) {}

  const Box& box() const { return box_; }  // [sigma]
  double unit() const { return unit_; }    // [sigma]
  Box reduced() const { return box_.in_unit(unit_); }
  // The place in the box, in this unit; along an open axis it may lie outside. Throws Error(bad_input) for a coordinate that is not
  // finite, and along an open axis for one beyond 10^7 units.
  Point home(const Point& position) const;
  // Throws Error(bad_input) for edges above 10^7 units, and for the minimum-image rule in a box whose shortest edge is below twice
  // the cutoff, where a particle would feel a jump. `work`: what is not allowed there.
  void check(const PairModel& model, double cutoff, const char* work) const;

 private:
  void check_not_too_far(std::size_t axis, double x) const;

  Box box_;
  double unit_;
};

}  // namespace lanescape
