#include "run/path_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <memory>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "interaction/sphere/check_overlap.hpp"
#include "interaction/state/state_mixture.hpp"
#include "landscape/hard_sphere_landscape.hpp"
#include "landscape/kinematic_landscape.hpp"
#include "landscape/make_landscape.hpp"
#include "observables/heterogeneity.hpp"
#include "stepper/away.hpp"
#include "stepper/contour.hpp"
#include "stepper/escape.hpp"

namespace lanescape {
namespace {

using Clock = std::chrono::steady_clock;

// Steps between looks at the outside world, and between checkpoints: about 3 ms and 2 s, hard spheres 1 ms and 1 s.
std::uint64_t steps_per_chunk(std::size_t particles) { return std::clamp<std::uint64_t>(30'000 / (particles + 1), 1, 1000); }
constexpr std::uint64_t chunks_per_checkpoint = 700;

std::unique_ptr<SoftLandscape> make_landscape(const Model& model, const Box& box, const ParticleLayout& layout, Isa isa,
                                              const KinematicMetric& metric, int threads, Precision precision) {
  std::unique_ptr<SoftLandscape> landscape =
      lanescape::make_landscape(model, box, layout, isa, {.threads = threads, .skin = path_skin, .precision = precision});
  if (metric.is_euclidean()) return landscape;
  return std::make_unique<KinematicLandscape>(std::move(landscape), metric);
}

// How much longer than soft particles a method may take without progress: avoidance makes long detours of short steps.
std::uint64_t patience_factor(PathMethod method) {
  if (method == PathMethod::avoidance) return 1000;
  return method == PathMethod::away ? 10 : 1;
}

// A pair as the search sees it, all of it checked.
struct PreparedPair {
  ParticleLayout layout;
  KinematicMetric metric;
  AlignedArray start, goal;  // kinematic coordinates
  double distance = 0.0, landscape_energy = 0.0;
};

PreparedPair prepare(const Model& model, const ConfigurationPair& pair, std::size_t number, const PathRunOptions& options,
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
  const auto landscape =
      make_landscape(model, pair.start.box, prepared.layout, isa, prepared.metric, options.threads, options.precision);
  const double highest_end = std::max(landscape->energy(prepared.start), landscape->energy(prepared.goal));
  prepared.landscape_energy = options.landscape_energy.value_or(highest_end);
  if (!(highest_end <= prepared.landscape_energy))
    throw_bad_input(fmt::format("{}: an end point has energy {}, above the landscape energy {}", where, highest_end,
                                prepared.landscape_energy));
  return prepared;
}

// One search and the time it took, as archived.
template <class Stepper>
struct Search {
  PathFinder<Stepper> finder;
  double seconds = 0.0;
  void exchange(Archive& archive) {
    finder.exchange(archive);
    archive.field("seconds", seconds);
  }
};

template <class Stepper>
void add_histograms(PathResult& result, const PathFinder<Stepper>& finder) {
  const PathStatistics& statistics = finder.statistics();
  const double share = 1.0 / static_cast<double>(statistics.participation_histogram().size());
  result.histograms.push_back({"participation_ratio", share, share, statistics.participation_histogram()});
  result.histograms.push_back(
      {"alpha_2", PathStatistics::alpha2_width - 1.0, PathStatistics::alpha2_width, statistics.alpha2_histogram()});
  if constexpr (std::is_same_v<Stepper, AvoidanceStepper>) {
    using Range = AvoidanceStatistics::Range;
    const AvoidanceStatistics& overlaps = finder.stepper().statistics();
    const auto add = [&](const char* quantity, const std::vector<std::uint64_t>& counts) {
      result.histograms.push_back({quantity, 0.0, 1.0, counts});
    };
    add("overlapping_partners", overlaps.partners());
    add("moved_particles", overlaps.moved());
    add("groups", overlaps.group_numbers());
    add("group_size_few_groups", overlaps.group_sizes(Range::few_groups));
    add("group_size_some_groups", overlaps.group_sizes(Range::some_groups));
    add("group_size_many_groups", overlaps.group_sizes(Range::many_groups));
  }
}

template <class Stepper>
PathResult summarise(const Search<Stepper>& search, const ConfigurationPair& pair, const PreparedPair& prepared, bool reversed,
                     bool interrupted) {
  const auto& finder = search.finder;
  PathResult result;
  result.outcome = interrupted ? Outcome::interrupted : finder.outcome();
  result.reason = finder.reason();
  result.reversed = reversed;
  result.length = finder.statistics().length();
  result.participation_number = finder.statistics().participation_number();
  result.direct_steps = finder.direct_steps();
  result.detour_steps = finder.detour_steps();
  result.evaluations = finder.stepper().evaluations();
  result.corrections = finder.stepper().corrections();
  result.largest_violation = finder.largest_violation();
  result.seconds = search.seconds;
  result.trace = finder.recorder().trace();
  add_histograms(result, finder);
  for (std::size_t j = 0; j < prepared.layout.size(); ++j)
    result.particle_lengths.push_back(finder.statistics().particle_lengths()[prepared.layout.slot_of(j)]);
  result.distance = prepared.distance;
  result.landscape_energy = prepared.landscape_energy;
  result.frames.push_back(reversed ? pair.finish : pair.start);
  const auto add = [&](AlignedArray q) {
    prepared.metric.to_positions(q);
    result.frames.push_back(
        {pair.start.box, pair.start.species, prepared.layout.to_user(q), pair.start.radii, pair.start.diameters});
  };
  for (const AlignedArray& q : finder.recorder().frames()) add(q);
  if (finder.outcome() == Outcome::reached)
    result.frames.push_back(reversed ? pair.start : pair.finish);
  else
    add(finder.position());
  const auto &first = result.frames.front(), &last = result.frames.back();
  for (std::size_t j = 0; j < first.size(); ++j)
    result.particle_displacements.push_back(std::hypot(last.positions[3 * j] - first.positions[3 * j],
                                                       last.positions[3 * j + 1] - first.positions[3 * j + 1],
                                                       last.positions[3 * j + 2] - first.positions[3 * j + 2]));
  result.heterogeneity =
      heterogeneity_widths(result.particle_lengths, result.particle_displacements, first.species, prepared.layout.blocks().size());
  return result;
}

// What the searches of one run share.
struct Run {
  const Model& model;
  const std::vector<ConfigurationPair>& pairs;
  std::vector<PreparedPair> prepared;
  const PathRunOptions& options;
  Isa isa;
  const CheckpointOptions& checkpoint;
  RunMonitor& monitor;
  std::vector<std::atomic<double>> covered;  // of the way, 0 ... 1 per pair

  Run(const Model& m, const std::vector<ConfigurationPair>& p, const PathRunOptions& o, Isa i, const CheckpointOptions& c,
      RunMonitor& w)
      : model(m), pairs(p), options(o), isa(i), checkpoint(c), monitor(w), covered(p.size()) {
    for (std::size_t k = 0; k < pairs.size(); ++k) prepared.push_back(prepare(model, pairs[k], k, options, isa));
  }

  // One level of threads: many paths at once, or the evaluations of one.
  int threads_per_path() const { return pairs.size() == 1 ? options.threads : 1; }

  void report(std::size_t number, double part) {
    covered[number] = part;
    double sum = 0.0;
    for (const auto& c : covered) sum += c;
    monitor.progress("paths", sum, static_cast<double>(pairs.size()));
  }
};

// What a stepper walks on, and the stepper.
template <class Stepper>
struct Walk {
  std::unique_ptr<SoftLandscape> landscape;
  Stepper stepper;

  Walk(const Run& run, const ConfigurationPair& pair, const PreparedPair& prepared, const AlignedArray&)
      : landscape(make_landscape(run.model, pair.start.box, prepared.layout, run.isa, prepared.metric, run.threads_per_path(),
                                 run.options.precision)),
        stepper(*landscape, prepared.landscape_energy, options(run)) {}
  static typename Stepper::Options options(const Run& run) {
    typename Stepper::Options options;
    options.direct_step = run.options.step_length();
    return options;
  }
  double violation(const AlignedArray&) { return 0.0; }  // the finder knows it of every point
};

struct HardWalk {
  std::unique_ptr<HardSphereLandscape> landscape;

  HardWalk(const Run& run, const ConfigurationPair& pair, const PreparedPair& prepared)
      : landscape(std::make_unique<HardSphereLandscape>(pair.start.box, prepared.layout, pair.start.radii, run.isa)) {}
  double violation(const AlignedArray& position) { return landscape->violation(position); }
};

template <>
struct Walk<AvoidanceStepper> : HardWalk {
  AvoidanceStepper stepper;

  Walk(const Run& run, const ConfigurationPair& pair, const PreparedPair& prepared, const AlignedArray&)
      : HardWalk(run, pair, prepared),
        stepper(*landscape, {.direct_step = run.options.step_length(),
                             .avoidance_step = run.options.avoidance_step,
                             .potential = run.options.fictitious}) {}
};

template <>
struct Walk<AwayStepper> : HardWalk {
  AwayStepper stepper;

  Walk(const Run& run, const ConfigurationPair& pair, const PreparedPair& prepared, const AlignedArray& goal)
      : HardWalk(run, pair, prepared), stepper(pair.start.box, prepared.layout, pair.start.radii, *landscape, goal, {}) {}
};

template <class Stepper>
PathResult search_one_way(Run& run, std::size_t number, bool reversed) {
  const ConfigurationPair& pair = run.pairs[number];
  const PreparedPair& prepared = run.prepared[number];
  const AlignedArray &start = reversed ? prepared.goal : prepared.start, &goal = reversed ? prepared.start : prepared.goal;
  Walk<Stepper> walk(run, pair, prepared, goal);
  FinderOptions finder_options = run.options.finder;
  finder_options.patience *= patience_factor(run.options.method);
  Search<Stepper> search{
      PathFinder<Stepper>(walk.landscape->algebra(), std::move(walk.stepper), start, goal, prepared.layout.size(), finder_options)};
  const auto file = run.checkpoint.folder / fmt::format("path-{:04}{}.h5", number + 1, reversed ? "-reverse" : "");
  if (run.checkpoint.enabled() && run.checkpoint.resume) load_checkpoint(file, search);

  auto& finder = search.finder;
  const std::uint64_t chunk = steps_per_chunk(prepared.layout.size());
  auto last = Clock::now();
  bool interrupted = false;
  const bool was_running = finder.outcome() == Outcome::running;
  while (finder.outcome() == Outcome::running && !interrupted) {
    finder.advance(chunk - finder.steps() % chunk);
    const auto now = Clock::now();
    search.seconds += std::chrono::duration<double>(now - last).count();
    last = now;
    const double part = 1.0 - finder.distance_left() / prepared.distance;
    run.report(number, run.options.reverse ? 0.5 * (part + (reversed ? 1.0 : 0.0)) : part);
    interrupted = finder.outcome() == Outcome::running && run.monitor.stop_requested();
    const bool due = finder.steps() % (chunk * chunks_per_checkpoint) == 0;
    if (run.checkpoint.enabled() && (due || interrupted)) save_checkpoint(file, search);
  }
  if (run.checkpoint.enabled() && was_running && !interrupted) save_checkpoint(file, search);

  PathResult result = summarise(search, pair, prepared, reversed, interrupted);
  // Hard spheres: what the lists may not have seen, once more and without them.
  for (const AlignedArray& frame : finder.recorder().frames())
    result.largest_violation = std::max(result.largest_violation, walk.violation(frame));
  return result;
}

template <class Stepper>
PathResult search_pair(Run& run, std::size_t number) {
  PathResult forward = search_one_way<Stepper>(run, number, false);
  if (!run.options.reverse || forward.outcome == Outcome::interrupted) return forward;
  PathResult backward = search_one_way<Stepper>(run, number, true);
  if (backward.outcome == Outcome::interrupted) return backward;
  const bool keep_backward =
      backward.outcome == Outcome::reached && (forward.outcome != Outcome::reached || backward.length < forward.length);
  return keep_backward ? backward : forward;
}

PathResult search_pair(Run& run, std::size_t number) {
  switch (run.options.method) {
    case PathMethod::contour:
      return search_pair<ContourStepper>(run, number);
    case PathMethod::escape:
      return search_pair<EscapeStepper>(run, number);
    case PathMethod::avoidance:
      return search_pair<AvoidanceStepper>(run, number);
    case PathMethod::away:
      return search_pair<AwayStepper>(run, number);
  }
  throw Error(ErrorCode::internal, "no such method");
}

}  // namespace

PathMethod parse_path_method(std::string_view word) {
  for (const PathMethod method : {PathMethod::contour, PathMethod::escape, PathMethod::avoidance, PathMethod::away})
    if (word == to_string(method)) return method;
  throw_bad_input(
      fmt::format("unknown method '{}': allowed are contour, escape (soft particles), avoidance, away (hard spheres)", word));
}

const char* to_string(PathMethod method) {
  switch (method) {
    case PathMethod::contour:
      return "contour";
    case PathMethod::escape:
      return "escape";
    case PathMethod::avoidance:
      return "avoidance";
    case PathMethod::away:
      return "away";
  }
  return "";
}

bool is_hard(PathMethod method) { return method == PathMethod::avoidance || method == PathMethod::away; }

void check_method(PathMethod method, const Model& model) {
  if (is_hard(method) == is_hard(model)) return;
  throw_bad_input(
      fmt::format("method {} is not for model {}: contour and escape are for soft particles, avoidance and away for hard spheres",
                  to_string(method), mixture_of(model).name));
}

double StepHistogram::mean() const {
  double sum = 0.0, weight = 0.0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    sum += static_cast<double>(counts[k]) * (first + static_cast<double>(k) * width);
    weight += static_cast<double>(counts[k]);
  }
  return weight > 0.0 ? sum / weight : 0.0;
}

void check_end_points(const ConfigurationPair& pair, const Model& model, const std::string& where) {
  if (!(pair.start.box == pair.finish.box)) throw_bad_input(where + ": the two end points have different boxes");
  if (pair.start.species != pair.finish.species)
    throw_bad_input(where + ": the two end points differ in composition or in the order of their particles");
  if (pair.start.radii != pair.finish.radii) throw_bad_input(where + ": the two end points have different radii");
  if (pair.start.diameters != pair.finish.diameters) throw_bad_input(where + ": the two end points have different diameters");
  if (pair.start.positions == pair.finish.positions) throw_bad_input(where + ": the two end points coincide");
  for (const Configuration* end : {&pair.start, &pair.finish}) {
    try {
      if (is_hard(model))
        check_no_overlap(*end, kernel_table(available_isas().front()));
      else
        check_soft_separations(*end, model);
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{}, {} end: {}", where, end == &pair.start ? "first" : "last", error.what()));
    }
  }
}

double PathRunOptions::step_length() const { return direct_step.value_or(is_hard(method) ? 1e-2 : 1e-3); }

void PathRunOptions::check() const {
  if (!(step_length() > 0.0 && step_length() <= 1.0))
    throw_bad_input(fmt::format("step {} is not allowed: above 0 and at most 1", step_length()));
  if (!(avoidance_step > 0.0 && avoidance_step <= 0.1))
    throw_bad_input(fmt::format("avoidance step {} is not allowed: above 0 and at most 0.1", avoidance_step));
  if (landscape_energy && is_hard(method)) throw_bad_input("hard spheres have no landscape energy: without it only");
  if (landscape_energy && !std::isfinite(*landscape_energy))
    throw_bad_input(fmt::format("landscape energy {} is not allowed: it must be finite", *landscape_energy));
  if (finder.max_steps == 0) throw_bad_input("the step limit must be at least 1");
  if (finder.frames > 100'000) throw_bad_input(fmt::format("{} frames are not allowed: at most 100000", finder.frames));
}

std::vector<PathResult> run_paths(const Model& model, const std::vector<ConfigurationPair>& pairs, const PathRunOptions& options,
                                  Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  options.check();
  if (pairs.empty()) throw_bad_input("no pair of end points was given");
  check_method(options.method, model);

  Run run(model, pairs, options, isa, checkpoint, monitor);
  std::vector<PathResult> results(pairs.size());
  std::vector<std::exception_ptr> failures(pairs.size());
  const auto one = [&](std::size_t k) noexcept {
    try {
      results[k] = search_pair(run, k);
    } catch (...) {
      failures[k] = std::current_exception();
    }
  };
  if (options.threads > 1 && pairs.size() > 1) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(options.threads)
    for (std::size_t k = 0; k < pairs.size(); ++k) one(k);
  } else {
    for (std::size_t k = 0; k < pairs.size(); ++k) one(k);
  }
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
  return results;
}

}  // namespace lanescape
