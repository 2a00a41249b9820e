#include "flow/flow_profile.hpp"

#include <algorithm>
#include <limits>

namespace lanescape {

FlowSampler::FlowSampler(const SlabGeometry& geometry, double mass) : geometry_(geometry), mass_(mass) { clear(); }

void FlowSampler::clear() {
  samples_ = 0;
  time_ = 0.0;
  for (auto* sums : {&count_, &kinetic_, &energy_count_, &potential_, &across_, &passed_, &passed_particles_})
    sums->assign(geometry_.slices, 0.0);
  momentum_.assign(3 * geometry_.slices, 0.0);
}

void FlowSampler::add_motion(std::span<const double> positions, std::span<const double> velocities,
                             std::span<const double> forces_across) {
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    const std::size_t slice = geometry_.slice_of(positions[i]);
    const double x = velocities[i], y = velocities[i + 1], z = velocities[i + 2];
    count_[slice] += 1.0;
    momentum_[3 * slice] += mass_ * x;
    momentum_[3 * slice + 1] += mass_ * y;
    momentum_[3 * slice + 2] += mass_ * z;
    kinetic_[slice] += 0.5 * mass_ * (x * x + y * y + z * z);
  }
  for (std::size_t plane = 0; plane < across_.size(); ++plane) across_[plane] += forces_across[plane];
  ++samples_;
}

void FlowSampler::add_energies(std::span<const double> positions, std::span<const double> energies) {
  for (std::size_t i = 0; i < energies.size(); ++i) {
    const std::size_t slice = geometry_.slice_of(positions[3 * i]);
    energy_count_[slice] += 1.0;
    potential_[slice] += energies[i];
  }
}

void FlowSampler::add_passages(std::span<const double> particles, std::span<const double> momentum, double time) {
  for (std::size_t plane = 0; plane < passed_.size(); ++plane) passed_particles_[plane] += particles[plane];
  for (std::size_t plane = 0; plane < passed_.size(); ++plane) passed_[plane] += momentum[plane];
  time_ += time;
}

double FlowSampler::plane_pressure(std::size_t plane) const {
  return (passed_[plane] / time_ + across_[plane] / static_cast<double>(samples_)) / geometry_.area;
}

FlowProfile FlowSampler::profile() const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  FlowProfile means;
  const double volume = geometry_.area * geometry_.slice_width();
  for (std::size_t slice = 0; slice < geometry_.slices; ++slice) {
    const double n = count_[slice], density = n / (static_cast<double>(samples_) * volume);
    Point velocity{};
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      velocity[axis] = momentum_[3 * slice + axis] / (n * mass_);
      squared += velocity[axis] * velocity[axis];
    }
    means.x.push_back(geometry_.slice_middle(slice));
    means.density.push_back(density);
    means.velocity.push_back(velocity);
    means.temperature.push_back((2.0 * kinetic_[slice] / n - mass_ * squared) / 3.0);
    means.energy.push_back(kinetic_[slice] / n + potential_[slice] / energy_count_[slice]);
    const double before = slice > 0 ? passed_particles_[slice - 1] : passed_particles_[slice];
    means.mass_flux.push_back(0.5 * (before + passed_particles_[slice]) / (time_ * geometry_.area));
    // The faces have no pressure of their own: the buffers bear a force there.
    const bool whole = slice > 0 && slice + 1 < geometry_.slices && time_ > 0.0;
    means.pressure.push_back(
        whole ? 0.5 * (plane_pressure(slice - 1) + plane_pressure(slice)) - mass_ * density * velocity[0] * velocity[0] : none);
  }
  return means;
}

void FlowSampler::exchange(Archive& archive) {
  archive.enter("profile");
  archive.field("samples", samples_);
  archive.field("time", time_);
  archive.field("count", count_);
  archive.field("momentum", momentum_);
  archive.field("kinetic", kinetic_);
  archive.field("energy_count", energy_count_);
  archive.field("potential", potential_);
  archive.field("across", across_);
  archive.field("passed", passed_);
  archive.field("passed_particles", passed_particles_);
  archive.leave();
}

}  // namespace lanescape
