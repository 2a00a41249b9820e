#include "core/option_checks.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace lanescape {

void check_positive(const char* option, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw_bad_input(fmt::format("{} {} is not allowed: it must be finite and above 0", option, value));
}

void check_positive(const char* option, double value, double most) {
  if (!(value > 0.0 && value <= most))
    throw_bad_input(fmt::format("{} {} is not allowed: above 0 and at most {}", option, value, most));
}

void check_at_least_one(const char* option, std::uint64_t value) {
  if (value == 0) throw_bad_input(fmt::format("{} must be at least 1", option));
}

int checked_threads(int threads) {
  if (threads < 1 || threads > 4096) throw_bad_input(fmt::format("{} threads are not allowed: from 1 to 4096", threads));
  return threads;
}

}  // namespace lanescape
