#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "configuration/particle_layout.hpp"

namespace lanescape {

// Pairs of particles that do not interact, such as bonded ones: for each slot its partners in ascending order.
class Exclusions {
 public:
  // Pairs of particles from 0. Throws Error(bad_input) for a pair of a particle with itself, one that is given twice, in either
  // order, and a particle that there is not.
  Exclusions(std::span<const std::array<std::size_t, 2>> pairs, const ParticleLayout& layout);

  std::span<const std::uint32_t> of(std::size_t slot) const { return std::span(partners_).subspan(first_[slot], count(slot)); }
  std::size_t count(std::size_t slot) const { return first_[slot + 1] - first_[slot]; }
  std::size_t slots() const { return first_.size() - 1; }

 private:
  std::vector<std::size_t> first_;  // of each slot's partners; one more at the end
  std::vector<std::uint32_t> partners_;
};

}  // namespace lanescape
