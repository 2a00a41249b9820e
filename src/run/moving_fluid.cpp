#include "run/moving_fluid.hpp"

#include "configuration/lattice.hpp"
#include "insertion/insertion.hpp"

namespace lanescape {

MovingFluid::MovingFluid(const PairModel& model, const FluidState& state, double time_step, Isa isa, int threads)
    : start_(state.configuration),
      layout_(ParticleLayout::in_space_order(start_, model.species.size())),
      landscape_(model, start_.box, layout_, isa, {.threads = threads}),
      verlet_(landscape_, model, layout_, layout_.to_slots(start_.positions), time_step),
      gradient_(layout_.dimension(), 0.0) {
  verlet_.set_velocity(layout_.to_slots(state.velocities));
}

void MovingFluid::run(std::uint64_t steps) {
  for (std::uint64_t k = 0; k < steps; ++k) verlet_.step();
}

FluidState MovingFluid::state() const {
  FluidState state{start_, layout_.to_user(verlet_.velocity())};
  state.configuration.positions = layout_.to_user(verlet_.position());
  state.configuration.wrap();
  return state;
}

MovingFluid::Potential MovingFluid::potential() {
  const PairLandscape::EnergyAndVirial sums = landscape_.energy_and_virial(verlet_.position(), gradient_);
  return {sums.energy, (2.0 * kinetic_energy() + sums.virial) / (3.0 * start_.box.volume())};
}

FluidState fluid_on_lattice(const PairModel& model, std::size_t particles, double density, double temperature, std::uint64_t seed) {
  FluidState state{fcc_start(model, particles, density, seed), {}};
  const CounterRandom random(seed, RandomStream::velocities);
  for (std::size_t i = 0; i < state.configuration.size(); ++i) {
    const double mass = model.species[static_cast<std::size_t>(state.configuration.species[i])].mass;
    const auto velocity = maxwellian_velocity(random, i, temperature, mass);
    state.velocities.insert(state.velocities.end(), velocity.begin(), velocity.end());
  }
  return state;
}

void equilibrate(MovingFluid& fluid, double temperature, std::uint64_t steps) {
  constexpr std::uint64_t interval = 50;
  for (std::uint64_t done = 0; done < steps / 2; done += interval) {
    fluid.rescale_to(temperature);
    fluid.run(interval);
  }
  fluid.rescale_to(temperature);
  fluid.run(steps / 2);
}

}  // namespace lanescape
