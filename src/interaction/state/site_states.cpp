#include "interaction/state/site_states.hpp"

#include <algorithm>
#include <cmath>

#include "core/padded.hpp"
#include "core/parallel.hpp"

namespace lanescape {

Sites::Sites(const Box& box, const ParticleLayout& layout, std::vector<double> reaches, std::size_t states,
             const kernels::KernelTable& table, const Options& options)
    : box_(box),
      layout_(layout),
      table_(&table),
      list_(box, layout, reaches, options.skin, table, useful_threads(layout.size(), options.threads),
            NeighbourList::Coordinates::floating, options.members),
      reaches_squared_(reaches),
      states_{states, AlignedArray(layout.slots() * states, 0.0)} {
  for (double& reach : reaches_squared_) reach *= reach;
}

void Sites::set_box(const Box& box) {
  box_ = box;
  list_.set_box(box);
}

double Sites::furthest() const {
  double furthest = 0.0;
  for (const double squared : reaches_squared_) furthest = std::max(furthest, std::sqrt(squared));
  return furthest;
}

void Sites::move_to(const AlignedArray& positions) {
  positions_ = positions;
  list_.update(positions);
  near_known_ = false;
  near_.resize(list_.arrays());
  near_slopes_.resize(near_.size());
  for (std::size_t k = 0; k < near_.size(); ++k) {
    near_[k].resize(list_.array_size(k));
    near_slopes_[k].resize(list_.array_size(k) + kernels::slot_padding);
  }
  near_lengths_.resize(list_.block_count() * NeighbourList::block_rows * species());
}

Sites::Near Sites::near(std::size_t block) {
  return {near_[list_.array_of(block)].data() + list_.first_neighbour(block),
          near_lengths_.data() + NeighbourList::block_rows * species() * block,
          near_slopes_[list_.array_of(block)].data() + list_.first_neighbour(block),
          reaches_squared_.data() + list_.species_of(block) * species()};
}

// The fourth number of a point is the probability of the first of two states; more come in groups of four.
void Sites::put_states() {
  const std::size_t states = states_.states, width = kernels::point_width;
  if (states == 2) list_.set_values(states_.p, states);
  if (states < 3) return;
  const std::size_t points = list_.points(), groups = padded(states, width) / width;
  groups_.resize(groups * width * points);
  for_each_part(list_.threads(), [&](int part) {
    for (std::size_t k = part_begin(points, part, list_.threads()); k < part_begin(points, part + 1, list_.threads()); ++k) {
      const std::span<const double> p = states_.of(list_.slot_at(static_cast<std::uint32_t>(width * k)));
      for (std::size_t a = 0; a < groups * width; ++a)
        groups_[a / width * width * points + width * k + a % width] = a < states ? p[a] : 0.0;
    }
  });
}

kernels::StateProbabilities Sites::states_of(const kernels::NeighbourRows& rows, double* row_states) const {
  const std::size_t states = states_.states;
  for_each_row(list_, rows, [&](std::size_t row, std::size_t slot) {
    for (std::size_t a = 0; a < states; ++a) row_states[row * states + a] = states_.p[slot * states + a];
  });
  return {states, row_states, states < 3 ? rows.points : groups_.data(), states < 3 ? 0 : kernels::point_width * list_.points()};
}

void StateSums::add_virial(double force_over_r, const Point& d, double weight) {
  virial += weight * force_over_r * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  constexpr std::size_t voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  for (std::size_t k = 0; k < 6; ++k) virial_tensor[k] += weight * force_over_r * d[voigt[k][0]] * d[voigt[k][1]];
}

}  // namespace lanescape
