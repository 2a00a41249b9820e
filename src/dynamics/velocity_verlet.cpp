#include "dynamics/velocity_verlet.hpp"

#include <cmath>

#include "core/padded.hpp"
#include "dynamics/maxwell.hpp"

namespace lanescape {

VelocityVerlet::VelocityVerlet(SoftLandscape& landscape, const Mixture& model, const ParticleLayout& layout, AlignedArray position,
                               double time_step)
    : landscape_(&landscape),
      layout_(&layout),
      masses_(model.species_masses()),
      position_(std::move(position)),
      velocity_(position_.size(), 0.0),
      gradient_(position_.size(), 0.0),
      time_step_(time_step) {
  if (model.has_equal_masses()) {
    segments_.push_back({0, layout.dimension(), masses_.front()});
  } else {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t s = 0; s < layout.blocks().size(); ++s) {
        const auto& block = layout.blocks()[s];
        segments_.push_back({axis * layout.slots() + block.begin, padded(block.count), masses_[s]});
      }
  }
  potential_ = landscape_->energy_and_gradient(position_, gradient_);
}

void VelocityVerlet::draw_velocities(double temperature, std::uint64_t seed) {
  const auto width = [temperature](double mass) { return std::sqrt(temperature / mass); };
  draw_maxwell_velocities(particles_of(*layout_, masses_, velocity_), width, seed);
  rescale_to(temperature);
}

void VelocityVerlet::rescale_to(double temperature) {
  remove_momentum(particles_of(*layout_, masses_, velocity_));
  const double now = this->temperature();
  if (now == 0.0) return;
  const double factor = std::sqrt(temperature / now);
  for (double& v : velocity_) v *= factor;
}

void VelocityVerlet::kick(double time) {
  for (const Segment& segment : segments_)
    landscape_->algebra().add_scaled(velocity_, -time / segment.mass, gradient_, segment.begin, segment.length);
}

void VelocityVerlet::step() {
  kick(0.5 * time_step_);
  landscape_->algebra().axpy(position_, position_, time_step_, velocity_);
  landscape_->gradient(position_, gradient_);
  potential_.reset();
  kick(0.5 * time_step_);
  ++steps_;
}

double VelocityVerlet::potential_energy() {
  if (!potential_) potential_ = landscape_->energy(position_);
  return *potential_;
}

double VelocityVerlet::kinetic_energy() const {
  double twice = 0.0;
  for (const Segment& segment : segments_)
    twice += segment.mass * landscape_->algebra().dot(velocity_, velocity_, segment.begin, segment.length);
  return 0.5 * twice;
}

double VelocityVerlet::temperature() const { return 2.0 * kinetic_energy() / (3.0 * static_cast<double>(layout_->size())); }

void VelocityVerlet::reverse_velocities() {
  for (double& v : velocity_) v = -v;
}

void VelocityVerlet::exchange(Archive& archive) {
  archive.field("position", position_);
  archive.field("velocity", velocity_);
  archive.field("steps", steps_);
  landscape_->exchange(archive);
  if (archive.reading()) potential_ = landscape_->energy_and_gradient(position_, gradient_);
}

}  // namespace lanescape
