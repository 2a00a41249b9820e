#pragma once

#include <string>
#include <vector>

#include "kernel_table.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape::testing {

// The names of the checks that failed.
inline std::vector<std::string> failed_of(const std::vector<Deviation>& deviations) {
  std::vector<std::string> failed;
  for (const Deviation& deviation : deviations)
    if (!deviation.passed()) failed.push_back(deviation.kernel);
  return failed;
}

// A copy of the table with one kernel replaced.
template <class Kernel>
kernels::KernelTable with_kernel(const kernels::KernelTable& right, Kernel kernels::KernelTable::* kernel, Kernel replacement) {
  kernels::KernelTable table = right;
  table.*kernel = replacement;
  return table;
}

}  // namespace lanescape::testing
