#include "analysis_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis_settings.hpp"
#include "core/error.hpp"
#include "csv_rows.hpp"
#include "resume_or_start.hpp"
#include "run_json.hpp"

namespace lanescape::program {
namespace fs = std::filesystem;

namespace {

constexpr const char* subcommands[] = {"endpoints", "path", "shorten", "diffusion"};

void add_if(Named<double>& values, const char* name, std::optional<double> value) {
  if (value) values.emplace_back(name, *value);
}

// Trials of one detour in the mean; the last entry of `corrections` counts all larger numbers of inner iterations.
std::optional<double> trials_per_detour(const std::vector<double>& corrections) {
  double detours = 0.0, inner = 0.0;
  for (std::size_t k = 0; k < corrections.size(); ++k) {
    detours += corrections[k];
    inner += static_cast<double>(k) * corrections[k];
  }
  return detours > 0.0 ? std::optional(1.0 + inner / detours) : std::nullopt;
}

// The entry of a path's steps or lengths that is not the direct one.
std::optional<double> detours_in(const RunJson& path, const char* key) {
  for (const auto& [kind, count] : path.entries(key))
    if (kind != "direct") return count.own_number();
  return std::nullopt;
}

Named<double> path_values(const RunJson& path, const RunJson& clock) {
  Named<double> values;
  for (const char* key : {"ratio_squared", "length", "distance", "participation_ratio"}) values.emplace_back(key, path.number(key));
  add_if(values, "direct_steps", path.in("steps").optional_number("direct"));
  add_if(values, "detour_steps", detours_in(path, "steps"));
  add_if(values, "direct_length", path.in("lengths").optional_number("direct"));
  add_if(values, "detour_length", detours_in(path, "lengths"));
  add_if(values, "evaluations", path.optional_number("evaluations"));
  add_if(values, "seconds", clock.optional_number("seconds"));
  add_if(values, "trials_per_detour", trials_per_detour(path.numbers("corrections")));
  for (const auto& [species, width] : path.entries("heterogeneity"))
    values.emplace_back("heterogeneity_" + species, width.own_number());
  return values;
}

// What a table of steps calls a quantity, what the analysis calls its distribution and its mean, and whether it is a share of N.
struct StepQuantity {
  const char* in_file;
  const char* distribution;
  const char* mean;
  bool per_particle;
};
constexpr StepQuantity step_quantities[] = {{"participation_ratio", "participation_ratio", nullptr, false},
                                            {"alpha_2", "alpha_2", "alpha_2", false},
                                            {"overlapping_partners", "overlapping_partners", "overlapping_partners", false},
                                            {"moved_particles", "moved_particles", "moved_share", true},
                                            {"groups", "groups", "groups_share", true},
                                            {"group_size_few_groups", "group_size_few_groups", "group_size_few_groups", false},
                                            {"group_size_some_groups", "group_size_some_groups", "group_size_some_groups", false},
                                            {"group_size_many_groups", "group_size_many_groups", "group_size_many_groups", false}};

// Distributions over the steps of a path, and their means; group_size is over all groups, however many there are in a step.
void read_steps(AnalysedSample& sample, const fs::path& file, double particles) {
  ValueCounts counts[std::size(step_quantities)], group_size;
  for_each_csv_row(file, "quantity,value,steps", [&](const CsvRow& row) {
    const double value = row.number(1), steps = row.number(2);
    for (std::size_t q = 0; q < std::size(step_quantities); ++q) {
      if (row.text(0) != step_quantities[q].in_file) continue;
      counts[q][step_quantities[q].per_particle ? value / particles : value] += steps;
      if (row.text(0).starts_with("group_size")) group_size[value] += steps;
    }
  });
  const auto add = [&](const char* distribution, const char* mean, ValueCounts& of) {
    const double average = mean_of(of);
    if (std::isnan(average)) return;
    if (mean != nullptr) sample.values.emplace_back(mean, average);
    sample.distributions.emplace_back(distribution, std::move(of));
  };
  for (std::size_t q = 0; q < std::size(step_quantities); ++q) {
    if (q == 5) add("group_size", "group_size", group_size);
    add(step_quantities[q].distribution, step_quantities[q].mean, counts[q]);
  }
}

template <class T>
T& entry_of(Named<T>& entries, const std::string& name) {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.first == name; });
  return found != entries.end() ? found->second : entries.emplace_back(name, T{}).second;
}

// log10(g_j/DeltaR_j) by species, in bins of 0.05, of which the upper edges are the values.
void read_particles(AnalysedSample& sample, const fs::path& file) {
  Named<ValueCounts> bins;
  for_each_csv_row(file, "particle,species,path_length,displacement", [&](const CsvRow& row) {
    const auto x = log_detour(row.number(2), row.number(3));
    if (!x) return;
    const std::string species(row.text(1));
    entry_of(sample.detours, species).add(*x);
    entry_of(bins, "log10_length_" + species)[std::ceil(*x / 0.05 - 1e-9) / 20.0 + 0.0] += 1.0;
  });
  for (auto& [name, counts] : bins) sample.distributions.emplace_back(name, std::move(counts));
}

AnalysedSample read_path(const fs::path& folder, std::size_t number, double particles, Named<double> values) {
  AnalysedSample sample{std::move(values), {}, {}};
  read_steps(sample, folder / fmt::format("path-{:04}-steps.csv", number + 1), particles);
  read_particles(sample, folder / fmt::format("path-{:04}-particles.csv", number + 1));
  return sample;
}

