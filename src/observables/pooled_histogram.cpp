#include "observables/pooled_histogram.hpp"

#include <limits>

#include "observables/statistics.hpp"

namespace lanescape {
namespace {

double total_of(const ValueCounts& counts) {
  double total = 0.0;
  for (const auto& [value, count] : counts) total += count;
  return total;
}

double count_at(const ValueCounts& counts, double value) {
  const auto found = counts.find(value);
  return found == counts.end() ? 0.0 : found->second;
}

}  // namespace

double mean_of(const ValueCounts& counts) {
  double sum = 0.0, total = 0.0;
  for (const auto& [value, count] : counts) {
    sum += value * count;
    total += count;
  }
  return total > 0.0 ? sum / total : std::numeric_limits<double>::quiet_NaN();
}

std::vector<Share> pooled_shares(std::span<const ValueCounts* const> paths) {
  ValueCounts sums;
  std::vector<const ValueCounts*> counted;
  std::vector<double> totals;
  double total = 0.0;
  for (const ValueCounts* path : paths) {
    const double of_path = total_of(*path);
    if (!(of_path > 0.0)) continue;
    counted.push_back(path);
    totals.push_back(of_path);
    total += of_path;
    for (const auto& [value, count] : *path) sums[value] += count;
  }
  std::vector<Share> shares;
  for (const auto& [value, sum] : sums) {
    const Estimate share = jackknife(counted.size(), [&, value = value, sum = sum](std::size_t k) {
      if (k == counted.size()) return sum / total;
      return (sum - count_at(*counted[k], value)) / (total - totals[k]);
    });
    shares.push_back({value, share.value, share.error});
  }
  return shares;
}

}  // namespace lanescape
