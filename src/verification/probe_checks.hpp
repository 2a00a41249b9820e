#pragma once

#include <string>
#include <vector>

#include "verification/cases.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape {

// Compares the probe kernels of a table with the scalar reference: particles of each case are removed one by one, and the remaining
// fluid is probed at their positions, also of open_cases(). Minimum-image cases are skipped if the probe has no such rule.
std::vector<Deviation> verify_probes(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                     const std::string& form = "lennard_jones");

}  // namespace lanescape
