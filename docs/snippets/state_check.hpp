#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "interaction/state/state_mixture.hpp"
#include "verification/state_mixture_cases.hpp"

// Shared by both examples of state-probability interactions: compares forces and virial with differences of the energy.
namespace lanescape::snippets {

struct Checked {
  double worst_force = 0.0;  // relative to the largest force
  double virial = 0.0;       // relative
};

inline Checked check_forces(const std::function<StateMixtureParts()>& parts, const Configuration& fluid, std::size_t species) {
  const kernels::KernelTable& table = kernel_table(available_isas().back());
  const ParticleLayout layout(fluid.species, species);
  AlignedArray gradient(layout.dimension());
  const auto evaluate = [&](const Configuration& c) {
    StateMixture interaction(parts(), c.box, layout, table, {});
    return interaction.energy_and_gradient(layout.to_slots(c.positions), gradient);
  };
  const double virial = evaluate(fluid).virial;
  const std::vector<double> g = layout.to_user(gradient);
  const auto five_point = [](const std::function<double(double)>& f, double h) {
    return (f(-2.0 * h) - 8.0 * f(-h) + 8.0 * f(h) - f(2.0 * h)) / (12.0 * h);
  };
  double largest = 0.0;
  for (const double x : g) largest = std::max(largest, std::abs(x));
  Checked checked;
  for (std::size_t k = 0; k < g.size(); k += 7) {
    const auto energy = [&](double x) {
      Configuration moved = fluid;
      moved.positions[k] += x;
      return evaluate(moved).energy;
    };
    checked.worst_force = std::max(checked.worst_force, std::abs(five_point(energy, 4e-4) - g[k]) / largest);
  }
  const auto energy = [&](double x) {
    Configuration scaled = fluid;
    for (double& r : scaled.positions) r *= 1.0 + x;
    for (double& edge : scaled.box.length) edge *= 1.0 + x;
    return evaluate(scaled).energy;
  };
  checked.virial = std::abs(five_point(energy, 1e-4) + virial) / (std::abs(virial) + largest);
  fmt::print("forces are off by {:.1e} of the largest, the virial by {:.1e}\n", checked.worst_force, checked.virial);
  return checked;
}

}  // namespace lanescape::snippets
