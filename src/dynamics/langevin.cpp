#include "dynamics/langevin.hpp"

#include <algorithm>
#include <cmath>

#include "core/option_checks.hpp"
#include "dynamics/maxwell.hpp"

namespace lanescape {

void LangevinOptions::check() const {
  check_positive("temperature", temperature, 1e6);
  check_positive("friction", friction, 1e6);
  check_positive("time step", time_step, 0.1);
}

Langevin::Langevin(SoftLandscape& landscape, const Mixture& model, const ParticleLayout& layout, AlignedArray position,
                   const LangevinOptions& options)
    : landscape_(&landscape),
      options_(options),
      noise_(options.seed, RandomStream::langevin),
      kick_(position.size(), 0.0),
      position_(std::move(position)),
      velocity_(position_.size(), 0.0),
      gradient_(position_.size(), 0.0) {
  options.check();
  const std::vector<double> masses = model.species_masses();
  const auto width = [&options](double mass) { return std::sqrt(options.temperature / mass); };
  draw_maxwell_velocities(particles_of(layout, masses, velocity_), width, options.seed);
  for (std::size_t s = 0; s < layout.blocks().size(); ++s)
    for (std::size_t k = layout.blocks()[s].begin; k < layout.blocks()[s].begin + layout.blocks()[s].count; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) kick_[axis * layout.slots() + k] = -0.5 * options.time_step / masses[s];
      slots_.push_back(k);
      masses_.push_back(masses[s]);
    }
  landscape_->gradient(position_, gradient_);
}

void Langevin::kick(std::size_t begin, std::size_t end) {
  const std::size_t slots = velocity_.size() / 3;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = axis * slots + begin; k < axis * slots + end; ++k) velocity_[k] += kick_[k] * gradient_[k];
}

void Langevin::drift(std::size_t begin, std::size_t end) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    landscape_->algebra().add_scaled(position_, 0.5 * options_.time_step, velocity_, axis * (position_.size() / 3) + begin,
                                     end - begin);
}

void Langevin::friction_and_noise(std::size_t begin, std::size_t end) {
  const double kept = std::exp(-options_.friction * options_.time_step);
  const std::size_t slots = velocity_.size() / 3;
  for (auto i = static_cast<std::size_t>(std::lower_bound(slots_.begin(), slots_.end(), begin) - slots_.begin());
       i < slots_.size() && slots_[i] < end; ++i) {
    const double given = std::sqrt((1.0 - kept * kept) * options_.temperature / masses_[i]);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      double& v = velocity_[axis * slots + slots_[i]];
      v = kept * v + given * noise_.normal(steps_, static_cast<std::uint32_t>(i), axis);
    }
  }
}

void Langevin::step() {
  const auto move = [this](std::size_t begin, std::size_t end) {
    kick(begin, end);
    drift(begin, end);
    friction_and_noise(begin, end);
    drift(begin, end);
  };
  landscape_->gradient_after(move, position_, gradient_);
  landscape_->algebra().for_all_slots(position_.size() / 3, [this](std::size_t begin, std::size_t end) { kick(begin, end); });
  ++steps_;
}

double Langevin::temperature() const {
  double twice_kinetic = 0.0;
  for (std::size_t i = 0; i < slots_.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double v = velocity_[axis * (velocity_.size() / 3) + slots_[i]];
      twice_kinetic += masses_[i] * v * v;
    }
  return twice_kinetic / (3.0 * static_cast<double>(slots_.size()));
}

void Langevin::exchange(Archive& archive) {
  archive.field("position", position_);
  archive.field("velocity", velocity_);
  archive.field("steps", steps_);
  landscape_->exchange(archive);
  if (archive.reading()) landscape_->gradient(position_, gradient_);
}

}  // namespace lanescape
