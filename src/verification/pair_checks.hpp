#pragma once

#include <string>
#include <vector>

#include "verification/cases.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape {

// Whether the image rule allows a neighbour list for this case.
bool has_list(const PairCase& one);
// Whether clusters can hold this case.
bool has_clusters(const PairCase& one);

// Whether a pair is so close to the cutoff, within this part of it, that rounding may put it on the other side. Without a shift,
// all pair energies at a cutoff beyond the minimum have the same sign, so they cannot cancel.
bool has_pair_at_cutoff(const PairCase& one, double margin);

// Compares the kernels of a pair potential in a table with the scalar reference; `form` starts the names of the results. Over all
// pairs; over neighbour lists, if a case allows one, also of open_cases(); in mixed precision, over lists and clusters, except for
// cases with a pair at the cutoff.
std::vector<Deviation> verify_all_pairs(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                        const std::string& form = "lennard_jones");
std::vector<Deviation> verify_lists(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                    const std::string& form = "lennard_jones");
std::vector<Deviation> verify_mixed(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                    const std::string& form = "lennard_jones");
// Over clusters, also of cluster_cases(); nothing for a form with diameters.
std::vector<Deviation> verify_clusters(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                       const std::string& form = "lennard_jones");
// The same, and the probes.
std::vector<Deviation> verify_pairs(const kernels::KernelTable& table, const std::vector<PairCase>& cases, const std::string& form);

}  // namespace lanescape
