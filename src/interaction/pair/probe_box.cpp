#include "interaction/pair/probe_box.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"

namespace lanescape {
namespace {

constexpr double largest_edge = 1e7;  // [ProbeBox::unit()]

}  // namespace

Point ProbeBox::home(const Point& position) const {
  Point home{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double x = position[axis];
    if (!(x >= 0.0 && x < box_.length[axis])) {
      check_finite({&x, 1});
      x = box_.wrapped(axis, x);
      if (!box_.periodic[axis]) check_not_too_far(axis, x);
    }
    home[axis] = x / unit_;
  }
  return home;
}

void ProbeBox::check_not_too_far(std::size_t axis, double x) const {
  const double most = largest_edge * unit_;
  if (!(std::abs(x) <= most))
    throw_bad_input(fmt::format("{} coordinate {} of a particle is not allowed in a box that is open along {}: from {} to {} are",
                                "xyz"[axis], x, "xyz"[axis], -most, most));
}

void ProbeBox::check(const PairModel& model, double cutoff, const char* work) const {
  for (const double edge : box_.length)
    if (edge > largest_edge * unit_)
      throw_bad_input(
          fmt::format("{} is not allowed in a box of edge {}: at most {} are, or coordinates in the box lose too many digits", work,
                      edge, largest_edge * unit_));
  if (model.images == ImageRule::minimum && 2.0 * cutoff > box_.shortest())
    throw_bad_input(
        fmt::format("{} under the minimum-image rule is not allowed in a box of shortest edge {}: at least twice the "
                    "cutoff, {}, is needed",
                    work, box_.shortest(), 2.0 * cutoff));
}

}  // namespace lanescape
