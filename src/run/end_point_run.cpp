#include "run/end_point_run.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <string_view>

#include "interaction/sphere/check_overlap.hpp"
#include "interaction/state/state_mixture.hpp"
#include "landscape/make_landscape.hpp"

namespace lanescape {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t trace_rows = 4096, rdf_bins = 200;

// What a protocol of either family runs with, as archived.
template <class Generator>
struct EndPointState {
  Generator generator;
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

struct SoftState : EndPointState<EndPointGenerator> {
  static constexpr std::size_t trace_columns = 6;
  static constexpr std::uint64_t chunks_per_checkpoint = 100;

  std::uint64_t chunk = 1;  // steps between looks at the clock and the outside world, about 10 ms on one core
  std::size_t particles = 0;

  void step() {
    generator.step();
    VelocityVerlet& verlet = generator.verlet();
    const auto steps = static_cast<double>(verlet.steps());
    if (trace.wants(verlet.steps())) {
      const double n = static_cast<double>(particles), potential = verlet.potential_energy();
      trace.add({steps, steps * verlet.time_step(), verlet.temperature(), potential / n, (potential + verlet.kinetic_energy()) / n,
                 static_cast<double>(generator.phase())});
    }
    if (generator.equilibrated() && verlet.steps() % rdf_interval() == 0) radial_distribution.add(verlet.position());
  }
  // A sample of a large system says as much as many of a small one, and takes as long as a hundred steps.
  std::uint64_t rdf_interval() const { return 1000 * std::max<std::uint64_t>(1, particles / 5000); }
  bool at_chunk_end() const { return generator.verlet().steps() % chunk == 0; }
  void end_chunk() {}
  bool saveable() const { return true; }
  bool checkpoint_due() const { return generator.verlet().steps() % (chunk * chunks_per_checkpoint) == 0; }
};

struct HardState : EndPointState<HardEndPointGenerator> {
  static constexpr std::size_t trace_columns = 5;
  static constexpr std::uint64_t resyncs_per_checkpoint = 50;  // about 1 s, large systems some

  const ParticleLayout* layout = nullptr;
  double virial = 0.0, time = 0.0;  // at the end of the last chunk

