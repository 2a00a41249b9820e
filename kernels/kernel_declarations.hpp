#pragma once

#include "isa.hpp"
#include "kernel_table.hpp"

// Every kernel of the instruction set being compiled. kernel_list.def documents them.
namespace lanescape::kernels::LANESCAPE_ISA {

#define LANESCAPE_PAIR_FORM(name, Form) extern const PairKernels pair_##name;
LANESCAPE_PAIR_FORMS(LANESCAPE_PAIR_FORM)
#undef LANESCAPE_PAIR_FORM

#define LANESCAPE_KERNEL(result, kernel, arguments) result kernel arguments noexcept;
#include "kernel_list.def"
#undef LANESCAPE_KERNEL

}  // namespace lanescape::kernels::LANESCAPE_ISA
