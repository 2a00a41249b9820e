#include "forms/yukawa.hpp"
#include "kernel_declarations.hpp"
#include "loops/pair_loops.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

constinit const PairKernels pair_yukawa = PairLoops<Yukawa>::kernels();

}  // namespace lanescape::kernels::LANESCAPE_ISA
