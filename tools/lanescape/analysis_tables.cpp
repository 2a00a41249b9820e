#include <algorithm>

#include "analysis_groups.hpp"

namespace lanescape::program {
namespace {

ResultRow mean_row(const GroupMean& mean) {
  return {{"count", mean.count},
          {"mean", mean.mean.value},
          {"error", json_or_null(mean.mean.error)},
          {"low", mean.interval ? Json(mean.interval->low) : Json()},
          {"high", mean.interval ? Json(mean.interval->high) : Json()}};
}

ResultRow group_row(const RunGroup& group) {
  ResultRow row = {{"group", group.name}};
  row.insert(row.end(), group.settings.begin(), group.settings.end());
  row.emplace_back("runs", group.runs.size());
  row.emplace_back("paths", group.paths());
  row.emplace_back("reached", group.reached());
  return row;
}

// Names of all distributions of a group, in the order of the first path that has them.
std::vector<std::string> distribution_names(const RunGroup& group) {
  std::vector<std::string> names;
  for (const AnalysedRun& run : group.runs)
    for (const AnalysedSample& sample : run.samples)
      for (const auto& [name, counts] : sample.distributions)
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

std::vector<Share> distribution_of(const RunGroup& group, const std::string& wanted) {
  std::vector<const ValueCounts*> paths;
  for (const AnalysedRun& run : group.runs)
    for (const AnalysedSample& sample : run.samples)
      for (const auto& [name, counts] : sample.distributions)
        if (name == wanted) paths.push_back(&counts);
  return pooled_shares(paths);
}

}  // namespace

ResultTable groups_table(const std::vector<RunGroup>& groups) { return table_of(groups, group_row); }

ResultTable means_table(const std::vector<RunGroup>& groups) {
  ResultTable table;
  for (const RunGroup& group : groups)
    for (const GroupMean& mean : group.means) {
      ResultRow row = {{"group", group.name}, {"quantity", mean.quantity}};
      for (auto& cell : mean_row(mean)) row.push_back(std::move(cell));
      table.push_back(std::move(row));
    }
  return table;
}

ResultTable distributions_table(const std::vector<RunGroup>& groups) {
  ResultTable table;
  for (const RunGroup& group : groups)
    for (const std::string& name : distribution_names(group))
      for (const Share& share : distribution_of(group, name))
        table.push_back({{"group", group.name},
                         {"quantity", name},
                         {"value", share.value},
                         {"probability", share.probability},
                         {"error", json_or_null(share.error)}});
  return table;
}

Json groups_json(const std::vector<RunGroup>& groups) {
  Json json = Json::array();
  for (const RunGroup& group : groups) {
    Json object;
    for (auto& [name, value] : group_row(group)) object[name] = value;
    object["means"] = Json::object();
    for (const GroupMean& mean : group.means)
      for (auto& [name, value] : mean_row(mean)) object["means"][mean.quantity][name] = value;
    json.push_back(std::move(object));
  }
  return json;
}

}  // namespace lanescape::program
