#pragma once

#include <cstdint>
#include <span>

namespace lanescape {

// Throw Error(bad_input) where an option is out of range; `option` names it in the message.
void check_positive(const char* option, double value);               // finite and above 0
void check_positive(const char* option, double value, double most);  // above 0 and at most `most`
void check_at_least_one(const char* option, std::uint64_t value);

// Throws Error(bad_input) for an edge of a box outside this range, in any unit: beyond it volumes are not numbers.
inline constexpr double least_edge = 1e-100, greatest_edge = 1e100;
void check_edges(std::span<const double> edges);

// Throws Error(bad_input) for a coordinate that is not finite.
void check_finite(std::span<const double> coordinates);

}  // namespace lanescape
