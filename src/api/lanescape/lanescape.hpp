#pragma once

// What other programs link against, all of it. Lengths, energies and masses are in any consistent units; k_B = 1. Wherever a
// function throws, it throws lanescape::Error with a code and one line saying what is wrong, where and what is allowed.
// Objects that were moved from throw it too, until they are assigned to.

#include <string>
#include <vector>

#include <lanescape/version.h>
#include <lanescape/domain_potential.hpp>
#include <lanescape/dynamics.hpp>
#include <lanescape/error.hpp>
#include <lanescape/flow.hpp>
#include <lanescape/hard_spheres.hpp>
#include <lanescape/insertion.hpp>
#include <lanescape/landscape.hpp>
#include <lanescape/listed_potential.hpp>
#include <lanescape/model.hpp>
#include <lanescape/neighbours.hpp>
#include <lanescape/path.hpp>
#include <lanescape/potential.hpp>
#include <lanescape/shortening.hpp>
#include <lanescape/states.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// The library's version, e.g. "0.1.0".
LANESCAPE_API const char* version() noexcept;
// Instruction sets the kernels can use on this processor, best last.
LANESCAPE_API std::vector<std::string> instruction_sets();

LANESCAPE_ABI_END
}  // namespace lanescape
