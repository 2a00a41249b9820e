#pragma once

#include "views.hpp"

namespace lanescape::kernels {

// All kernels of one instruction set. Arrays are aligned to array_alignment; n is a multiple of slot_padding.
struct KernelTable {
  const char* name;
  std::size_t lanes;  // doubles per vector

  // Lennard-Jones mixtures over all pairs. The three give bit-equal energies and virials.
  double (*lj_energy)(const LjInput&) noexcept;
  void (*lj_gradient)(const LjInput&, double* gradient, LjOutput&) noexcept;
  void (*lj_stress)(const LjInput&, double* gradient, LjOutput&) noexcept;

  // Vector algebra in one fixed order of summation.
  double (*dot)(const double* a, const double* b, std::size_t n) noexcept;
  double (*distance_squared)(const double* a, const double* b, std::size_t n) noexcept;
  void (*difference)(double* out, const double* a, const double* b, std::size_t n) noexcept;  // a - b
  // out = x + a u + b v
  void (*combine)(double* out, const double* x, double a, const double* u, double b, const double* v, std::size_t n) noexcept;
  // out = x + a u
  void (*axpy)(double* out, const double* x, double a, const double* u, std::size_t n) noexcept;
  // Moments of b - a, arrays of 3 x slots.
  DisplacementMoments (*displacement_moments)(const double* a, const double* b, std::size_t slots) noexcept;

  // Runs `rounds` rounds of independent fused multiply-adds (products and sums where there is no fma); returns how many
  // floating-point operations that was. Measures the machine's limit for the benchmarks.
  double (*peak_rounds)(std::size_t rounds, double* sink) noexcept;
};

}  // namespace lanescape::kernels
