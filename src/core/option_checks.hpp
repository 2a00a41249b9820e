#pragma once

#include <cstdint>

namespace lanescape {

// Throw Error(bad_input) where an option is out of range; `option` names it in the message.
void check_positive(const char* option, double value);               // finite and above 0
void check_positive(const char* option, double value, double most);  // above 0 and at most `most`
void check_at_least_one(const char* option, std::uint64_t value);
int checked_threads(int threads);  // from 1 to 4096; returns them

}  // namespace lanescape
