// Algebra on 3N arrays. Sums use four interleaved partial sums (an addition has a latency of about four cycles), which are added in
// a fixed order. A result therefore depends on the instruction set and on nothing else.

#include "kernel_declarations.hpp"
#include "simd/simd.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

constexpr std::size_t partial_sums = 4;

// Sums term(i) over vectors starting at i = 0, lanes, 2 lanes, ...
template <class Term>
inline double ordered_sum(std::size_t n, Term term) noexcept {
  Vector sum[partial_sums] = {broadcast(0.0), broadcast(0.0), broadcast(0.0), broadcast(0.0)};
  std::size_t i = 0;
  for (; i + partial_sums * lanes <= n; i += partial_sums * lanes)
#pragma GCC unroll 4
    for (std::size_t k = 0; k < partial_sums; ++k) sum[k] = term(i + k * lanes, sum[k]);
  for (; i < n; i += lanes) sum[0] = term(i, sum[0]);
  return reduce_add((sum[0] + sum[1]) + (sum[2] + sum[3]));
}

inline Vector squared_displacement(const double* a, const double* b, std::size_t slots, std::size_t i) noexcept {
  const Vector dx = load(b + i) - load(a + i);
  const Vector dy = load(b + slots + i) - load(a + slots + i);
  const Vector dz = load(b + 2 * slots + i) - load(a + 2 * slots + i);
  return multiply_add(dz, dz, multiply_add(dy, dy, dx * dx));
}

}  // namespace

double dot(const double* a, const double* b, std::size_t n) noexcept {
  return ordered_sum(n, [=](std::size_t i, Vector s) { return multiply_add(load(a + i), load(b + i), s); });
}

double distance_squared(const double* a, const double* b, std::size_t n) noexcept {
  return ordered_sum(n, [=](std::size_t i, Vector s) {
    const Vector d = load(a + i) - load(b + i);
    return multiply_add(d, d, s);
  });
}

void difference(double* out, const double* a, const double* b, std::size_t n) noexcept {
  for (std::size_t i = 0; i < n; i += lanes) store(out + i, load(a + i) - load(b + i));
}

void combine(double* out, const double* x, double a, const double* u, double b, const double* v, std::size_t n) noexcept {
  const Vector va = broadcast(a), vb = broadcast(b);
  for (std::size_t i = 0; i < n; i += lanes)
    store(out + i, multiply_add(vb, load(v + i), multiply_add(va, load(u + i), load(x + i))));
}

void axpy(double* out, const double* x, double a, const double* u, std::size_t n) noexcept {
  const Vector va = broadcast(a);
  for (std::size_t i = 0; i < n; i += lanes) store(out + i, multiply_add(va, load(u + i), load(x + i)));
}

DisplacementMoments displacement_moments(const double* a, const double* b, std::size_t slots) noexcept {
  Vector second = broadcast(0.0), fourth = broadcast(0.0);
  for (std::size_t i = 0; i < slots; i += lanes) {
    const Vector square = squared_displacement(a, b, slots, i);
    second += square;
    fourth = multiply_add(square, square, fourth);
  }
  return {reduce_add(second), reduce_add(fourth)};
}

void add_particle_lengths(double* lengths, const double* a, const double* b, std::size_t slots) noexcept {
  for (std::size_t i = 0; i < slots; i += lanes)
    store(lengths + i, load(lengths + i) + square_root(squared_displacement(a, b, slots, i)));
}

double largest_displacement_squared(const double* a, const double* b, std::size_t slots, std::size_t begin,
                                    std::size_t end) noexcept {
  // The maximum would forget what is not a number; the minimum makes it infinite.
  const Vector infinite = broadcast(__builtin_inf());
  Vector largest = broadcast(0.0);
  for (std::size_t i = begin; i < end; i += slot_padding) {
#pragma GCC unroll 4
    for (std::size_t k = 0; k < slot_padding; k += lanes)
      largest = maximum(largest, minimum(squared_displacement(a, b, slots, i + k), infinite));
  }
  return reduce_max(largest);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
