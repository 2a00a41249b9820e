#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "kernel_table.hpp"

namespace lanescape {

// Instruction sets the kernels are compiled for, in rising order of preference.
enum class Isa { generic, sse2, avx2, avx512 };

const char* to_string(Isa isa);
// Compiled into this library and supported by this processor, in rising order.
std::vector<Isa> available_isas();
// The instruction set that `request` names or, where it is "auto" or empty, LANESCAPE_ISA; nothing if neither does. A name that
// is unknown, or an instruction set that is not available, throws Error(bad_input): never a silent fallback.
std::optional<Isa> forced_isa(std::string_view request);
// That one, else the best there is.
Isa choose_isa(std::string_view request);
// The kernels of an available instruction set.
const kernels::KernelTable& kernel_table(Isa isa);

}  // namespace lanescape
