#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/box.hpp"
#include "kernel_table.hpp"

namespace lanescape {

// A particle and some others at their nearest images, as the one row of a neighbour list: for the pairs of one particle where there
// is no list. Lengths in the model's unit.
class NearestRows {
 public:
  NearestRows(const PairModel& model, const ParticleLayout& layout);

  // `partners`: slots in ascending order. Valid until the next call.
  kernels::PairListInput row(const AlignedArray& positions, const Box& box, std::size_t slot,
                             std::span<const std::uint32_t> partners);

 private:
  void put(const AlignedArray& diameters, std::size_t slot, const Point& place);
  std::size_t species_of(std::size_t slot) const;

  ParticleLayout layout_;
  std::vector<kernels::PairParameters> pairs_;
  AlignedArray points_;
  AlignedVector<std::uint32_t> offsets_, lengths_;
};

}  // namespace lanescape
