#include "flow/beside_buffer.hpp"

namespace lanescape {

BesideBuffer::BesideBuffer(const SlabGeometry& geometry, std::size_t face, double mass)
    : geometry_(&geometry),
      face_(face),
      low_(face == 0 ? geometry.buffer : geometry.length - geometry.buffer - geometry.slice_width()),
      high_(low_ + geometry.slice_width()),
      volume_(geometry.area * geometry.slice_width()),
      mass_(mass) {}

void BesideBuffer::add(std::span<const double> positions, std::span<const double> velocities, std::span<const double> energies) {
  samples_ += 1.0;
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    if (geometry_->depth(face_, positions[i]) > 0.0) in_buffer_ += 1.0;
    if (!contains(positions[i])) continue;
    count_ += 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double v = velocities[i + axis];
      momentum_[axis] += mass_ * v;
      kinetic_ += 0.5 * mass_ * v * v;
    }
    if (energies.empty()) continue;
    potential_ += energies[i / 3];
    potential_count_ += 1.0;
  }
}

void BesideBuffer::put_means(FaceReport& report) const {
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    report.velocity[axis] = momentum_[axis] / (mass_ * count_);
    squared += report.velocity[axis] * report.velocity[axis];
  }
  report.density = count_ / (samples_ * volume_);
  report.filling = in_buffer_ / (samples_ * geometry_->area * geometry_->buffer * report.density);
  report.temperature = (2.0 * kinetic_ / count_ - mass_ * squared) / 3.0;
  report.energy_per_particle = kinetic_ / count_ + potential_ / potential_count_;
}

}  // namespace lanescape
