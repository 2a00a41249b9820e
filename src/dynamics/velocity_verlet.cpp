#include "dynamics/velocity_verlet.hpp"

#include <algorithm>
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

void VelocityVerlet::kick(std::size_t begin, std::size_t end) {
  const std::size_t slots = position_.size() / 3;
  for (const Segment& segment : segments_)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t first = std::max(axis * slots + begin, segment.begin),
                        last = std::min(axis * slots + end, segment.begin + segment.length);
      if (first < last)
        landscape_->algebra().add_scaled(velocity_, -0.5 * time_step_ / segment.mass, gradient_, first, last - first);
    }
}

void VelocityVerlet::drift(std::size_t begin, std::size_t end) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    landscape_->algebra().add_scaled(position_, time_step_, velocity_, axis * (position_.size() / 3) + begin, end - begin);
}

void VelocityVerlet::step() {
  const auto move = [this](std::size_t begin, std::size_t end) {
    kick(begin, end);
    drift(begin, end);
  };
  landscape_->gradient_after(move, position_, gradient_);
  potential_.reset();
  landscape_->algebra().for_all_slots(position_.size() / 3, [this](std::size_t begin, std::size_t end) { kick(begin, end); });
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
