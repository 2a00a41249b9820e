#include "configuration/particle_layout.hpp"

namespace lanescape {

ParticleLayout::ParticleLayout(const std::vector<int>& species, std::size_t species_count)
    : slot_of_(species.size()), blocks_(species_count) {
  for (const int s : species) ++blocks_[static_cast<std::size_t>(s)].count;
  for (auto& block : blocks_) {
    block.begin = slots_;
    slots_ += (block.count + kernels::slot_padding - 1) / kernels::slot_padding * kernels::slot_padding;
  }
  std::vector<std::size_t> next;
  for (const auto& block : blocks_) next.push_back(block.begin);
  for (std::size_t i = 0; i < species.size(); ++i) slot_of_[i] = next[static_cast<std::size_t>(species[i])]++;
}

AlignedArray ParticleLayout::to_slots(std::span<const double> interleaved) const {
  AlignedArray coordinates(dimension(), 0.0);
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) coordinates[axis * slots_ + slot_of_[i]] = interleaved[3 * i + axis];
  return coordinates;
}

std::vector<double> ParticleLayout::to_user(const AlignedArray& coordinates) const {
  std::vector<double> interleaved(3 * size());
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) interleaved[3 * i + axis] = coordinates[axis * slots_ + slot_of_[i]];
  return interleaved;
}

AlignedArray ParticleLayout::per_slot(std::span<const double> per_particle, double padding) const {
  AlignedArray values(slots_, padding);
  for (std::size_t i = 0; i < size(); ++i) values[slot_of_[i]] = per_particle[i];
  return values;
}

}  // namespace lanescape
