#include "run/path_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "landscape/make_landscape.hpp"
#include "observables/heterogeneity.hpp"

namespace lanescape {
namespace {

constexpr std::uint64_t most_patience = 1'000'000'000'000'000;  // times any factor of a method it stays a count

// A chunk takes about 3 ms, of hard spheres 1 ms.
std::uint64_t steps_per_chunk(std::size_t particles) { return std::clamp<std::uint64_t>(30'000 / (particles + 1), 1, 1000); }

std::vector<double> displacements(const Configuration& first, const Configuration& last) {
  std::vector<double> lengths;
  for (std::size_t j = 0; j < first.size(); ++j)
    lengths.push_back(std::hypot(last.positions[3 * j] - first.positions[3 * j],
                                 last.positions[3 * j + 1] - first.positions[3 * j + 1],
                                 last.positions[3 * j + 2] - first.positions[3 * j + 2]));
  return lengths;
}

PreparedPair prepared_ends(const Mixture& mixture, const ParticleLayout& layout, const ConfigurationPair& pair, Isa isa) {
  PreparedPair prepared{layout, KinematicMetric(mixture, layout), {}, {}};
  prepared.start = prepared.metric.coordinates(layout, pair.start.positions);
  prepared.goal = prepared.metric.coordinates(layout, pair.finish.positions);
  prepared.distance = VectorAlgebra(kernel_table(isa)).distance(prepared.start, prepared.goal);
  return prepared;
}

std::unique_ptr<SoftLandscape> model_landscape(const AnyModel& model, const Box& box, const ParticleLayout& layout, Isa isa,
                                               int threads, Precision precision) {
  return make_landscape(model, box, layout, isa, {.threads = threads, .skin = path_skin, .precision = precision});
}

}  // namespace

std::unique_ptr<SoftLandscape> in_kinematic_coordinates(std::unique_ptr<SoftLandscape> landscape, const KinematicMetric& metric) {
  if (metric.is_euclidean()) return landscape;
  return std::make_unique<KinematicLandscape>(std::move(landscape), metric);
}

void PathRunOptions::check(const AnyModel& model) const {
  const double unit = length_unit(model);
  if (stepping == Stepping::adaptive) check_adaptive(*method);
  if (has_step_length()) check_positive("step", step_length(model), 1.0 * unit);
  if (stepping == Stepping::adaptive && direct_step) throw_bad_input("adaptive steps have no given length: without a step only");
  check_positive("avoidance step", avoidance_step_length(model), 0.1 * unit);
  if (escape_tolerance) check_positive("escape tolerance", *escape_tolerance);
  if (max_trials) check_at_least_one("limit of trials", *max_trials);
  if (max_depth) check_at_least_one("depth of the away method", *max_depth);
  if (finder.patience == 0 || finder.patience > most_patience)
    throw_bad_input(fmt::format("patience {} is not allowed: from 1 to {}", finder.patience, most_patience));
  if (landscape_energy && method->is_hard) throw_bad_input("hard spheres have no landscape energy: without it only");
  if (landscape_energy && !std::isfinite(*landscape_energy))
    throw_bad_input(fmt::format("landscape energy {} is not allowed: it must be finite", *landscape_energy));
  if (finder.max_steps == 0) throw_bad_input("the step limit must be at least 1");
  if (finder.frames > 100'000) throw_bad_input(fmt::format("{} frames are not allowed: at most 100000", finder.frames));
}

PreparedPair prepare_pair(const AnyModel& model, const ConfigurationPair& pair, const std::string& where,
                          const PathRunOptions& options, Isa isa) {
  check_end_points(pair, model, where);
  const Mixture& mixture = mixture_of(model);
  const ParticleLayout layout = ParticleLayout::in_space_order(pair.start, mixture.species.size());
  if (is_hard(model)) {
    if (!mixture.has_equal_masses() && options.stepping == Stepping::faithful)
      throw_bad_input(fmt::format("{}: hard spheres of unequal masses have no faithful path: adaptive steps are needed", where));
    return prepared_ends(mixture, layout, pair, isa);
  }
  const auto make = [&] { return model_landscape(model, pair.start.box, layout, isa, options.threads, options.precision); };
  return prepare_pair_on(make, mixture, layout, pair, where, options, isa);
}

PreparedPair prepare_pair_on(const SoftLandscapeMaker& make, const Mixture& mixture, const ParticleLayout& layout,
                             const ConfigurationPair& pair, const std::string& where, const PathRunOptions& options, Isa isa) {
  PreparedPair prepared = prepared_ends(mixture, layout, pair, isa);
  const auto landscape = in_kinematic_coordinates(make(), prepared.metric);
  const double ends[] = {landscape->energy(prepared.start), landscape->energy(prepared.goal)};
  for (const double end : ends)
    if (!std::isfinite(end)) throw_bad_input(fmt::format("{}: an end point has energy {}: it must be finite", where, end));
  const double highest_end = std::max(ends[0], ends[1]);
  prepared.landscape_energy = options.landscape_energy.value_or(highest_end);
  if (!(highest_end <= prepared.landscape_energy))
    throw_bad_input(fmt::format("{}: an end point has energy {}, above the landscape energy {}", where, highest_end,
                                prepared.landscape_energy));
  return prepared;
}

FinderOptions SearchSetup::finder_options() const {
  FinderOptions finder = options.finder;
  finder.patience *= options.method->patience_factor;
  finder.stepping = options.stepping;
  return finder;
}

std::unique_ptr<SoftLandscape> path_landscape(const SearchSetup& setup) {
  return in_kinematic_coordinates(setup.landscape ? setup.landscape()
                                                  : model_landscape(setup.model, setup.pair.start.box, setup.prepared.layout,
                                                                    setup.isa, setup.threads, setup.options.precision),
                                  setup.prepared.metric);
}

void add_statistics(PathResult& result, const PathStatistics& statistics, const ParticleLayout& layout) {
  result.length = statistics.length();
  result.participation_number = statistics.participation_number();
  result.histograms = statistics.histograms();
  for (std::size_t j = 0; j < layout.size(); ++j)
    result.particle_lengths.push_back(statistics.particle_lengths()[layout.slot_of(j)]);
}

void add_heterogeneity(PathResult& result, std::size_t species_count) {
  result.particle_displacements = displacements(result.frames.front(), result.frames.back());
  result.heterogeneity =
      heterogeneity_widths(result.particle_lengths, result.particle_displacements, result.frames.front().species, species_count);
}

PathResult shorter_way(PathResult forward, PathResult backward) {
  if (backward.outcome == Outcome::interrupted) return backward;
  const bool keep_backward =
      backward.outcome == Outcome::reached && (forward.outcome != Outcome::reached || backward.length < forward.length);
  return keep_backward ? backward : forward;
}

std::unique_ptr<PathSearch> begin_path(const SearchSetup& setup) {
  const PathMethod& method = *setup.options.method;
  return (setup.options.stepping == Stepping::adaptive ? method.begin_adaptive : method.begin)(setup);
}

PathSearch::PathSearch(const SearchSetup& setup) : setup_(setup), chunk_(steps_per_chunk(setup.prepared.layout.size())) {}

void PathSearch::advance(RunMonitor& monitor) {
  make_steps(chunk_ - steps() % chunk_);
  monitor.progress("path", 1.0 - distance_left() / setup_.prepared.distance, 1.0);
}

// From where the search began to where it has come.
std::vector<Configuration> PathSearch::frames() const {
  const ConfigurationPair& pair = setup_.pair;
  std::vector<Configuration> frames = {setup_.reversed ? pair.finish : pair.start};
  const auto add = [&](AlignedArray q) {
    setup_.prepared.metric.to_positions(q);
    frames.push_back(
        {pair.start.box, pair.start.species, setup_.prepared.layout.to_user(q), pair.start.radii, pair.start.diameters});
  };
  // The last point of a path, at which a frame may be due, can be its goal.
  for (const AlignedArray& q : recorder().frames())
    if (q != setup_.goal()) add(q);
  if (outcome() == Outcome::reached)
    frames.push_back(setup_.reversed ? pair.start : pair.finish);
  else
    add(position());
  return frames;
}

PathResult PathSearch::result() {
  const ParticleLayout& layout = setup_.prepared.layout;
  PathResult result;
  result.outcome = finished() ? outcome() : Outcome::interrupted;
  result.reversed = setup_.reversed;
  add_statistics(result, statistics(), layout);
  result.distance = setup_.prepared.distance;
  result.landscape_energy = setup_.prepared.landscape_energy;
  result.seconds = clock().seconds();
  result.trace = recorder().trace();
  add_counts(result);
  result.frames = frames();
  add_heterogeneity(result, layout.blocks().size());
  return result;
}

}  // namespace lanescape
