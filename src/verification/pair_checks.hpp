#pragma once

#include <string>
#include <vector>

#include "verification/cases.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape {

// Whether the image rule allows a neighbour list for this case.
bool has_list(const PairCase& one);

// The kernels of a pair potential in a table against the scalar reference; `form` begins the names of the results. Over all pairs;
// over neighbour lists, where a case allows one; those in mixed precision, but for cases in which a pair is at the cutoff.
std::vector<Deviation> verify_all_pairs(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                        const std::string& form = "lennard_jones");
std::vector<Deviation> verify_lists(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                    const std::string& form = "lennard_jones");
std::vector<Deviation> verify_mixed(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                    const std::string& form = "lennard_jones");
// These and the probes.
std::vector<Deviation> verify_pairs(const kernels::KernelTable& table, const std::vector<PairCase>& cases, const std::string& form);

}  // namespace lanescape
