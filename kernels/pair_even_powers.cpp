#include "forms/even_powers.hpp"
#include "kernel_declarations.hpp"
#include "loops/pair_loops.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

constinit const PairKernels pair_even_powers = PairLoops<EvenPowers>::kernels();

}  // namespace lanescape::kernels::LANESCAPE_ISA
