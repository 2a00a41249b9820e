#include "run/end_point_run.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/coordinate_checks.hpp"
#include "interaction/sphere/check_overlap.hpp"
#include "interaction/state/state_mixture.hpp"
#include "landscape/make_landscape.hpp"

namespace lanescape {
namespace {

constexpr const char* archive_name = "endpoints.h5";
constexpr std::size_t trace_rows = 4096, rdf_bins = 200;

// The protocol of either family, in chunks.
template <class EndPoints>
class EndPointWork : public ResumableWork {
 public:
  using Generator = EndPoints;

  // `arguments` are the generator's.
  template <class... Arguments>
  EndPointWork(double distance, std::size_t trace_columns, RadialDistribution radial_distribution, Arguments&&... arguments)
      : generator_(std::forward<Arguments>(arguments)...),
        trace_(trace_columns, trace_rows),
        radial_distribution_(std::move(radial_distribution)),
        distance_(distance) {}

  bool finished() const override { return generator_.ended(); }
  void advance(RunMonitor& monitor) override {
    do {
      const std::size_t pairs_before = generator_.pairs().size();
      step();
      if (generator_.pairs().size() > pairs_before) pair_seconds_.push_back(seconds_now() - pair_began_);
      if (generator_.phase() == Generator::Phase::pair && generator_.phase_done() == 0) pair_began_ = seconds_now();
    } while (!generator_.ended() && !at_chunk_end());
    if (at_chunk_end()) end_chunk();
    const std::string_view phase = Generator::name(generator_.phase());
    if (generator_.phase() == Generator::Phase::pair)
      monitor.progress(phase, std::min(generator_.distance_so_far(), distance_), distance_);
    else
      monitor.progress(phase, static_cast<double>(generator_.phase_done()), static_cast<double>(generator_.phase_total()));
  }
  void exchange(Archive& archive) override {
    generator_.exchange(archive);
    trace_.exchange(archive);
    radial_distribution_.exchange(archive);
    archive.field("pair_seconds", pair_seconds_);
    archive.field("pair_began", pair_began_);
  }

  const Generator& generator() const { return generator_; }
  const DecimatedTrace& trace() const { return trace_; }
  const RadialDistribution& radial_distribution() const { return radial_distribution_; }
  const std::vector<double>& pair_seconds() const { return pair_seconds_; }

 protected:
  virtual void step() = 0;
  virtual bool at_chunk_end() const = 0;
  virtual void end_chunk() {}

  Generator generator_;
  DecimatedTrace trace_;
  RadialDistribution radial_distribution_;

 private:
  double seconds_now() {
    clock_.lap();
    return clock_.seconds();
  }

