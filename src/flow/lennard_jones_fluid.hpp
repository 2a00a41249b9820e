#pragma once

#include "flow/equation_of_state.hpp"

namespace lanescape {

// The Lennard-Jones fluid by the residual Helmholtz energy of Thol and others, J. Phys. Chem. Ref. Data 45, 023101 (2016), doi
// 10.1063/1.4945000 ([T]). It was fitted from T = 0.66 to 9 and up to freezing, and is taken a little further. Inside the binodal
// it means little.
class LennardJonesFluid final : public EquationOfState {
 public:
  static constexpr double lowest_temperature = 0.6, highest_temperature = 20.0, highest_density = 1.5;

  // Without a cutoff, as simulated with long-range corrections.
  LennardJonesFluid() = default;
  // Of the potential truncated at `cutoff` and shifted to zero there, in mean field: beyond the cutoff, and of the shift inside it,
  // particles are taken as uncorrelated. Throws Error(bad_input) unless the cutoff is from 2 to 1e6 [sigma].
  explicit LennardJonesFluid(double cutoff);

  ThermodynamicState at_temperature(double density, double temperature) const override;
  std::optional<ThermodynamicState> at_energy(double density, double energy, double near) const override;
  // Residual Helmholtz energy per particle: less that of the ideal gas at this temperature and density [epsilon].
  double residual_helmholtz_energy(double density, double temperature) const;

 private:
  ThermodynamicState unchecked(double density, double temperature) const;

  // What the truncation takes from the Helmholtz energy per particle and density [epsilon sigma^3].
  double lost_ = 0.0;
};

}  // namespace lanescape
