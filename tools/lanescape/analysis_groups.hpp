#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis_run.hpp"

namespace lanescape::program {

// A quantity of a group, over the paths that reached their goal, pairs of end points or runs.
struct GroupMean {
  std::string quantity;
  std::size_t count;
  Estimate mean;
  std::optional<Interval> interval;  // of the bootstrap
};

// Runs of one kind with the same state and settings.
struct RunGroup {
  std::string name;
  ResultRow settings;
  std::vector<AnalysedRun> runs;
  std::vector<GroupMean> means;

  std::size_t paths() const;
  std::size_t reached() const;
  const Json& setting(const std::string& name) const { return runs.front().setting(name); }
  // nullptr where the group has no such quantity.
  const GroupMean* mean(const std::string& quantity) const;
};

// In the order of kind, model and state, whatever the order of the runs.
std::vector<RunGroup> group_runs(std::vector<AnalysedRun> runs);
// Fills in the means.
void average(RunGroup& group, const BootstrapOptions& bootstrap);

ResultTable groups_table(const std::vector<RunGroup>& groups);
ResultTable means_table(const std::vector<RunGroup>& groups);
ResultTable distributions_table(const std::vector<RunGroup>& groups);
Json groups_json(const std::vector<RunGroup>& groups);

// Null where there is no value.
template <class T>
Json json_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

}  // namespace lanescape::program
