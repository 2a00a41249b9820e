#include <lanescape/dynamics.hpp>

#include <fmt/format.h>

#include "api/host_arrays.hpp"
#include "api/host_landscape.hpp"
#include "api/host_spheres.hpp"
#include "core/byte_archive.hpp"
#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "core/option_checks.hpp"
#include "dynamics/event_driven.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "interaction/sphere/rounding_overlaps.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN

struct MolecularDynamics::Implementation {
  Implementation(Landscape& host, std::span<const double> masses, std::span<const double> positions, double time_step)
      : particles(masses, host.particles()),
        layout(particles.species, particles.mixture.species.size()),
        landscape(host, layout, choose_isa("auto")),
        verlet(landscape, particles.mixture, layout, layout.to_slots(positions), time_step) {}

  // The sizes of arrays, which are padded, do not tell the number of particles.
  void exchange(Archive& archive) {
    std::uint64_t count = layout.size();
    archive.field("particles", count);
    if (count != layout.size())
      throw_bad_input(fmt::format("state: it is of {} particles: one of {} is needed", count, layout.size()));
    verlet.exchange(archive);
  }

  // The dynamics refers to what stands before it.
  MassMixture particles;
  ParticleLayout layout;
  HostLandscape landscape;
  VelocityVerlet verlet;
};

MolecularDynamics::MolecularDynamics(Landscape& landscape, std::span<const double> masses, std::span<const double> positions,
                                     double time_step) {
  check_positions(positions.size(), landscape.particles());
  if (landscape.particles() == 0) throw_bad_input("dynamics of no particles is not possible: at least one is needed");
  check_finite_particles(positions);
  check_positive("time step", time_step);
  implementation_ = std::make_unique<Implementation>(landscape, masses, positions, time_step);
}

MolecularDynamics::~MolecularDynamics() = default;
MolecularDynamics::MolecularDynamics(MolecularDynamics&&) noexcept = default;
MolecularDynamics& MolecularDynamics::operator=(MolecularDynamics&&) noexcept = default;

void MolecularDynamics::draw_velocities(double temperature, std::uint64_t seed) {
  check_positive("temperature", temperature);
  implementation_->verlet.draw_velocities(temperature, seed);
}

void MolecularDynamics::set_velocities(std::span<const double> velocities) {
  if (velocities.size() != 3 * implementation_->layout.size())
    throw_bad_input(
        fmt::format("{} velocity components were given: {} are needed", velocities.size(), 3 * implementation_->layout.size()));
  check_finite(velocities);
  implementation_->verlet.set_velocity(implementation_->layout.to_slots(velocities));
}

void MolecularDynamics::run(std::uint64_t steps) {
  const FloatEnvironment environment;
  for (std::uint64_t k = 0; k < steps; ++k) implementation_->verlet.step();
}

std::uint64_t MolecularDynamics::steps() const { return implementation_->verlet.steps(); }
double MolecularDynamics::temperature() const { return implementation_->verlet.temperature(); }
double MolecularDynamics::kinetic_energy() const { return implementation_->verlet.kinetic_energy(); }
double MolecularDynamics::potential_energy() { return implementation_->verlet.potential_energy(); }
std::vector<double> MolecularDynamics::positions() const {
  return implementation_->layout.to_user(implementation_->verlet.position());
}
std::vector<double> MolecularDynamics::velocities() const {
  return implementation_->layout.to_user(implementation_->verlet.velocity());
}

std::string MolecularDynamics::state() const {
  ByteWriter archive;
  implementation_->exchange(archive);
  return archive.bytes();
}

void MolecularDynamics::restore(const std::string& state) {
  ByteReader archive(state);
  implementation_->exchange(archive);
}

struct EventDrivenDynamics::Implementation {
  EventDriven dynamics;
};

EventDrivenDynamics::EventDrivenDynamics(std::span<const double> radii, std::span<const double> masses,
                                         std::span<const double> positions, const std::array<double, 3>& box,
                                         const std::string& instruction_set) {
  Configuration spheres = host_spheres(radii, box);
  check_positions(positions.size(), radii.size());
  check_finite_particles(positions);
  spheres.positions.assign(positions.begin(), positions.end());
  const MassMixture particles(masses, radii.size());
  const kernels::KernelTable& table = kernel_table(choose_isa(instruction_set));
  constexpr double rounding = 1e-12;  // [s_ij]
  rounding_overlap_factor(spheres, rounding);
  implementation_ =
      std::make_unique<Implementation>(Implementation{EventDriven(spheres, particles.mixture.masses_of(particles.species), table)});
}

EventDrivenDynamics::~EventDrivenDynamics() = default;
EventDrivenDynamics::EventDrivenDynamics(EventDrivenDynamics&&) noexcept = default;
EventDrivenDynamics& EventDrivenDynamics::operator=(EventDrivenDynamics&&) noexcept = default;

void EventDrivenDynamics::draw_velocities(std::uint64_t seed) { implementation_->dynamics.draw_velocities(seed); }

void EventDrivenDynamics::set_velocities(std::span<const double> velocities) {
  if (velocities.size() != 3 * implementation_->dynamics.size())
    throw_bad_input(
        fmt::format("{} velocity components were given: {} are needed", velocities.size(), 3 * implementation_->dynamics.size()));
  check_finite(velocities);
  implementation_->dynamics.set_velocities({velocities.begin(), velocities.end()});
}

void EventDrivenDynamics::collide(std::uint64_t collisions) {
  const double kinetic = implementation_->dynamics.kinetic_energy();
  if (collisions != 0 && !(kinetic > 0.0)) throw_bad_input("all spheres are at rest and never collide: give them velocities first");
  if (!std::isfinite(kinetic)) throw_bad_input("velocities are too large: their kinetic energy must be finite");
  for (std::uint64_t k = 0; k < collisions; ++k) implementation_->dynamics.collide();
}

void EventDrivenDynamics::advance_to(double time) {
  if (!(time >= implementation_->dynamics.time()) || !std::isfinite(time))
    throw_bad_input(fmt::format("time {} is not allowed: it must be finite and not before {}", time, this->time()));
  implementation_->dynamics.advance_to(time);
}

std::uint64_t EventDrivenDynamics::collisions() const { return implementation_->dynamics.collisions(); }
double EventDrivenDynamics::time() const { return implementation_->dynamics.time(); }
double EventDrivenDynamics::kinetic_energy() const { return implementation_->dynamics.kinetic_energy(); }
double EventDrivenDynamics::compressibility() const { return implementation_->dynamics.compressibility(); }
std::vector<double> EventDrivenDynamics::positions() const { return implementation_->dynamics.positions(); }
std::vector<double> EventDrivenDynamics::velocities() const { return implementation_->dynamics.velocities(); }

std::string EventDrivenDynamics::state() {
  implementation_->dynamics.resynchronise();
  ByteWriter archive;
  implementation_->dynamics.exchange(archive);
  return archive.bytes();
}

void EventDrivenDynamics::restore(const std::string& state) {
  ByteReader archive(state);
  implementation_->dynamics.exchange(archive);
}

LANESCAPE_ABI_END
}  // namespace lanescape
