#include "forms/polydisperse.hpp"
#include "kernel_declarations.hpp"
#include "loops/pair_loops.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

constinit const PairKernels pair_polydisperse = PairLoops<Polydisperse>::kernels();

}  // namespace lanescape::kernels::LANESCAPE_ISA
