#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dispatch/instruction_sets.hpp"
#include "kernel_table.hpp"

namespace lanescape {

// Instruction sets the kernels are compiled for, in rising order of preference.
#define LANESCAPE_ENTRY(name) name,
enum class Isa { LANESCAPE_INSTRUCTION_SETS(LANESCAPE_ENTRY) };
#undef LANESCAPE_ENTRY
#define LANESCAPE_ENTRY(name) Isa::name,
inline constexpr Isa every_isa[] = {LANESCAPE_INSTRUCTION_SETS(LANESCAPE_ENTRY)};
#undef LANESCAPE_ENTRY

const char* to_string(Isa isa);
// Compiled into this library and supported by this processor, in rising order.
std::vector<Isa> available_isas();
// LANESCAPE_ISA as the first call in this process found it; empty where it is not set.
const std::string& isa_of_environment();
// The instruction set that `request` names or, where it is "auto" or empty, `environment`; nothing if neither does. A name that is
// unknown, or an instruction set that is not available, throws Error(bad_input): never a silent fallback.
std::optional<Isa> forced_isa(std::string_view request, const std::string& environment = isa_of_environment());
// That one, else the best there is.
Isa choose_isa(std::string_view request, const std::string& environment = isa_of_environment());
// The kernels of an available instruction set.
const kernels::KernelTable& kernel_table(Isa isa);

}  // namespace lanescape
