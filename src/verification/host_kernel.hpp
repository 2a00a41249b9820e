#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/host_results.hpp"

namespace lanescape {

// Calls the function `symbol` of a shared library (lanescape/host_kernel.h) on each case, in a process of its own: one that ends,
// hangs or writes beyond its forces is the fault of its case, and the next case starts in a new process. What the kernel prints
// goes to stderr. Throws Error(bad_input) if the library cannot be loaded or lacks the function. Call it before any thread is
// started.
std::vector<HostResult> run_host_kernel(const std::filesystem::path& library, const std::string& symbol,
                                        const std::vector<PairCase>& cases);

}  // namespace lanescape
