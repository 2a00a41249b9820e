#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dispatch/isa.hpp"
#include "every_isa.hpp"
#include "verification/kernel_checks.hpp"
#include "wrong_kernels.hpp"

namespace lanescape {
namespace {

using kernels::KernelTable;

using VectorAlgebraParity = testing::EveryIsa;

INSTANTIATE_TEST_SUITE_P(EveryIsa, VectorAlgebraParity, testing::all_isas(), testing::isa_name);

TEST_P(VectorAlgebraParity, AgreesWithPlainLoopsAtEveryLength) {
  for (const Deviation& deviation : verify_vector_algebra(kernel_table(GetParam()))) {
    EXPECT_TRUE(deviation.passed()) << describe(deviation);
    EXPECT_EQ(deviation.isa, to_string(GetParam()));
  }
}

TEST_P(VectorAlgebraParity, PeakMeasurementDoesTheArithmeticItCounts) {
  const KernelTable& table = kernel_table(GetParam());
  double sink = 0.0;
  const double operations = table.peak_rounds(1000, &sink);
  EXPECT_EQ(operations, 1000.0 * 12.0 * 2.0 * static_cast<double>(table.lanes));
  // Chain k starts at 1 + k and approaches 1 by a factor 0.999999 per round.
  const double expected = (12.0 + 66.0 * std::pow(0.999999, 1000)) * static_cast<double>(table.lanes);
  EXPECT_NEAR(sink, expected, 1e-9 * expected);
}

// The checks must be able to fail: each kernel is replaced by one that is slightly wrong in one place.
const KernelTable* right = nullptr;  // source of the correct kernels; global, because a kernel is a plain function

double wrong_dot(const double* a, const double* b, std::size_t n) noexcept { return right->dot(a, b, n) * (1.0 + 1e-12); }
double dot_without_last(const double* a, const double* b, std::size_t n) noexcept {
  return n == 0 ? 0.0 : right->dot(a, b, n) - a[n - 1] * b[n - 1];
}
double wrong_distance(const double* a, const double* b, std::size_t n) noexcept {
  return right->distance_squared(a, b, n) * (1.0 - 1e-13);
}
void wrong_difference(double* out, const double* a, const double* b, std::size_t n) noexcept {
  right->difference(out, a, b, n);
  if (n > 0) out[n - 1] = std::nextafter(out[n - 1], 0.0);
}
void wrong_combine(double* out, const double* x, double a, const double* u, double b, const double* v, std::size_t n) noexcept {
  right->combine(out, x, a, u, b, v, n);
  if (n > 0) out[n - 1] += 1e-14;
}
void wrong_axpy(double* out, const double* x, double a, const double* u, std::size_t n) noexcept {
  right->axpy(out, x, a, u, n);
  if (n > 0) out[0] = std::nan("");
}
kernels::DisplacementMoments wrong_second(const double* a, const double* b, std::size_t slots) noexcept {
  auto moments = right->displacement_moments(a, b, slots);
  moments.second *= 1.0 + 1e-13;
  return moments;
}
kernels::DisplacementMoments wrong_fourth(const double* a, const double* b, std::size_t slots) noexcept {
  auto moments = right->displacement_moments(a, b, slots);
  moments.fourth *= 1.0 + 1e-13;
  return moments;
}

double wrong_largest(const double* a, const double* b, std::size_t slots, std::size_t begin, std::size_t end) noexcept {
  return right->largest_displacement_squared(a, b, slots, begin, end) * (1.0 - 1e-15);
}
double largest_second(const double* a, const double* b, std::size_t slots, std::size_t, std::size_t) noexcept {
  std::vector<double> largest(slots);
  for (std::size_t i = 0; i < slots; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) largest[i] += std::pow(b[axis * slots + i] - a[axis * slots + i], 2);
  if (slots > 0) *std::max_element(largest.begin(), largest.end()) = 0.0;
  return slots > 0 ? *std::max_element(largest.begin(), largest.end()) : 0.0;
}
void wrong_lengths(double* lengths, const double* a, const double* b, std::size_t slots) noexcept {
  if (slots > 0) lengths[slots - 1] = 0.0;
  right->add_particle_lengths(lengths, a, b, slots);
}

std::vector<std::string> failed_checks(const KernelTable& table) { return testing::failed_of(verify_vector_algebra(table)); }

TEST(VectorAlgebraChecks, FailForTheKernelThatIsWrongAndForNoOther) {
  right = &kernel_table(available_isas().back());
  const auto failed_with = [](auto KernelTable::* kernel, auto replacement) {
    return failed_checks(testing::with_kernel(*right, kernel, +replacement));
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(failed_checks(*right), Names{});
  EXPECT_EQ(failed_with(&KernelTable::dot, wrong_dot), Names{"dot"});
  EXPECT_EQ(failed_with(&KernelTable::dot, dot_without_last), Names{"dot"});
  EXPECT_EQ(failed_with(&KernelTable::distance_squared, wrong_distance), Names{"distance_squared"});
  EXPECT_EQ(failed_with(&KernelTable::difference, wrong_difference), Names{"difference"});
  EXPECT_EQ(failed_with(&KernelTable::combine, wrong_combine), Names{"combine"});
  EXPECT_EQ(failed_with(&KernelTable::axpy, wrong_axpy), Names{"axpy"});
  EXPECT_EQ(failed_with(&KernelTable::displacement_moments, wrong_second), Names{"displacement_moments second"});
  EXPECT_EQ(failed_with(&KernelTable::displacement_moments, wrong_fourth), Names{"displacement_moments fourth"});
  EXPECT_EQ(failed_with(&KernelTable::largest_displacement_squared, wrong_largest), Names{"largest_displacement_squared"});
  EXPECT_EQ(failed_with(&KernelTable::largest_displacement_squared, largest_second), Names{"largest_displacement_squared"});
  EXPECT_EQ(failed_with(&KernelTable::add_particle_lengths, wrong_lengths), Names{"add_particle_lengths"});
}

}  // namespace
}  // namespace lanescape
