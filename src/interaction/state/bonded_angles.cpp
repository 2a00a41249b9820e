#include "interaction/state/bonded_angles.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {

namespace {

struct SlotsOfAngle {
  std::size_t first, middle, last;
};

// Adds gradient and virial of one angle from `by_cosine`, dU/d(cos theta), and its separations u and v from the middle.
void add_forces(const SlotsOfAngle& slots_of, const Point& u, const Point& v, double cosine, double by_cosine, std::size_t slots,
                StateSums& sums) {
  const double uu = dot(u, u), vv = dot(v, v), product = std::sqrt(uu * vv);
  constexpr std::size_t voigt[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double g_i = by_cosine * (v[axis] / product - cosine * u[axis] / uu);
    const double g_k = by_cosine * (u[axis] / product - cosine * v[axis] / vv);
    sums.gradient[axis * slots + slots_of.first] += g_i;
    sums.gradient[axis * slots + slots_of.last] += g_k;
    sums.gradient[axis * slots + slots_of.middle] -= g_i + g_k;
    for (std::size_t other = 0; other < 3; ++other) {
      // r_a f_b and r_b f_a of an angle are equal: each off-diagonal entry is their mean.
      const double virial = -(u[other] * g_i + v[other] * g_k);
      sums.virial_tensor[voigt[axis][other]] += axis == other ? virial : 0.5 * virial;
      if (axis == other) sums.virial += virial;
    }
  }
}

}  // namespace

void BondedAngles::add(Sites& sites, StateSums& sums) {
  const std::size_t states = sites.states(), slots = sites.layout().slots();
  const auto position = [&](std::size_t slot) {
    const AlignedArray& r = sites.positions();
    return Point{r[slot], r[slots + slot], r[2 * slots + slot]};
  };
  const auto separation = [&](std::size_t i, std::size_t j) {
    return sites.box().nearest_image(difference(position(i), position(j)));
  };
  for (const Angle& angle : angles_) {
    const std::size_t i = sites.layout().slot_of(angle.first), j = sites.layout().slot_of(angle.middle),
                      k = sites.layout().slot_of(angle.last);
    const Point u = separation(i, j), v = separation(k, j);
    const double cosine = std::clamp(dot(u, v) / std::sqrt(dot(u, u) * dot(v, v)), -1.0, 1.0), theta = std::acos(cosine);
    double slope = 0.0;  // dU/dtheta
    for (std::size_t a = 0; a < states; ++a) {
      const double p = sites.site_states().of(j)[a], away = theta - springs_[a].rest;
      const double energy = 0.5 * springs_[a].stiffness * away * away;
      sums.energy += p * energy;
      sums.slopes[j * states + a] += energy;
      slope += p * springs_[a].stiffness * away;
    }
    // A stretched angle has no direction to bend in.
    const double sine = std::max(std::sqrt(1.0 - cosine * cosine), 1e-8);
    add_forces({i, j, k}, u, v, cosine, -slope / sine, slots, sums);
  }
}

}  // namespace lanescape
