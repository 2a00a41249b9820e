#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/aligned_array.hpp"
#include "core/random.hpp"
#include "verification/check.hpp"

namespace lanescape {
namespace {

// Inputs of the vector algebra: numbers of either sign with fractions that fill the mantissa.
AlignedArray random_array(std::size_t length, std::uint64_t which) {
  const CounterRandom random(1, RandomStream::displacements);
  AlignedArray values(length);
  for (std::size_t i = 0; i < length; ++i) values[i] = 20.0 * random.uniform(which, static_cast<std::uint32_t>(i)) - 10.0;
  return values;
}

struct VectorAlgebraChecks {
  explicit VectorAlgebraChecks(const kernels::KernelTable& kernels) : table(kernels) {}

  const kernels::KernelTable& table;
  Check dot{table, "dot", tolerance::vector_sum}, distance{table, "distance_squared", tolerance::vector_sum},
      second{table, "displacement_moments second", tolerance::vector_sum},
      fourth{table, "displacement_moments fourth", tolerance::vector_sum};
  Check difference{table, "difference", tolerance::exact}, combine{table, "combine", tolerance::linear_combination},
      axpy{table, "axpy", tolerance::linear_combination},
      largest_displacement{table, "largest_displacement_squared", tolerance::displacement},
      lengths{table, "add_particle_lengths", tolerance::displacement};

  void add_sums(const std::string& name, const AlignedArray& a, const AlignedArray& b) {
    TermSum product, square;
    for (std::size_t i = 0; i < a.size(); ++i) {
      product.add(static_cast<long double>(a[i]) * b[i]);
      square.add((static_cast<long double>(a[i]) - b[i]) * (static_cast<long double>(a[i]) - b[i]));
    }
    dot.add(name, relative(table.dot(a.data(), b.data(), a.size()), product.value, product.magnitude));
    distance.add(name, relative(table.distance_squared(a.data(), b.data(), a.size()), square.value, square.magnitude));
  }

  void add_displacements(const std::string& name, std::size_t slots, const AlignedArray& a, const AlignedArray& b) {
    TermSum squares, fourths;
    long double largest = 0.0L;
    double worst_length = 0.0;
    AlignedArray sums = random_array(slots, 4);
    const AlignedArray before = sums;
    table.add_particle_lengths(sums.data(), a.data(), b.data(), slots);
    for (std::size_t i = 0; i < slots; ++i) {
      long double r2 = 0.0L;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const long double d = static_cast<long double>(b[axis * slots + i]) - a[axis * slots + i];
        r2 += d * d;
      }
      squares.add(r2);
      fourths.add(r2 * r2);
      largest = std::max(largest, r2);
      const long double r = std::sqrt(r2);
      worst_length = std::max(worst_length, relative(sums[i], before[i] + r, std::abs(before[i]) + r));
    }
    largest_displacement.add(name,
                             relative(table.largest_displacement_squared(a.data(), b.data(), slots, 0, slots), largest, largest));
    lengths.add(name, worst_length);
    const kernels::DisplacementMoments moments = table.displacement_moments(a.data(), b.data(), slots);
    second.add(name, relative(moments.second, squares.value, squares.magnitude));
    fourth.add(name, relative(moments.fourth, fourths.value, fourths.magnitude));
  }

  void add_combinations(const std::string& name, const AlignedArray& a, const AlignedArray& b, const AlignedArray& c) {
    const std::size_t n = a.size();
    const double p = 1.0 / 3.0, q = -1.0 / 7.0;
    AlignedArray out(n, std::numeric_limits<double>::quiet_NaN());
    table.difference(out.data(), a.data(), b.data(), n);
    double wrong = 0.0;
    for (std::size_t i = 0; i < n; ++i) wrong += !same_bits(out[i], a[i] - b[i]);
    difference.add(name, wrong);

    const auto worst = [&](double factor) {
      double largest = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        TermSum expected;
        expected.add(a[i]);
        expected.add(static_cast<long double>(p) * b[i]);
        expected.add(static_cast<long double>(factor) * c[i]);
        largest = std::max(largest, relative(out[i], expected.value, expected.magnitude));
      }
      return largest;
    };
    table.axpy(out.data(), a.data(), p, b.data(), n);
    axpy.add(name, worst(0.0));
    table.combine(out.data(), a.data(), p, b.data(), q, c.data(), n);
    combine.add(name, worst(q));
  }
};

}  // namespace

std::vector<Deviation> verify_vector_algebra(const kernels::KernelTable& table) {
  VectorAlgebraChecks checks(table);
  // The short lengths leave each remainder of the four partial sums; the long ones show how errors grow.
  for (const std::size_t slots : {0U, 8U, 16U, 24U, 32U, 40U, 48U, 56U, 64U, 72U, 112U, 264U, 1000U}) {
    const std::string name = fmt::format("3 x {} slots", slots);
    const AlignedArray a = random_array(3 * slots, 1), b = random_array(3 * slots, 2), c = random_array(3 * slots, 3);
    checks.add_sums(name, a, b);
    checks.add_displacements(name, slots, a, b);
    checks.add_combinations(name, a, b, c);
  }
  return {checks.dot.deviation,        checks.distance.deviation, checks.second.deviation, checks.fourth.deviation,
          checks.difference.deviation, checks.combine.deviation,  checks.axpy.deviation,   checks.largest_displacement.deviation,
          checks.lengths.deviation};
}

}  // namespace lanescape
