#pragma once

#include <string>
#include <vector>

#include "verification/cases.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape {

// The probe kernels of a table against the scalar reference: particles of each case are taken out one by one, and what is left is
// probed where they were. Cases under the minimum-image rule are left out where a probe has no such rule.
std::vector<Deviation> verify_probes(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                     const std::string& form = "lennard_jones");

}  // namespace lanescape
