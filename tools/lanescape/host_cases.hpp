#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/host_results.hpp"

namespace lanescape::program {

// The files of `cases`, for hosts whose kernel is no function in a shared library: parameters, positions, and the host's results.
inline constexpr const char* cases_file = "cases.json";
inline constexpr const char* positions_file = "cases.extxyz";
inline constexpr const char* host_results_file = "host_results.json";

// The contents of these files: the same bytes whenever this version of the program writes them. A case without particles has no
// frame.
std::string text_of_cases(const std::vector<PairCase>& cases);
std::string text_of_positions(const std::vector<PairCase>& cases);

// The results that a host has written into the folder, in the order of the cases. Throws Error(bad_input) naming file and case
// unless the folder's cases are those of this version, untouched, and every result has the right shape. A number that is null is
// NaN.
std::vector<HostResult> read_host_results(const std::filesystem::path& folder, const std::vector<PairCase>& cases);

}  // namespace lanescape::program
