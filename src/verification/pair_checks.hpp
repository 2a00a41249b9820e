#pragma once

#include <string>
#include <vector>

#include "verification/cases.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape {

// Whether the image rule allows a neighbour list for this case.
bool has_list(const PairCase& one);

// Compares the kernels of a pair potential in a table with the scalar reference; `form` starts the names of the results. Over all
// pairs; over neighbour lists, if a case allows one; in mixed precision, except for cases with a pair at the cutoff.
std::vector<Deviation> verify_all_pairs(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                        const std::string& form = "lennard_jones");
std::vector<Deviation> verify_lists(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                    const std::string& form = "lennard_jones");
std::vector<Deviation> verify_mixed(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                    const std::string& form = "lennard_jones");
// The same, and the probes.
std::vector<Deviation> verify_pairs(const kernels::KernelTable& table, const std::vector<PairCase>& cases, const std::string& form);

}  // namespace lanescape
