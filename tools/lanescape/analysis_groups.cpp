#include "analysis_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "analysis_settings.hpp"
#include "run/end_point_run.hpp"

namespace lanescape::program {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

Json& setting_of(ResultRow& settings, const std::string& name) {
  return std::find_if(settings.begin(), settings.end(), [&](const auto& entry) { return entry.first == name; })->second;
}

// Pairs end a little farther apart than asked. Measured distances up to this factor above the default are the default. Elsewhere
// runs of the same other settings whose distances lie within it belong together, under the smallest of them with 3 digits.
constexpr double same_distance = 1.02;

// That of endpoints, for a length unit of 1.
double default_distance_of(const AnalysedRun& run) { return default_distance(run.setting("particles").get<std::size_t>()); }

bool is_default_distance(const AnalysedRun& run) {
  const double least = default_distance_of(run);
  return *run.measured_distance >= least * (1.0 - 1e-9) && *run.measured_distance <= same_distance * least;
}

void settle_distances(std::vector<AnalysedRun>& runs) {
  static const std::string without[] = {"distance"};
  std::map<std::string, std::vector<AnalysedRun*>> alike;
  for (AnalysedRun& run : runs) {
    if (!run.setting("distance").is_null() || !run.measured_distance) continue;
    if (is_default_distance(run))
      setting_of(run.settings, "distance") = rounded(default_distance_of(run), 4);
    else
      alike[name_of_settings(run.settings, without)].push_back(&run);
  }
  for (auto& [name, members] : alike) {
    std::sort(members.begin(), members.end(), [](auto* a, auto* b) { return *a->measured_distance < *b->measured_distance; });
    double smallest = 0.0;
    for (AnalysedRun* run : members) {
      if (*run->measured_distance > same_distance * smallest) smallest = *run->measured_distance;
      setting_of(run->settings, "distance") = rounded(smallest, 3);
    }
  }
}

double number_or(const Json& value, double otherwise) { return value.is_number() ? value.get<double>() : otherwise; }

auto place_of(const RunGroup& group) {
  const auto number = [&](const char* name) { return number_or(group.setting(name), -1.0); };
  return std::tuple(group.setting("kind").get<std::string>(), group.setting("model").get<std::string>(), number("particles"),
                    number("density"), number("packing_fraction"), number("temperature"), group.name);
}

// The values of one quantity over all samples, NaN where a sample has none.
using Columns = std::vector<std::pair<std::string, std::vector<double>>>;

Columns columns_of(const std::vector<const AnalysedSample*>& samples) {
  Columns columns;
  std::map<std::string, std::size_t> places;
  for (std::size_t s = 0; s < samples.size(); ++s)
    for (const auto& [name, value] : samples[s]->values) {
      const auto [place, is_new] = places.try_emplace(name, columns.size());
      if (is_new) columns.emplace_back(name, std::vector<double>(samples.size(), nothing));
      columns[place->second].second[s] = value;
    }
  return columns;
}

double mean_of_rows(const std::vector<double>& column, std::span<const std::uint32_t> rows) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const std::uint32_t row : rows)
    if (!std::isnan(column[row])) {
      sum += column[row];
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : nothing;
}

// Sums of log10(g_j/DeltaR_j) of each sample, by species.
using Detours = std::vector<std::pair<std::string, std::vector<DetourSums>>>;

Detours detours_of(const std::vector<const AnalysedSample*>& samples) {
  Detours detours;
  for (std::size_t s = 0; s < samples.size(); ++s)
    for (const auto& [species, sums] : samples[s]->detours) {
      auto found =
          std::find_if(detours.begin(), detours.end(), [&, &of = species](const auto& entry) { return entry.first == of; });
      if (found == detours.end()) found = detours.insert(found, {species, std::vector<DetourSums>(samples.size())});
      found->second[s] = sums;
    }
  return detours;
}

Estimate pooled_width(const std::vector<DetourSums>& sums) {
  return jackknife(sums.size(), [&](std::size_t without) {
    DetourSums all;
    for (std::size_t k = 0; k < sums.size(); ++k)
      if (k != without) all += sums[k];
    return all.width();
  });
}

void average_samples(RunGroup& group, const BootstrapOptions& bootstrap) {
  std::vector<const AnalysedSample*> samples;
  for (const AnalysedRun& run : group.runs)
    for (const AnalysedSample& sample : run.samples) samples.push_back(&sample);
  const Columns columns = columns_of(samples);
  const Detours detours = detours_of(samples);
  const auto functions = [&](std::span<const std::uint32_t> rows, std::span<double> results) {
    for (std::size_t c = 0; c < columns.size(); ++c) results[c] = mean_of_rows(columns[c].second, rows);
    for (std::size_t d = 0; d < detours.size(); ++d) {
      DetourSums all;
      for (const std::uint32_t row : rows) all += detours[d].second[row];
      results[columns.size() + d] = all.width();
    }
  };
  const auto intervals = bootstrap_intervals(samples.size(), columns.size() + detours.size(), functions, bootstrap);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<double> values = columns[c].second;
    std::erase_if(values, [](double value) { return std::isnan(value); });
    const auto interval = values.size() > 1 ? intervals[c] : std::nullopt;
    group.means.push_back({columns[c].first, values.size(), estimate_mean(values), interval});
  }
  for (std::size_t d = 0; d < detours.size(); ++d)
    group.means.push_back({"heterogeneity_pooled_" + detours[d].first, samples.size(), pooled_width(detours[d].second),
                           intervals[columns.size() + d]});
}

void average_runs(RunGroup& group) {
  Named<std::vector<WeightedValue>> quantities;
  for (const AnalysedRun& run : group.runs)
    for (const auto& [name, value] : run.values) {
      auto found =
          std::find_if(quantities.begin(), quantities.end(), [&, &of = name](const auto& entry) { return entry.first == of; });
      if (found == quantities.end()) found = quantities.insert(found, {name, {}});
      found->second.push_back(value);
    }
  for (const auto& [name, values] : quantities) group.means.push_back({name, values.size(), weighted_mean(values), std::nullopt});
}

}  // namespace

std::size_t RunGroup::paths() const {
  std::size_t sum = 0;
  for (const AnalysedRun& run : runs) sum += run.paths;
  return sum;
}

std::size_t RunGroup::reached() const {
  std::size_t sum = 0;
  for (const AnalysedRun& run : runs) sum += run.reached;
  return sum;
}

const GroupMean* RunGroup::mean(const std::string& quantity) const {
  const auto found = std::find_if(means.begin(), means.end(), [&](const GroupMean& mean) { return mean.quantity == quantity; });
  return found == means.end() ? nullptr : &*found;
}

std::vector<RunGroup> group_runs(std::vector<AnalysedRun> runs) {
  settle_distances(runs);
  std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.folder < b.folder; });
  std::vector<RunGroup> groups;
  std::map<std::string, std::size_t> places;
  for (AnalysedRun& run : runs) {
    const std::string name = name_of_settings(run.settings);
    const auto [place, is_new] = places.try_emplace(name, groups.size());
    if (is_new) groups.push_back({name, run.settings, {}, {}});
    groups[place->second].runs.push_back(std::move(run));
  }
  std::sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return place_of(a) < place_of(b); });
  return groups;
}

void average(RunGroup& group, const BootstrapOptions& bootstrap) {
  average_samples(group, bootstrap);
  average_runs(group);
}

}  // namespace lanescape::program
