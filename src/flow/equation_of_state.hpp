#pragma once

#include <cmath>
#include <optional>

namespace lanescape {

// A homogeneous fluid at rest, of particles of mass 1. Units of epsilon, sigma and k_B = 1.
struct ThermodynamicState {
  double density = 0.0;                  // [1/sigma^3]
  double temperature = 0.0;              // [epsilon]
  double energy = 0.0;                   // internal energy per particle: 3/2 T and the excess energy [epsilon]
  double pressure = 0.0;                 // [epsilon/sigma^3]
  double heat_capacity = 0.0;            // c_v per particle
  double pressure_by_density = 0.0;      // (dp/d rho)_T
  double pressure_by_temperature = 0.0;  // (dp/dT)_rho

  double excess_energy() const { return energy - 1.5 * temperature; }
  // T (dp/dT)_rho / (rho^2 c_v), the slope dT/d rho of an isentrope
  double isentropic_slope() const { return temperature * pressure_by_temperature / (density * density * heat_capacity); }
  double sound_velocity() const { return std::sqrt(pressure_by_density + pressure_by_temperature * isentropic_slope()); }
  // False inside the spinodal, where a homogeneous fluid separates. True: the sound velocity is real.
  bool stable() const { return heat_capacity > 0.0 && pressure_by_density > 0.0; }
};

// Pressure and energy of a fluid. Solvers know nothing else of it.
class EquationOfState {
 public:
  virtual ~EquationOfState() = default;
  // Throws Error(bad_input) outside the range of the equation.
  virtual ThermodynamicState at_temperature(double density, double temperature) const = 0;
  // The state of this density and internal energy per particle; none where no temperature in the range gives it. The search starts
  // at the temperature `near`, on which the last bits depend.
  virtual std::optional<ThermodynamicState> at_energy(double density, double energy, double near) const = 0;
};

}  // namespace lanescape
