#pragma once

#include <array>

#include "capi/barrier.hpp"

namespace lanescape::capi {

// Arguments that many functions take.
inline std::array<double, 3> three(const double* numbers, const char* argument) {
  given(numbers, argument);
  return {numbers[0], numbers[1], numbers[2]};
}

inline std::span<const double> vectors(const double* data, std::size_t particles, const char* argument) {
  return array(data, times(3, particles), argument);
}

// Nobody has so many, and the square of the number stays one.
inline void check_species(std::size_t species) {
  constexpr std::size_t most = 1'000'000;
  if (species > most) refuse("species " + std::to_string(species) + " is not allowed: it must be at most " + std::to_string(most));
}

// Copies to the caller what it wants.
template <class Numbers, class Number>
void copy_out(const Numbers& from, Number* to) {
  if (to != nullptr) std::copy(from.begin(), from.end(), to);
}

}  // namespace lanescape::capi
