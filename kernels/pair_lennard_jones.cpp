#include "forms/lennard_jones.hpp"
#include "kernel_declarations.hpp"
#include "loops/pair_loops.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

constinit const PairKernels pair_lennard_jones = PairLoops<LennardJones>::kernels();

}  // namespace lanescape::kernels::LANESCAPE_ISA
