#include "run/end_point_run.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "interaction/lennard_jones.hpp"
#include "landscape/lennard_jones_landscape.hpp"

namespace lanescape {
namespace {

constexpr std::size_t trace_rows = 4096, trace_columns = 5, rdf_bins = 200;
constexpr std::uint64_t rdf_interval = 1000;  // [steps]

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
    state.trace.add({static_cast<double>(verlet.steps()), verlet.temperature(), potential / n,
                     (potential + verlet.kinetic_energy()) / n, static_cast<double>(state.generator.phase())});
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

  using Clock = std::chrono::steady_clock;
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
      state.generator.phase(),  interrupted, {}, state.pair_seconds, state.generator.mean_temperature(), state.seconds, state.trace,
      state.radial_distribution};
  for (const EndPointPair& pair : state.generator.pairs())
    result.pairs.push_back({{start.box, start.species, layout.to_user(pair.start)},
                            {start.box, start.species, layout.to_user(pair.finish)},
                            pair.distance,
                            pair.steps});
  return result;
}

}  // namespace lanescape