  double distance_;
  double pair_began_ = 0.0;  // on the clock, which earlier parts of a resumed run have advanced too [s]
  std::vector<double> pair_seconds_;
};

RadialDistribution radial_distribution_of(const Configuration& start, const ParticleLayout& layout, double length_unit) {
  return {start.box, layout, rdf_bins, RadialDistribution::default_range(start.box, layout.size(), length_unit)};
}

class SoftEndPointWork final : public EndPointWork<EndPointGenerator> {
 public:
  SoftEndPointWork(SoftLandscape& landscape, const Mixture& mixture, const ParticleLayout& layout, const Configuration& start,
                   const EndPointOptions& options)
      : EndPointWork(options.distance, 6, radial_distribution_of(start, layout, options.length_unit), landscape, mixture, layout,
                     layout.to_slots(start.positions), options),
        chunk_(std::clamp<std::uint64_t>(150'000 / (layout.size() + 1), 1, 1000)),
        particles_(layout.size()) {}

  bool save_due() const override { return generator_.verlet().steps() % (chunk_ * chunks_per_checkpoint) == 0; }

 protected:
  void step() override {
    generator_.step();
    VelocityVerlet& verlet = generator_.verlet();
    const auto steps = static_cast<double>(verlet.steps());
    if (trace_.wants(verlet.steps())) {
      const double n = static_cast<double>(particles_), potential = verlet.potential_energy();
      trace_.add({steps, steps * verlet.time_step(), verlet.temperature(), potential / n, (potential + verlet.kinetic_energy()) / n,
                  static_cast<double>(generator_.phase())});
    }
    if (generator_.equilibrated() && verlet.steps() % rdf_interval() == 0) radial_distribution_.add(verlet.position());
  }
  bool at_chunk_end() const override { return generator_.verlet().steps() % chunk_ == 0; }

 private:
  static constexpr std::uint64_t chunks_per_checkpoint = 100;

  // One sample of a large system is worth many of a small one, and costs as much as a hundred steps.
  std::uint64_t rdf_interval() const { return 1000 * std::max<std::uint64_t>(1, particles_ / 5000); }

  std::uint64_t chunk_;  // steps, about 10 ms on one core
  std::size_t particles_;
};

// A chunk of hard spheres ends at a resynchronisation, a few hundredths of a second after the last one. Only such a state continues
// with the same bits.
class HardEndPointWork final : public EndPointWork<HardEndPointGenerator> {
 public:
  HardEndPointWork(const HardSphereModel& model, const ParticleLayout& layout, const Configuration& start,
                   const HardEndPointOptions& options, Isa isa)
      : EndPointWork(options.distance, 5, radial_distribution_of(start, layout, model.length_unit()), model, layout, start, options,
                     isa),
        layout_(&layout) {}

  bool saveable() const override { return generator_.dynamics().at_resync(); }
  bool save_due() const override {
    return generator_.dynamics().collisions() % (resyncs_per_checkpoint * generator_.dynamics().resync_interval()) == 0;
  }
  void exchange(Archive& archive) override {
    EndPointWork::exchange(archive);
    archive.field("trace_virial", virial_);
    archive.field("trace_time", time_);
  }

 protected:
  void step() override {
    generator_.step();
    // A sample costs N^2/2 distances, in large systems about 1000 N; a collision costs about a hundred.
    const std::uint64_t n = layout_->size(), interval = std::max<std::uint64_t>(2000, std::min(n * n / 4, 1000 * n));
    if (generator_.equilibrated() && generator_.dynamics().collisions() % interval == 0)
      radial_distribution_.add(layout_->to_slots(generator_.dynamics().positions()));
  }
  bool at_chunk_end() const override { return generator_.dynamics().at_resync(); }
  // Traces what happened since the last resynchronisation.
  void end_chunk() override {
    const EventDriven& dynamics = generator_.dynamics();
    const double rate =
        2.0 * static_cast<double>(dynamics.resync_interval()) / static_cast<double>(dynamics.size()) / (dynamics.time() - time_);
    if (trace_.wants(dynamics.collisions() / dynamics.resync_interval()))
      trace_.add({static_cast<double>(dynamics.collisions()), dynamics.time(), dynamics.compressibility(virial_, time_), rate,
                  static_cast<double>(generator_.phase())});
    virial_ = dynamics.virial();
    time_ = dynamics.time();
  }

 private:
  static constexpr std::uint64_t resyncs_per_checkpoint = 50;  // about 1 s; several seconds in large systems

  const ParticleLayout* layout_;
  double virial_ = 0.0, time_ = 0.0;  // at the end of the last chunk
};

template <class Generator>
EndPointRunResult summarise(const EndPointWork<Generator>& work, bool interrupted, const Configuration& start,
                            const ParticleLayout& layout, std::vector<std::string> trace_columns) {
  using Phase = typename Generator::Phase;
  EndPointRunResult result{.done = work.generator().phase() == Phase::done,
                           .interrupted = interrupted,
                           .ended_as = Generator::name(work.generator().phase()),
                           .pair_seconds = work.pair_seconds(),
                           .seconds = work.clock().seconds(),
                           .trace_columns = std::move(trace_columns),
                           .trace = work.trace(),
                           .phase_names = {},
                           .radial_distribution = work.radial_distribution()};
  for (std::uint64_t phase = 0; *Generator::name(static_cast<Phase>(phase)) != 0; ++phase)
    result.phase_names.push_back(Generator::name(static_cast<Phase>(phase)));
  for (const EndPointPair& pair : work.generator().pairs())
    result.pairs.push_back({.start = {start.box, start.species, layout.to_user(pair.start), start.radii, start.diameters},
                            .finish = {start.box, start.species, layout.to_user(pair.finish), start.radii, start.diameters},
                            .distance = pair.distance,
                            .steps = pair.steps,
                            .time = pair.time});
  return result;
}

}  // namespace

EndPointRunResult run_end_points(const AnyModel& model, const Configuration& start, const EndPointOptions& options, Isa isa,
                                 const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  check_periodic(start.box, "end points");
  check_soft_separations(start, model);
  const Mixture& mixture = mixture_of(model);
  const ParticleLayout layout = ParticleLayout::in_space_order(start, mixture.species.size());
  const auto landscape =
      make_landscape(model, start.box, layout, isa, {.threads = options.threads, .precision = options.precision});
  SoftEndPointWork work(*landscape, mixture, layout, start, options);
  const bool interrupted = run_to_end(work, archive_name, checkpoint, monitor);
  EndPointRunResult result =
      summarise(work, interrupted, start, layout,
                {"step", "time", "temperature", "potential_energy_per_particle", "energy_per_particle", "phase"});
  result.temperature = work.generator().mean_temperature();
  for (ConfigurationPair& pair : result.pairs) pair.temperature = options.temperature;
  return result;
}

EndPointRunResult run_hard_end_points(const HardSphereModel& model, const Configuration& start, const HardEndPointOptions& options,
                                      Isa isa, const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  check_no_overlap(start, kernel_table(isa));
  const ParticleLayout layout = ParticleLayout::in_space_order(start, model.species.size());
  HardEndPointWork work(model, layout, start, options, isa);
  const bool interrupted = run_to_end(work, archive_name, checkpoint, monitor);
  EndPointRunResult result =
      summarise(work, interrupted, start, layout, {"collisions", "time", "compressibility", "collision_rate", "phase"});
  result.compressibility = work.generator().compressibility();
  return result;
}

}  // namespace lanescape
