#include "kernel_declarations.hpp"
#include "simd/simd.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

extern __attribute__((visibility("default"))) const KernelTable table;
constinit const KernelTable table{
    .name = LANESCAPE_ISA_STRING(LANESCAPE_ISA),
    .lanes = lanes,
    .sphere_pair_columns = float_lanes,
#define LANESCAPE_PAIR_FORM(name, Form) &pair_##name,
    .pair = {LANESCAPE_PAIR_FORMS(LANESCAPE_PAIR_FORM)},
#undef LANESCAPE_PAIR_FORM
#define LANESCAPE_KERNEL(result, kernel, arguments) .kernel = kernel,
#include "kernel_list.def"
#undef LANESCAPE_KERNEL
};

}  // namespace lanescape::kernels::LANESCAPE_ISA
