#include "flow/riemann_flux.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {
namespace {

Conserved side_densities(const FaceSide& side) {
  const double rho = side.density;
  const Point& v = side.velocity;
  return {rho, rho * v[0], rho * v[1], rho * v[2], side.energy_density + 0.5 * rho * dot(v, v)};
}

Conserved side_flux(const FaceSide& side) {
  Conserved flux = side_densities(side);
  flux[4] += side.pressure;
  for (double& component : flux) component *= side.velocity[0];
  flux[1] += side.pressure;
  return flux;
}

// Between the acoustic wave of this side, of velocity `wave`, and the contact.
Conserved star_flux(const FaceSide& side, double wave, double contact) {
  const double u = side.velocity[0], rho = side.density * (wave - u) / (wave - contact);
  const Conserved outer = side_densities(side);
  const double energy = outer[4] / side.density + (contact - u) * (contact + side.pressure / (side.density * (wave - u)));
  const Conserved inner{rho, rho * contact, rho * side.velocity[1], rho * side.velocity[2], rho * energy};
  Conserved flux = side_flux(side);
  for (std::size_t k = 0; k < flux.size(); ++k) flux[k] += wave * (inner[k] - outer[k]);
  return flux;
}

}  // namespace

FaceSide face_side(const FlowState& state) {
  const ThermodynamicState& fluid = state.fluid;
  return {fluid.density, state.velocity, fluid.pressure, fluid.density * fluid.energy, fluid.sound_velocity()};
}

Conserved riemann_flux(const FaceSide& left, const FaceSide& right) {
  const double ul = left.velocity[0], ur = right.velocity[0];
  // Einfeldt's bounds from means with Roe's weights. The fluxes of small waves, and so what a boundary throws back, depend on them:
  // the extreme velocities of the two sides alone are too fast by the order of the jump.
  const double wl = std::sqrt(left.density), wr = std::sqrt(right.density), cl = left.sound_velocity, cr = right.sound_velocity;
  const double u = (wl * ul + wr * ur) / (wl + wr), jump = (ur - ul) / (wl + wr);
  const double c = std::sqrt((wl * cl * cl + wr * cr * cr) / (wl + wr) + 0.5 * wl * wr * jump * jump);
  const double slowest = std::min(ul - cl, u - c), fastest = std::max(ur + cr, u + c);
  if (slowest >= 0.0) return side_flux(left);
  if (fastest <= 0.0) return side_flux(right);
  const double from_left = left.density * (slowest - ul), from_right = right.density * (fastest - ur);
  const double contact = (right.pressure - left.pressure + from_left * ul - from_right * ur) / (from_left - from_right);
  return contact >= 0.0 ? star_flux(left, slowest, contact) : star_flux(right, fastest, contact);
}

}  // namespace lanescape
