#include "forms/soft_sphere.hpp"
#include "kernel_declarations.hpp"
#include "loops/pair_loops.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

constinit const PairKernels pair_soft_sphere = PairLoops<SoftSphere>::kernels();

}  // namespace lanescape::kernels::LANESCAPE_ISA
