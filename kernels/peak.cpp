// The machine's peak, to which benchmarks relate their rates: enough independent multiply-adds to fill the pipes.

#include "kernel_declarations.hpp"
#include "simd/simd.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

double peak_rounds(std::size_t rounds, double* sink) noexcept {
  constexpr std::size_t chains = 12;  // at least latency (4) times pipes (2), and fits in 16 registers
  Vector x[chains];
  for (std::size_t k = 0; k < chains; ++k) x[k] = broadcast(1.0 + static_cast<double>(k));
  const Vector a = broadcast(0.999999), b = broadcast(1e-6);
  for (std::size_t round = 0; round < rounds; ++round)
#pragma GCC unroll 12
    for (std::size_t k = 0; k < chains; ++k) x[k] = multiply_add(x[k], a, b);
  Vector sum = broadcast(0.0);
  for (std::size_t k = 0; k < chains; ++k) sum += x[k];
  *sink = reduce_add(sum);
  return static_cast<double>(rounds) * chains * lanes * 2.0;
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
