#include "run/path_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "landscape/make_landscape.hpp"
#include "observables/heterogeneity.hpp"

namespace lanescape {
namespace {

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

}  // namespace

PreparedPair prepare_pair(const AnyModel& model, const ConfigurationPair& pair, std::size_t number, const PathRunOptions& options,
                          Isa isa) {
  const std::string where = fmt::format("pair {}", number + 1);
  check_end_points(pair, model, where);
  const Mixture& mixture = mixture_of(model);
  const ParticleLayout layout = ParticleLayout::in_space_order(pair.start, mixture.species.size());
  PreparedPair prepared{layout, KinematicMetric(mixture, layout), layout.to_slots(pair.start.positions),
                        layout.to_slots(pair.finish.positions)};
  prepared.metric.to_kinematic(prepared.start);
  prepared.metric.to_kinematic(prepared.goal);
  prepared.distance = VectorAlgebra(kernel_table(isa)).distance(prepared.start, prepared.goal);
  if (is_hard(model)) {
    if (!prepared.metric.is_euclidean())
      throw_bad_input(fmt::format("{}: hard spheres of unequal masses have no path yet: equal masses are needed", where));
    return prepared;
  }
  const auto landscape = path_landscape({model, pair, prepared, options, isa, options.threads});
  const double highest_end = std::max(landscape->energy(prepared.start), landscape->energy(prepared.goal));
  prepared.landscape_energy = options.landscape_energy.value_or(highest_end);
  if (!(highest_end <= prepared.landscape_energy))
    throw_bad_input(fmt::format("{}: an end point has energy {}, above the landscape energy {}", where, highest_end,
                                prepared.landscape_energy));
  return prepared;
}

FinderOptions SearchSetup::finder_options() const {
  FinderOptions finder = options.finder;
  finder.patience *= options.method->patience_factor;
  return finder;
}

std::unique_ptr<SoftLandscape> path_landscape(const SearchSetup& setup) {
  std::unique_ptr<SoftLandscape> landscape =
      make_landscape(setup.model, setup.pair.start.box, setup.prepared.layout, setup.isa,
                     {.threads = setup.threads, .skin = path_skin, .precision = setup.options.precision});
  if (setup.prepared.metric.is_euclidean()) return landscape;
  return std::make_unique<KinematicLandscape>(std::move(landscape), setup.prepared.metric);
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
  for (const AlignedArray& q : recorder().frames()) add(q);
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
  result.length = statistics().length();
  result.participation_number = statistics().participation_number();
  result.distance = setup_.prepared.distance;
  result.landscape_energy = setup_.prepared.landscape_energy;
  result.seconds = clock().seconds();
  result.trace = recorder().trace();
  result.histograms = statistics().histograms();
  add_counts(result);
  for (std::size_t j = 0; j < layout.size(); ++j)
    result.particle_lengths.push_back(statistics().particle_lengths()[layout.slot_of(j)]);
  result.frames = frames();
  result.particle_displacements = displacements(result.frames.front(), result.frames.back());
  result.heterogeneity = heterogeneity_widths(result.particle_lengths, result.particle_displacements, setup_.pair.start.species,
                                              layout.blocks().size());
  return result;
}

}  // namespace lanescape
