#pragma once

#include <string>

namespace lanescape {

// The number of threads that this process can run at once: the processors of its affinity mask, at most the processor time that its
// cgroups allow (versions 1 and 2, those above its own included), rounded up. At least 1. `root` precedes every file that is read.
int available_threads(const std::string& root = "");

// OMP_NUM_THREADS, which people who share a machine set, or what its list begins with; available_threads() where it is no number.
int default_threads();

}  // namespace lanescape