  void step() {
    generator.step();
    // A sample takes N^2/2 distances, of a large system about 1000 N; a collision some hundred.
    const std::uint64_t n = layout->size(), interval = std::max<std::uint64_t>(2000, std::min(n * n / 4, 1000 * n));
    if (generator.equilibrated() && generator.dynamics().collisions() % interval == 0)
      radial_distribution.add(layout->to_slots(generator.dynamics().positions()));
  }
  bool at_chunk_end() const { return generator.dynamics().at_resync(); }
  // Traces what happened since the last resynchronisation.
  void end_chunk() {
    const EventDriven& dynamics = generator.dynamics();
    const double rate =
        2.0 * static_cast<double>(dynamics.resync_interval()) / static_cast<double>(dynamics.size()) / (dynamics.time() - time);
    if (trace.wants(dynamics.collisions() / dynamics.resync_interval()))
      trace.add({static_cast<double>(dynamics.collisions()), dynamics.time(), dynamics.compressibility(virial, time), rate,
                 static_cast<double>(generator.phase())});
    virial = dynamics.virial();
    time = dynamics.time();
  }
  // Only a resynchronised state goes on with the same bits; one comes every few hundredths of a second.
  bool saveable() const { return generator.dynamics().at_resync(); }
  bool checkpoint_due() const {
    return generator.dynamics().collisions() % (resyncs_per_checkpoint * generator.dynamics().resync_interval()) == 0;
  }
  void exchange(Archive& archive) {
    EndPointState::exchange(archive);
    archive.field("trace_virial", virial);
    archive.field("trace_time", time);
  }
};

template <class Generator>
void report(const Generator& generator, double distance, RunMonitor& monitor) {
  const std::string_view phase = Generator::name(generator.phase());
  if (generator.phase() == Generator::Phase::pair)
    monitor.progress(phase, std::min(generator.distance_so_far(), distance), distance);
  else
    monitor.progress(phase, static_cast<double>(generator.phase_done()), static_cast<double>(generator.phase_total()));
}

// Runs a protocol to its end, or until the monitor asks to stop: whether it did.
template <class State>
bool run_protocol(State& state, double distance, const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  const auto file = checkpoint.folder / "endpoints.h5";
  if (checkpoint.enabled() && checkpoint.resume) load_checkpoint(file, state);
  auto& generator = state.generator;
  const bool was_ended = generator.ended();
  auto last = Clock::now();
  bool interrupted = false;
  while (!generator.ended() && !interrupted) {
    // To the end of the chunk, or of the pair, whose time is wanted.
    const std::size_t pairs_before = generator.pairs().size();
    do state.step();
    while (generator.pairs().size() == pairs_before && !generator.ended() && !state.at_chunk_end());
    if (state.at_chunk_end()) state.end_chunk();
    const auto now = Clock::now();
    state.seconds += std::chrono::duration<double>(now - last).count();
    last = now;
    if (generator.pairs().size() > pairs_before)
      state.pair_seconds.push_back(state.seconds - std::accumulate(state.pair_seconds.begin(), state.pair_seconds.end(), 0.0));
    report(generator, distance, monitor);
    if (!state.saveable()) continue;
    interrupted = !generator.ended() && monitor.stop_requested();
    if (checkpoint.enabled() && (state.checkpoint_due() || interrupted)) save_checkpoint(file, state);
  }
  if (checkpoint.enabled() && generator.ended() && !was_ended && state.saveable()) save_checkpoint(file, state);
  return interrupted;
}

template <class State>
EndPointRunResult summarise(const State& state, bool interrupted, const Configuration& start, const ParticleLayout& layout,
                            std::vector<std::string> trace_columns) {
  using Generator = decltype(state.generator);
  using Phase = typename Generator::Phase;
  EndPointRunResult result{.done = state.generator.phase() == Phase::done,
                           .interrupted = interrupted,
                           .ended_as = Generator::name(state.generator.phase()),
                           .pair_seconds = state.pair_seconds,
                           .seconds = state.seconds,
                           .trace_columns = std::move(trace_columns),
                           .trace = state.trace,
                           .phase_names = {},
                           .radial_distribution = state.radial_distribution};
  for (std::uint64_t phase = 0; *Generator::name(static_cast<Phase>(phase)) != 0; ++phase)
    result.phase_names.push_back(Generator::name(static_cast<Phase>(phase)));
  for (const EndPointPair& pair : state.generator.pairs())
    result.pairs.push_back({.start = {start.box, start.species, layout.to_user(pair.start), start.radii, start.diameters},
                            .finish = {start.box, start.species, layout.to_user(pair.finish), start.radii, start.diameters},
                            .distance = pair.distance,
                            .steps = pair.steps,
                            .time = pair.time});
  return result;
}

}  // namespace

EndPointRunResult run_end_points(const Model& model, const Configuration& start, const EndPointOptions& options, Isa isa,
                                 const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  check_soft_separations(start, model);
  const Mixture& mixture = mixture_of(model);
  const ParticleLayout layout = ParticleLayout::in_space_order(start, mixture.species.size());
  const auto landscape =
      make_landscape(model, start.box, layout, isa, {.threads = options.threads, .precision = options.precision});
  SoftState state{{EndPointGenerator(*landscape, mixture, layout, layout.to_slots(start.positions), options),
                   DecimatedTrace(SoftState::trace_columns, trace_rows), RadialDistribution(start.box, layout, rdf_bins)},
                  std::clamp<std::uint64_t>(150'000 / (layout.size() + 1), 1, 1000),
                  layout.size()};
  const bool interrupted = run_protocol(state, options.distance, checkpoint, monitor);
  EndPointRunResult result =
      summarise(state, interrupted, start, layout,
                {"step", "time", "temperature", "potential_energy_per_particle", "energy_per_particle", "phase"});
  result.temperature = state.generator.mean_temperature();
  return result;
}

EndPointRunResult run_hard_end_points(const HardSphereModel& model, const Configuration& start, const HardEndPointOptions& options,
                                      Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  check_no_overlap(start, kernel_table(isa));
  const ParticleLayout layout = ParticleLayout::in_space_order(start, model.species.size());
  HardState state{{HardEndPointGenerator(model, layout, start, options, isa), DecimatedTrace(HardState::trace_columns, trace_rows),
                   RadialDistribution(start.box, layout, rdf_bins)},
                  &layout};
  const bool interrupted = run_protocol(state, options.distance, checkpoint, monitor);
  EndPointRunResult result =
      summarise(state, interrupted, start, layout, {"collisions", "time", "compressibility", "collision_rate", "phase"});
  result.compressibility = state.generator.compressibility();
  return result;
}

}  // namespace lanescape
