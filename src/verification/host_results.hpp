#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verification/cases.hpp"

namespace lanescape {

// What a host's kernel says of one case. A quantity that it does not compute is absent.
struct HostResult {
  enum class Kind {
    given,
    declined,  // the kernel does not do this case
    missing,   // nothing is said
    broken     // the kernel failed
  } kind = Kind::missing;
  std::string fault{};  // of a broken one
  std::optional<double> energy{}, virial{};
  std::optional<std::vector<double>> forces{};  // 3N
};

// The arithmetic of a host's kernel.
enum class HostPrecision { double_precision, single_precision };
// Throws Error(bad_input) unless the word is "double" or "single".
HostPrecision parse_host_precision(std::string_view word);
const char* to_string(HostPrecision precision);

namespace tolerance {

// Kernels of hosts in double precision: forces as our own, pair_gradient; energies and virials more, because a host may add up to
// 7e4 terms one after the other, without lanes (measured 2.0e-14 of the sum of the absolute terms, for a long-range correction
// added per pair).
inline constexpr double host_sums = 2e-13;
// In single precision positions and every operation are rounded to 2^-24. Sums suffer as above (measured 1.1e-5), forces from the
// rounding of positions, which r^-13 amplifies (measured 4.0e-5).
inline constexpr double single_sums = 5e-5;
inline constexpr double single_gradient = 2e-4;
// A pair this close to the cutoff, relative to it, may or may not count in single precision: such cases are left out. Coordinates
// up to 60 are rounded to 60 x 2^-24 = 3.6e-6, twice per separation, against a cutoff of at least 1.
inline constexpr double single_cutoff = 0x1p-17;

}  // namespace tolerance

enum class HostOutcome { passed, failed, declined, missing, left_out };

struct HostVerdict {
  std::string name;
  HostOutcome outcome;
  std::string message;  // of a failure, one line: quantity, particle and component, expected and got
};

// The worst deviation of one quantity over all cases.
struct HostDeviation {
  std::string quantity;
  double tolerance = 0.0;
  std::size_t cases = 0;      // that were compared
  double worst = 0.0;         // relative to the sum of the absolute terms; infinite for NaN, or where only the exact value passes
  std::string worst_case{};   // empty if no case deviates at all
  std::size_t component = 0;  // of the forces: 3 i + axis
  double expected = 0.0, got = 0.0;

  bool is_vector() const { return quantity == "forces"; }
};

struct HostReport {
  std::vector<HostVerdict> verdicts;      // in the order of the cases
  std::vector<HostDeviation> quantities;  // energy, forces, virial

  std::size_t count(HostOutcome outcome) const;
  // At least one case was compared, and none failed.
  bool passed() const;
  // One line: how many failed, and the worst of them.
  std::string summary() const;
};

// Compares results, one for each case, with the scalar reference. In single precision, cases with a pair at the cutoff are left
// out.
HostReport compare_with_reference(const std::vector<PairCase>& cases, const std::vector<HostResult>& results,
                                  HostPrecision precision);

}  // namespace lanescape
