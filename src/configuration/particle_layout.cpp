#include "configuration/particle_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "configuration/mixture.hpp"
#include "core/padded.hpp"

namespace lanescape {
namespace {

std::vector<std::size_t> as_given(std::size_t n) {
  std::vector<std::size_t> particles(n);
  std::iota(particles.begin(), particles.end(), std::size_t{0});
  return particles;
}

}  // namespace

std::vector<std::size_t> order_in_space(std::span<const double> positions, const Box& box) {
  const std::size_t n = positions.size() / 3;
  const double width = std::cbrt(3.0 * box.volume() / static_cast<double>(n));
  std::vector<std::tuple<double, double, double, std::size_t>> keys;
  keys.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto wrapped = [&](std::size_t axis) { return box.wrapped(axis, positions[3 * i + axis]); };
    keys.emplace_back(std::floor(wrapped(0) / width), std::floor(wrapped(1) / width), wrapped(2), i);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> particles;
  particles.reserve(n);
  for (const auto& key : keys) particles.push_back(std::get<3>(key));
  return particles;
}

ParticleLayout::ParticleLayout(const std::vector<int>& species, std::size_t species_count) {
  assign(species, species_count, as_given(species.size()));
}

ParticleLayout ParticleLayout::in_space_order(const Configuration& configuration, std::size_t species_count) {
  const std::size_t n = configuration.size();
  return in_order(configuration, species_count,
                  n < sorted_from ? as_given(n) : order_in_space(configuration.positions, configuration.box));
}

ParticleLayout ParticleLayout::in_order(const Configuration& configuration, std::size_t species_count,
                                        std::span<const std::size_t> particles) {
  ParticleLayout layout;
  layout.assign(configuration.species, species_count, particles);
  if (!configuration.diameters.empty()) layout.diameters_ = layout.per_slot(configuration.diameters, 0.0);
  return layout;
}

std::vector<std::size_t> ParticleLayout::order() const {
  std::vector<std::size_t> in_slot(slots_, size());
  for (std::size_t i = 0; i < size(); ++i) in_slot[slot_of_[i]] = i;
  std::erase(in_slot, size());
  return in_slot;
}

ParticleLayout ParticleLayout::in_users_order(const Configuration& configuration, std::size_t species_count) {
  ParticleLayout layout(configuration.species, species_count);
  if (!configuration.diameters.empty()) layout.diameters_ = layout.per_slot(configuration.diameters, 0.0);
  return layout;
}

void ParticleLayout::assign(const std::vector<int>& species, std::size_t species_count, std::span<const std::size_t> particles) {
  check_species(species, species_count);
  slot_of_.resize(species.size());
  blocks_.resize(species_count);
  for (const int s : species) ++blocks_[static_cast<std::size_t>(s)].count;
  for (auto& block : blocks_) {
    block.begin = slots_;
    slots_ += padded(block.count);
  }
  std::vector<std::size_t> next;
  for (const auto& block : blocks_) next.push_back(block.begin);
  for (const std::size_t i : particles) slot_of_[i] = next[static_cast<std::size_t>(species[i])]++;
}

ParticleLayout ParticleLayout::in_unit(double unit) const {
  ParticleLayout layout = *this;
  for (double& diameter : layout.diameters_) diameter /= unit;
  return layout;
}

AlignedArray ParticleLayout::to_slots(std::span<const double> interleaved) const {
  AlignedArray coordinates(dimension(), 0.0);
  put_slots(interleaved, coordinates);
  return coordinates;
}

void ParticleLayout::put_slots(std::span<const double> interleaved, AlignedArray& coordinates) const {
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) coordinates[axis * slots_ + slot_of_[i]] = interleaved[3 * i + axis];
}

std::vector<double> ParticleLayout::to_user(const AlignedArray& coordinates) const {
  std::vector<double> interleaved(3 * size());
  put_user(coordinates, interleaved);
  return interleaved;
}

void ParticleLayout::put_user(const AlignedArray& coordinates, std::span<double> interleaved) const {
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) interleaved[3 * i + axis] = coordinates[axis * slots_ + slot_of_[i]];
}

AlignedArray ParticleLayout::per_slot(std::span<const double> per_particle, double padding) const {
  AlignedArray values(slots_, padding);
  for (std::size_t i = 0; i < size(); ++i) values[slot_of_[i]] = per_particle[i];
  return values;
}

}  // namespace lanescape