void read_paths(AnalysedRun& run, const RunJson& result) {
  const auto particles = run.setting("particles").get<double>();
  double distances = 0.0;
  const std::vector<RunJson> paths = result.list("paths");
  for (std::size_t k = 0; k < paths.size(); ++k) {
    ++run.paths;
    distances += paths[k].number("distance");
    if (paths[k].text("outcome") != "reached") continue;
    ++run.reached;
    run.samples.push_back(read_path(run.folder, k, particles, path_values(paths[k], paths[k])));
  }
  run.measured_distance = distances / static_cast<double>(run.paths);
}

void read_shortened(AnalysedRun& run, const RunJson& result) {
  run.paths = 1;
  run.measured_distance = result.optional_number("distance");
  if (!run.measured_distance)  // without a path
    run.measured_distance = read_pair_state(run.folder / "pair-0001.extxyz", false).measured_distance;
  if (result.text("outcome") != "reached") return;
  run.reached = 1;
  Named<double> values = path_values(result, result);
  const double before = result.number("length_before");
  values.emplace_back("length_before", before);
  values.emplace_back("shorter_by", 1.0 - result.number("length") / before);
  for (const char* key : {"kuhn_tucker_residual", "largest_violation"}) add_if(values, key, result.optional_number(key));
  run.samples.push_back(read_path(run.folder, 0, run.setting("particles").get<double>(), std::move(values)));
}

void read_end_points(AnalysedRun& run, const RunJson& result) {
  double distances = 0.0;
  for (const RunJson& pair : result.list("pairs")) {
    AnalysedSample sample;
    distances += pair.number("distance");
    for (const char* key : {"distance", "steps", "collisions", "time", "seconds"})
      add_if(sample.values, key, pair.optional_number(key));
    run.samples.push_back(std::move(sample));
  }
  run.paths = run.reached = run.samples.size();
  run.measured_distance = distances / static_cast<double>(run.paths);
  for (const char* key : {"compressibility", "temperature"})
    if (const auto value = result.optional_number(key)) run.values.emplace_back(key, WeightedValue{*value, std::nullopt, 1.0});
}

void read_diffusion(AnalysedRun& run, const RunJson& result) {
  const double trajectories = result.number("trajectories");
  run.paths = run.reached = static_cast<std::size_t>(trajectories);
  const auto add = [&](const RunJson& from, const std::string& key, const std::string& name) {
    const auto value = from.optional_number(key.c_str());
    if (value) run.values.emplace_back(name, WeightedValue{*value, from.optional_number((key + "_error").c_str()), trajectories});
  };
  for (const auto& [name, species] : result.entries("species"))
    for (const char* key : {"diffusion_vacf", "diffusion_msd", "diffusion_long_time", "displacement_exponent", "tau_alpha"})
      add(species, key, fmt::format("{}_{}", key, name));
  for (const char* key : {"compressibility", "pressure"}) add(result, key, key);
  if (result.has("temperature")) add(result, "temperature", "temperature");
}

toml::table read_options(const fs::path& file) {
  try {
    return toml::parse(read_text_file(file), file.string());
  } catch (const toml::parse_error& error) {
    throw_bad_input(fmt::format("{}:{}: it is damaged: {}", file.string(), error.source().begin.line, error.description()));
  }
}

void check_finished(const fs::path& folder, const RunJson& result, const std::string& subcommand) {
  if (std::find(std::begin(subcommands), std::end(subcommands), subcommand) == std::end(subcommands))
    throw_bad_input(
        fmt::format("{}: a run of '{}': runs of endpoints, path, shorten and diffusion are allowed", folder.string(), subcommand));
  if (!result.has(exit_status_key))
    throw_bad_input(fmt::format("{}: it has no {}: a finished run is needed", result.where(), exit_status_key));
  if (result.number(exit_status_key) == 4.0)
    throw_bad_input(fmt::format("{}: the run was interrupted: continue it with --resume", folder.string()));
}

}  // namespace

const Json& AnalysedRun::setting(const std::string& name) const {
  return std::find_if(settings.begin(), settings.end(), [&](const auto& entry) { return entry.first == name; })->second;
}

AnalysedRun read_analysed_run(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw_bad_input(fmt::format("{}: the folder of a finished run is needed", folder.string()));
  for (const char* needed : {"result.json", "run.toml"})
    if (!fs::exists(folder / needed))
      throw_bad_input(fmt::format("{}: no {}: the folder of a finished run is needed", folder.string(), needed));
  const toml::table options = read_options(folder / "run.toml");
  const Json json = read_json_object(folder / "result.json");
  const RunJson result(json, (folder / "result.json").string());
  const std::string subcommand = options["subcommand"].value_or(std::string());
  check_finished(folder, result, subcommand);
  const bool holds_any = subcommand == "path"        ? !result.list("paths").empty()
                         : subcommand == "endpoints" ? !result.list("pairs").empty()
                         : subcommand == "diffusion" ? result.number("trajectories") > 0.0
                                                     : true;
  if (!holds_any) throw_bad_input(fmt::format("{}: the run ended without any result", folder.string()));
  AnalysedRun run;
  run.folder = folder;
  run.settings = settings_of(folder, subcommand, options, result);
  if (subcommand == "path") read_paths(run, result);
  if (subcommand == "shorten") read_shortened(run, result);
  if (subcommand == "endpoints") read_end_points(run, result);
  if (subcommand == "diffusion") read_diffusion(run, result);
  return run;
}

}  // namespace lanescape::program
