#include "kernel_declarations.hpp"
#include "simd_ops.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

extern __attribute__((visibility("default"))) const KernelTable table;
constinit const KernelTable table{
    .name = LANESCAPE_ISA_STRING(LANESCAPE_ISA),
    .lanes = lanes,
    .lj_energy = lj_energy,
    .lj_gradient = lj_gradient,
    .lj_stress = lj_stress,
    .dot = dot,
    .distance_squared = distance_squared,
    .difference = difference,
    .combine = combine,
    .axpy = axpy,
    .displacement_moments = displacement_moments,
    .peak_rounds = peak_rounds,
};

}  // namespace lanescape::kernels::LANESCAPE_ISA
