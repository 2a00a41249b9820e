#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "observables/heterogeneity.hpp"
#include "observables/pooled_histogram.hpp"
#include "observables/statistics.hpp"
#include "result_table.hpp"

namespace lanescape::program {

// What `analyze` takes from the folder of a finished run.

template <class T>
using Named = std::vector<std::pair<std::string, T>>;

// One path that reached its goal, or one pair of end points.
struct AnalysedSample {
  Named<double> values;
  Named<ValueCounts> distributions;
  Named<DetourSums> detours;  // by species
};

struct AnalysedRun {
  std::filesystem::path folder;
  ResultRow settings;                       // names of setting_columns(), null where a setting does not apply or is not known
  std::optional<double> measured_distance;  // mean over the pairs, where the distance asked for is not known [sigma]
  std::size_t paths = 0, reached = 0;       // of diffusion trajectories
  std::vector<AnalysedSample> samples;
  Named<WeightedValue> values;  // of the run as a whole

  const Json& setting(const std::string& name) const;
};

// Throws Error(bad_input), naming the file, for a folder without a finished run of endpoints, path, shorten or diffusion.
AnalysedRun read_analysed_run(const std::filesystem::path& folder);

}  // namespace lanescape::program
