#include "flow/lennard_jones_fluid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/error.hpp"

namespace lanescape {
namespace {

// n tau^t delta^d exp[-sign(l) delta^l - eta (delta - epsilon)^2 - beta (tau - gamma)^2], tau = T_c/T, delta = rho/rho_c
struct TholTerm {
  double n, t, d, l, eta, beta, gamma, epsilon;
};

// [T] table 2. The numbers are those of tools/data/eos_thol2016.csv, whose head says where they were read.
constexpr TholTerm thol_terms[] = {
    {0.005208073, 1.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0},         {2.186252, 0.32, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0},
    {-2.161016, 0.505, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0},         {1.4527, 0.672, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0},
    {-2.041792, 0.843, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0},         {0.18695286, 0.898, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0},
    {-0.6208625, 1.205, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0},        {-0.568839, 1.786, 1.0, 2.0, 0.0, 0.0, 0.0, 0.0},
    {-0.80055922, 2.77, 3.0, 2.0, 0.0, 0.0, 0.0, 0.0},        {0.10901431, 1.786, 2.0, 1.0, 0.0, 0.0, 0.0, 0.0},
    {-0.4974561, 2.59, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0},         {-0.090988445, 1.294, 5.0, 1.0, 0.0, 0.0, 0.0, 0.0},
    {-1.4667177, 2.83, 1.0, 0.0, 2.067, 0.625, 0.71, 0.2053}, {1.891469, 2.548, 1.0, 0.0, 1.522, 0.638, 0.86, 0.409},
    {-0.1383701, 4.65, 2.0, 0.0, 8.82, 3.91, 1.94, 0.6},      {-0.3869645, 1.385, 3.0, 0.0, 1.722, 0.156, 1.48, 1.203},
    {0.1265702, 1.46, 3.0, 0.0, 0.679, 0.157, 1.49, 1.829},   {0.605781, 1.351, 2.0, 0.0, 1.883, 0.153, 1.945, 1.397},
    {1.179189, 0.66, 1.0, 0.0, 3.925, 1.16, 3.02, 1.39},      {-0.47732679, 1.496, 2.0, 0.0, 2.461, 1.73, 1.11, 0.539},
    {-9.9218575, 1.83, 3.0, 0.0, 28.2, 383, 1.17, 0.934},     {-0.5747932, 1.616, 1.0, 0.0, 0.753, 0.112, 1.33, 2.369},
    {0.003772923, 4.97, 1.0, 0.0, 0.82, 0.119, 0.24, 2.43},
};
constexpr double thol_temperature = 1.32, thol_density = 0.31;  // T_c, rho_c

// The sum of the terms, a_r/T, and its derivatives: x stands for delta d/d delta, y for tau d/d tau.
struct TholSums {
  double f = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
};

TholSums thol_sums(double density, double temperature) {
  const double tau = thol_temperature / temperature, delta = density / thol_density;
  const double log_tau = std::log(tau), log_delta = std::log(delta);
  TholSums sums;
  for (const TholTerm& k : thol_terms) {
    const double power = k.l == 0.0 ? 0.0 : (k.l == 1.0 ? delta : delta * delta);
    const double from_delta = delta - k.epsilon, from_tau = tau - k.gamma;
    const double f =
        k.n * std::exp(k.t * log_tau + k.d * log_delta - power - k.eta * from_delta * from_delta - k.beta * from_tau * from_tau);
    const double x = k.d - k.l * power - 2.0 * k.eta * delta * from_delta;
    const double y = k.t - 2.0 * k.beta * tau * from_tau;
    sums.f += f;
    sums.x += f * x;
    sums.y += f * y;
    sums.xx += f * (x * x - k.l * k.l * power - 2.0 * k.eta * delta * (delta + from_delta));
    sums.xy += f * x * y;
    sums.yy += f * (y * y - 2.0 * k.beta * tau * (tau + from_tau));
  }
  return sums;
}

bool thol_density_in_range(double density) { return density > 0.0 && density <= LennardJonesFluid::highest_density; }

void check_thol_range(double density, double temperature) {
  if (!thol_density_in_range(density))
    throw_bad_input(fmt::format("density {} is outside the equation of state: above 0 and at most {}", density,
                                LennardJonesFluid::highest_density));
  if (!(temperature >= LennardJonesFluid::lowest_temperature && temperature <= LennardJonesFluid::highest_temperature))
    throw_bad_input(fmt::format("temperature {} is outside the equation of state: from {} to {}", temperature,
                                LennardJonesFluid::lowest_temperature, LennardJonesFluid::highest_temperature));
}

}  // namespace

LennardJonesFluid::LennardJonesFluid(double cutoff) {
  if (!(cutoff >= 2.0 && cutoff <= 1e6))
    throw_bad_input(fmt::format("cutoff {} of the equation of state is not allowed: from 2 to 1e6 sigma", cutoff));
  // 2 pi int_c^inf u r^2 dr + (2 pi/3) c^3 u(c)
  const double c3 = cutoff * cutoff * cutoff, tail = 4.0 * (1.0 / (9.0 * c3 * c3 * c3) - 1.0 / (3.0 * c3));
  const double shift = 4.0 / 3.0 * (1.0 / (c3 * c3 * c3) - 1.0 / c3);
  lost_ = 2.0 * std::numbers::pi * (tail + shift);
}

ThermodynamicState LennardJonesFluid::unchecked(double density, double temperature) const {
  const TholSums sums = thol_sums(density, temperature);
  ThermodynamicState state;
  state.density = density;
  state.temperature = temperature;
  state.energy = temperature * (1.5 + sums.y) - density * lost_;
  state.pressure = density * temperature * (1.0 + sums.x) - density * density * lost_;
  state.heat_capacity = 1.5 + sums.y - sums.yy;
  state.pressure_by_density = temperature * (1.0 + sums.x + sums.xx) - 2.0 * density * lost_;
  state.pressure_by_temperature = density * (1.0 + sums.x - sums.xy);
  return state;
}

ThermodynamicState LennardJonesFluid::at_temperature(double density, double temperature) const {
  check_thol_range(density, temperature);
  return unchecked(density, temperature);
}

// Newton's method between bounds that close in. Where a step leaves them, or c_v is not positive, it is a bisection.
std::optional<ThermodynamicState> LennardJonesFluid::at_energy(double density, double energy, double near) const {
  if (!thol_density_in_range(density) || !std::isfinite(energy)) return std::nullopt;
  double low = lowest_temperature, high = highest_temperature, t = near >= low && near <= high ? near : 1.0;
  for (int k = 0; k < 200; ++k) {
    ThermodynamicState state = unchecked(density, t);
    const double missing = energy - state.energy, step = missing / state.heat_capacity;
    if (state.heat_capacity > 0.0 && std::abs(step) <= 1e-8 * t && t + step >= lowest_temperature &&
        t + step <= highest_temperature) {
      state.temperature += step;  // what this leaves is of the order of the square of the step
      state.pressure += step * state.pressure_by_temperature;
      state.energy = energy;
      return state;
    }
    (missing > 0.0 ? low : high) = t;
    if (high - low <= 1e-14 * high) break;
    const double next = t + step;
    t = state.heat_capacity > 0.0 && next > low && next < high ? next : 0.5 * (low + high);
  }
  return std::nullopt;
}

double LennardJonesFluid::residual_helmholtz_energy(double density, double temperature) const {
  check_thol_range(density, temperature);
  return temperature * thol_sums(density, temperature).f - density * lost_;
}

}  // namespace lanescape
