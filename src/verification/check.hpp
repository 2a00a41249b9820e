#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "verification/kernel_checks.hpp"

namespace lanescape {

// |value - expected| in units of `scale`. If nothing contributes (scale 0) only the exact value passes; a NaN gives an infinite
// deviation.
inline double relative(long double value, long double expected, long double scale) {
  const long double difference = std::abs(value - expected);
  if (difference == 0.0L) return 0.0;
  const auto deviation = static_cast<double>(difference / scale);
  return std::isnan(deviation) ? std::numeric_limits<double>::infinity() : deviation;
}

inline bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

// A sum, and that of the absolute terms, by which its rounding is measured.
struct TermSum {
  long double value = 0.0L, magnitude = 0.0L;
  void add(long double term) {
    value += term;
    magnitude += std::abs(term);
  }
};

// Keeps the worst of many cases.
struct Check {
  Deviation deviation;

  Check(const kernels::KernelTable& table, const std::string& kernel, double tolerance)
      : deviation{kernel, table.name, "", 0.0, tolerance, 0} {}
  void add(const std::string& name, double value) {
    ++deviation.cases;
    if (value <= deviation.worst) return;
    deviation.worst = value;
    deviation.worst_case = name;
  }
};

}  // namespace lanescape
