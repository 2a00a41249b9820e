#include "run/end_point_run.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "interaction/hard_sphere.hpp"
#include "interaction/lennard_jones.hpp"
#include "landscape/lennard_jones_landscape.hpp"

namespace lanescape {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t trace_rows = 4096, trace_columns = 6, hard_trace_columns = 5, rdf_bins = 200;
constexpr std::uint64_t resyncs_per_checkpoint = 50;  // about 1 s, large systems some
constexpr std::uint64_t rdf_interval = 1000;          // [steps]

// Steps between looks at the clock and the outside world, and between checkpoints: about 10 ms and 1 s on one core.
std::uint64_t steps_per_chunk(std::size_t particles) { return std::clamp<std::uint64_t>(150'000 / (particles + 1), 1, 1000); }
constexpr std::uint64_t chunks_per_checkpoint = 100;

struct EndPointState {
  EndPointGenerator generator;
  DecimatedTrace trace;
  RadialDistribution radial_distribution;
  double seconds = 0.0;
  std::vector<double> pair_seconds{};

  void exchange(Archive& archive) {
    generator.exchange(archive);
    trace.exchange(archive);
    radial_distribution.exchange(archive);
    archive.field("seconds", seconds);
    archive.field("pair_seconds", pair_seconds);
  }
};

void one_step(EndPointState& state, std::size_t particles) {
  state.generator.step();
  const VelocityVerlet& verlet = state.generator.verlet();
  if (state.trace.wants(verlet.steps())) {
    const double n = static_cast<double>(particles), potential = verlet.potential_energy();
    state.trace.add({static_cast<double>(verlet.steps()), static_cast<double>(verlet.steps()) * verlet.time_step(),
                     verlet.temperature(), potential / n, (potential + verlet.kinetic_energy()) / n,
                     static_cast<double>(state.generator.phase())});
  }
  if (state.generator.equilibrated() && verlet.steps() % rdf_interval == 0) state.radial_distribution.add(verlet.position());
}

void report(const EndPointGenerator& generator, const EndPointOptions& options, RunMonitor& monitor) {
  if (generator.phase() == EndPointGenerator::Phase::pair)
    monitor.progress(EndPointGenerator::name(generator.phase()), std::min(generator.distance_so_far(), options.distance),
                     options.distance);
  else
    monitor.progress(EndPointGenerator::name(generator.phase()), static_cast<double>(generator.phase_done()),
                     static_cast<double>(generator.phase_total()));
}

template <class Generator>
std::vector<std::string> phase_names() {
  std::vector<std::string> names;
  for (std::uint64_t phase = 0; *Generator::name(static_cast<typename Generator::Phase>(phase)) != 0; ++phase)
    names.push_back(Generator::name(static_cast<typename Generator::Phase>(phase)));
  return names;
}

void add_pairs(EndPointRunResult& result, const std::vector<EndPointPair>& pairs, const Configuration& start,
               const ParticleLayout& layout) {
  for (const EndPointPair& pair : pairs)
    result.pairs.push_back({{start.box, start.species, layout.to_user(pair.start), start.radii},
                            {start.box, start.species, layout.to_user(pair.finish), start.radii},
                            pair.distance,
                            pair.steps,
                            pair.time});
}

}  // namespace

EndPointRunResult run_end_points(const LennardJonesModel& model, const Configuration& start, const EndPointOptions& options,
                                 Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  check_separations(start, model);
  const ParticleLayout layout(start.species, model.species.size());
  LennardJonesLandscape landscape(model, start.box, layout, isa);
  EndPointState state{EndPointGenerator(landscape, model, layout, layout.to_slots(start.positions), options),
                      DecimatedTrace(trace_columns, trace_rows), RadialDistribution(start.box, layout, rdf_bins)};
  const auto file = checkpoint.folder / "endpoints.h5";
  if (checkpoint.enabled() && checkpoint.resume) load_checkpoint(file, state);

  auto last = Clock::now();
  const std::uint64_t chunk = steps_per_chunk(layout.size());
  bool interrupted = false;
  const bool was_ended = state.generator.ended();
  while (!state.generator.ended() && !interrupted) {
    // To the end of the chunk, or of the pair, whose time is wanted.
    const std::size_t pairs_before = state.generator.pairs().size();
    do one_step(state, layout.size());
    while (state.generator.pairs().size() == pairs_before && !state.generator.ended() &&
           state.generator.verlet().steps() % chunk != 0);
    const auto now = Clock::now();
    state.seconds += std::chrono::duration<double>(now - last).count();
    last = now;
    if (state.generator.pairs().size() > pairs_before)
      state.pair_seconds.push_back(state.seconds - std::accumulate(state.pair_seconds.begin(), state.pair_seconds.end(), 0.0));
    report(state.generator, options, monitor);
    interrupted = !state.generator.ended() && monitor.stop_requested();
    const bool due = state.generator.verlet().steps() % (chunk * chunks_per_checkpoint) == 0;
    if (checkpoint.enabled() && (due || interrupted)) save_checkpoint(file, state);
  }
  if (checkpoint.enabled() && state.generator.ended() && !was_ended) save_checkpoint(file, state);

  EndPointRunResult result{
      .done = state.generator.phase() == EndPointGenerator::Phase::done,
      .interrupted = interrupted,
      .ended_as = EndPointGenerator::name(state.generator.phase()),
      .pair_seconds = state.pair_seconds,
      .temperature = state.generator.mean_temperature(),
      .seconds = state.seconds,
      .trace_columns = {"step", "time", "temperature", "potential_energy_per_particle", "energy_per_particle", "phase"},
      .trace = state.trace,
      .phase_names = phase_names<EndPointGenerator>(),
      .radial_distribution = state.radial_distribution};
  add_pairs(result, state.generator.pairs(), start, layout);
  return result;
}

namespace {

struct HardEndPointState {
  HardEndPointGenerator generator;
  DecimatedTrace trace;
  RadialDistribution radial_distribution;
  double virial = 0.0, time = 0.0;  // at the last row of the trace
  double seconds = 0.0;
  std::vector<double> pair_seconds{};

  void exchange(Archive& archive) {
    generator.exchange(archive);
    trace.exchange(archive);
    radial_distribution.exchange(archive);
    archive.field("trace_virial", virial);
    archive.field("trace_time", time);
    archive.field("seconds", seconds);
    archive.field("pair_seconds", pair_seconds);
  }
};

void report(const HardEndPointGenerator& generator, const HardEndPointOptions& options, RunMonitor& monitor) {
  if (generator.phase() == HardEndPointGenerator::Phase::pair)
    monitor.progress(HardEndPointGenerator::name(generator.phase()), std::min(generator.distance_so_far(), options.distance),
                     options.distance);
  else
    monitor.progress(HardEndPointGenerator::name(generator.phase()), static_cast<double>(generator.phase_done()),
                     static_cast<double>(generator.phase_total()));
}

// At every resynchronisation: what happened since the last.
void trace_interval(HardEndPointState& state) {
  const EventDriven& dynamics = state.generator.dynamics();
  const std::uint64_t interval = dynamics.collisions() / dynamics.resync_interval();
  const double rate =
      2.0 * static_cast<double>(dynamics.resync_interval()) / static_cast<double>(dynamics.size()) / (dynamics.time() - state.time);
  if (state.trace.wants(interval))
    state.trace.add({static_cast<double>(dynamics.collisions()), dynamics.time(),
                     dynamics.compressibility(state.virial, state.time), rate, static_cast<double>(state.generator.phase())});
  state.virial = dynamics.virial();
  state.time = dynamics.time();
}

}  // namespace

EndPointRunResult run_hard_end_points(const HardSphereModel& model, const Configuration& start, const HardEndPointOptions& options,
                                      Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  check_no_overlap(start, kernel_table(isa));
  const ParticleLayout layout(start.species, model.species.size());
  HardEndPointState state{HardEndPointGenerator(model, layout, start, options, isa), DecimatedTrace(hard_trace_columns, trace_rows),
                          RadialDistribution(start.box, layout, rdf_bins)};
  const auto file = checkpoint.folder / "endpoints.h5";
  if (checkpoint.enabled() && checkpoint.resume) load_checkpoint(file, state);

  // A sample takes N^2/2 distances, a collision some hundred.
  const std::uint64_t rdf_interval_here = std::max<std::uint64_t>(2000, layout.size() * layout.size() / 4);
  auto last = Clock::now();
  bool interrupted = false;
  while (!state.generator.ended() && !interrupted) {
    const std::size_t pairs_before = state.generator.pairs().size();
    const EventDriven& dynamics = state.generator.dynamics();
    do {
      state.generator.step();
      if (state.generator.equilibrated() && dynamics.collisions() % rdf_interval_here == 0)
        state.radial_distribution.add(layout.to_slots(dynamics.positions()));
    } while (!state.generator.ended() && state.generator.pairs().size() == pairs_before && !dynamics.at_resync());
    if (dynamics.at_resync()) trace_interval(state);
    const auto now = Clock::now();
    state.seconds += std::chrono::duration<double>(now - last).count();
    last = now;
    if (state.generator.pairs().size() > pairs_before)
      state.pair_seconds.push_back(state.seconds - std::accumulate(state.pair_seconds.begin(), state.pair_seconds.end(), 0.0));
    report(state.generator, options, monitor);
    // Only a resynchronised state goes on with the same bits; one comes every few hundredths of a second.
    if (!dynamics.at_resync()) continue;
    interrupted = !state.generator.ended() && monitor.stop_requested();
    const bool due = dynamics.collisions() % (resyncs_per_checkpoint * dynamics.resync_interval()) == 0;
    if (checkpoint.enabled() && (due || interrupted)) save_checkpoint(file, state);
  }

  EndPointRunResult result{.done = state.generator.phase() == HardEndPointGenerator::Phase::done,
                           .interrupted = interrupted,
                           .ended_as = HardEndPointGenerator::name(state.generator.phase()),
                           .pair_seconds = state.pair_seconds,
                           .compressibility = state.generator.compressibility(),
                           .seconds = state.seconds,
                           .trace_columns = {"collisions", "time", "compressibility", "collision_rate", "phase"},
                           .trace = state.trace,
                           .phase_names = phase_names<HardEndPointGenerator>(),
                           .radial_distribution = state.radial_distribution};
  add_pairs(result, state.generator.pairs(), start, layout);
  return result;
}

}  // namespace lanescape
