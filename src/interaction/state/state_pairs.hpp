#pragma once

#include <cstddef>

namespace lanescape {

// Parameters for each state of each species with each of each other. u_ab of species (s, t) must be u_ba of (t, s).
struct StatePairs {
  std::size_t species, states;
  std::size_t size() const { return species * species * states * states; }
  std::size_t at(std::size_t s, std::size_t a, std::size_t t, std::size_t b) const {
    return ((s * species + t) * states + a) * states + b;
  }
};

}  // namespace lanescape
