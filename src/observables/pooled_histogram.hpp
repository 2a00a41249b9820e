#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace lanescape {

// How often a quantity took each value along one path, or with which length of adaptive steps.
using ValueCounts = std::map<double, double>;

double mean_of(const ValueCounts& counts);  // NaN without counts

struct Share {
  double value;
  double probability;           // of this value, or of the bin that it names; all add up to 1
  std::optional<double> error;  // over paths
};

// The distribution over all steps of several paths, in ascending order of values. Errors are the jackknife's over paths; there are
// none where a single path has counts. Empty without counts.
std::vector<Share> pooled_shares(std::span<const ValueCounts* const> paths);

}  // namespace lanescape
