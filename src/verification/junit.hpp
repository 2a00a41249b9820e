#pragma once

#include <iosfwd>
#include <vector>

#include "verification/host_results.hpp"
#include "verification/kernel_checks.hpp"

namespace lanescape {

// One test suite, one test case per deviation (class: the instruction set, name: the kernel), as JUnit XML in UTF-8.
void write_junit(std::ostream& out, const std::vector<Deviation>& deviations);
// One test case per case of a host's kernel; those that were not compared are skipped, with the reason.
void write_junit(std::ostream& out, const HostReport& report);

}  // namespace lanescape
