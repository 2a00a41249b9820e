#include "run/diffusion_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "core/overloaded.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/sphere/check_overlap.hpp"
#include "interaction/state/state_mixture.hpp"
#include "landscape/make_landscape.hpp"
#include "landscape/pair_landscape.hpp"

namespace lanescape {
namespace {

constexpr std::uint64_t records_per_report = 1000;

// Trajectories of hard spheres, equilibrated first.
class HardSource {
 public:
  static constexpr std::uint64_t collisions_per_unit = 100'000;

  HardSource(const HardSphereModel& model, const ParticleLayout& layout, const Configuration& start,
             const DiffusionRunOptions& options, Isa isa)
      : layout_(&layout), options_(&options), dynamics_(start, model.masses_of(start.species), kernel_table(isa)) {
    dynamics_.draw_velocities(options.seed);
  }

  // Runs one unit of equilibration and returns the share done so far. Resynchronises at its end, as trajectories do: only such a
  // state continues with the same bits after it is read.
  double equilibrate() {
    const std::uint64_t wanted = options_->equilibration_collisions;
    const std::uint64_t until = std::min(wanted, dynamics_.collisions() + collisions_per_unit);
    while (dynamics_.collisions() < until) dynamics_.collide();
    dynamics_.resynchronise();
    return wanted == 0 ? 1.0 : static_cast<double>(dynamics_.collisions()) / static_cast<double>(wanted);
  }
  bool failed() const { return false; }
  void begin_trajectory() {
    begin_ = dynamics_.time();
    virial_begin_ = dynamics_.virial();
    recorded_ = 0;
  }
  // Moves to the next record.
  void advance() {
    const double time = begin_ + static_cast<double>(recorded_++) * options_->window.interval;
    dynamics_.advance_to(time);
    dynamics_.positions(time, scratch_);
    position_ = layout_->to_slots(scratch_);
  }
  AlignedArray velocity() const { return layout_->to_slots(dynamics_.velocities()); }
  const AlignedArray& position() const { return position_; }
  void end_trajectory() {
    virial_ += dynamics_.virial() - virial_begin_;
    time_ += dynamics_.time() - begin_;
    for (std::uint64_t k = 0; k < options_->between; ++k) dynamics_.collide();
    dynamics_.resynchronise();
  }
  void finish(DiffusionRunResult& result) const {
    const double n = static_cast<double>(layout_->size());
    const double temperature = 2.0 * dynamics_.kinetic_energy() / (3.0 * n - 3.0);
    if (time_ > 0.0) result.compressibility = 1.0 + virial_ / (3.0 * n * temperature * time_);
  }
  void exchange(Archive& archive) {
    dynamics_.exchange(archive);
    archive.field("trajectory_virial", virial_);
    archive.field("trajectory_time", time_);
  }

 private:
  const ParticleLayout* layout_;
  const DiffusionRunOptions* options_;
  EventDriven dynamics_;
  std::vector<double> scratch_;
  AlignedArray position_;
  double begin_ = 0.0, virial_begin_ = 0.0, virial_ = 0.0, time_ = 0.0;
  std::uint64_t recorded_ = 0;
};

PairSearchOptions search_of(const EndPointOptions& options) { return {.threads = options.threads, .precision = options.precision}; }

std::unique_ptr<PairLandscape> landscape_of(const PairModel& model, const Box& box, const ParticleLayout& layout, Isa isa,
                                            const EndPointOptions& options) {
  return std::make_unique<PairLandscape>(model, box, layout, isa, search_of(options));
}

std::unique_ptr<StateMixtureLandscape> landscape_of(const StateMixtureModel& model, const Box& box, const ParticleLayout& layout,
                                                    Isa isa, const EndPointOptions& options) {
  return make_state_landscape(model, box, layout, isa, search_of(options));
}

// Trajectories of soft particles: the end-point protocol up to its first pair, then plain molecular dynamics.
template <class Landscape>
class SoftSource {
 public:
  static constexpr std::uint64_t records_per_virial = 10;

  template <class SoftModel>
  SoftSource(const SoftModel& model, const ParticleLayout& layout, const Configuration& start, const DiffusionRunOptions& options,
             Isa isa)
      : layout_(&layout),
        options_(&options),
        volume_(start.box.volume()),
        landscape_(landscape_of(model, start.box, layout, isa, options.equilibration)),
        generator_(*landscape_, model, layout, layout.to_slots(start.positions), options.equilibration),
        gradient_(layout.dimension(), 0.0),
        steps_per_record_(static_cast<std::uint64_t>(std::lround(options.window.interval / options.equilibration.time_step))) {}
  double equilibrate() {
    using Phase = EndPointGenerator::Phase;
    for (int k = 0; k < 1000 && generator_.phase() < Phase::pair; ++k) generator_.step();
    if (generator_.phase() >= Phase::pair || failed()) return 1.0;
    const double total = static_cast<double>(std::max<std::uint64_t>(1, generator_.phase_total()));
    return std::min(0.999, (static_cast<double>(generator_.phase()) + static_cast<double>(generator_.phase_done()) / total) / 4.0);
  }
  bool failed() const { return generator_.phase() == EndPointGenerator::Phase::temperature_not_held; }
  void begin_trajectory() { recorded_ = 0; }
  // Moves to the next record.
  void advance() {
    VelocityVerlet& verlet = generator_.verlet();
    if (recorded_ > 0) run(steps_per_record_);
    if (recorded_++ % records_per_virial == 0) {
      const double t = verlet.temperature();
      temperature_ += t;
      pressure_ +=
          (static_cast<double>(layout_->size()) * t + landscape_->energy_and_virial(verlet.position(), gradient_).virial / 3.0) /
          volume_;
      ++samples_;
    }
  }
  const AlignedArray& velocity() { return generator_.verlet().velocity(); }
  const AlignedArray& position() { return generator_.verlet().position(); }
  void end_trajectory() { run(options_->between); }
  void finish(DiffusionRunResult& result) const {
    if (samples_ == 0) return;
    result.temperature = temperature_ / static_cast<double>(samples_);
    result.pressure = pressure_ / static_cast<double>(samples_);
  }
  void exchange(Archive& archive) {
    generator_.exchange(archive);
    archive.field("temperature_sum", temperature_);
    archive.field("pressure_sum", pressure_);
    archive.field("samples", samples_);
  }

 private:
  void run(std::uint64_t steps) {
    for (std::uint64_t k = 0; k < steps; ++k) generator_.verlet().step();
  }

  const ParticleLayout* layout_;
  const DiffusionRunOptions* options_;
  double volume_;
  std::unique_ptr<Landscape> landscape_;
  EndPointGenerator generator_;
  AlignedArray gradient_;
  std::uint64_t steps_per_record_, recorded_ = 0, samples_ = 0;
  double temperature_ = 0.0, pressure_ = 0.0;
};

// Equilibration and trajectories of a source. A trajectory is not kept half done: an interrupted one is repeated.
template <class Source>
class DiffusionWork final : public ResumableWork {
 public:
  template <class SourceModel>
  DiffusionWork(const SourceModel& model, const ParticleLayout& layout, const Configuration& start,
                const DiffusionRunOptions& options, Isa isa)
      : source_(model, layout, start, options, isa),
        diffusion_(layout, options.window),
        record_(layout, options.window),
        relaxation_(layout, relaxation_window(model, options)),
        options_(&options) {}

  bool finished() const override { return source_.failed() || trajectories_ == options_->trajectories; }
  void advance(RunMonitor& monitor) override {
    if (equilibrated_ == 0) return equilibrate(monitor);
    if (records_ == 0) source_.begin_trajectory();
    do record();
    while (records_ < records_of_trajectory() && records_ % records_per_report != 0);
    if (records_ == records_of_trajectory()) end_trajectory();
    const double part = static_cast<double>(records_) / static_cast<double>(records_of_trajectory());
    monitor.progress("trajectories", static_cast<double>(trajectories_) + part, static_cast<double>(options_->trajectories));
  }
  bool saveable() const override { return records_ == 0; }
  bool save_due() const override { return equilibrated_ != 0; }
  void exchange(Archive& archive) override {
    source_.exchange(archive);
    diffusion_.exchange(archive);
    relaxation_.exchange(archive);
    archive.field("equilibrated", equilibrated_);
    archive.field("trajectories", trajectories_);
  }

  DiffusionRunResult result(bool interrupted) const {
    DiffusionRunResult result{.diffusion = diffusion_,
                              .relaxation = relaxation_,
                              .interrupted = interrupted,
                              .equilibrated = !source_.failed(),
                              .seconds = clock().seconds()};
    source_.finish(result);
    return result;
  }

 private:
  void equilibrate(RunMonitor& monitor) {
    const double part = source_.equilibrate();
    equilibrated_ = part >= 1.0 ? 1 : 0;
    monitor.progress("equilibration", part, 1.0);
  }
  std::uint64_t records_of_trajectory() const { return std::max(options_->window.records, relaxation_.window().records); }
  void record() {
    source_.advance();
    if (!record_.full()) record_.record(source_.velocity(), source_.position());
    if (records_ < relaxation_.window().records) relaxation_.record(source_.position());
    ++records_;
  }
  void end_trajectory() {
    diffusion_.add_trajectory(record_);
    source_.end_trajectory();
    record_.clear();
    records_ = 0;
    ++trajectories_;
  }

  Source source_;
  DiffusionAccumulator diffusion_;
  TrajectoryRecord record_;
  RelaxationAccumulator relaxation_;
  const DiffusionRunOptions* options_;
  std::uint64_t equilibrated_ = 0, trajectories_ = 0;
  std::uint64_t records_ = 0;  // of the current trajectory
};

template <class Source, class SourceModel>
DiffusionRunResult run(const SourceModel& model, const Configuration& start, const DiffusionRunOptions& options, Isa isa,
                       const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  const ParticleLayout layout = ParticleLayout::in_space_order(start, model.species.size());
  DiffusionWork<Source> work(model, layout, start, options, isa);
  return work.result(run_to_end(work, "diffusion.h5", checkpoint, monitor));
}

template <class Landscape, class SoftModel>
DiffusionRunResult run_soft(const SoftModel& model, const Configuration& start, const DiffusionRunOptions& options, Isa isa,
                            const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  check_separations(start, model);
  const double steps = options.window.interval / options.equilibration.time_step;
  if (!(steps >= 0.999 && std::fabs(steps - std::round(steps)) < 1e-6 * steps))
    throw_bad_input(fmt::format("record interval {} is not allowed: a multiple of the time step {} is needed",
                                options.window.interval, options.equilibration.time_step));
  return run<SoftSource<Landscape>>(model, start, options, isa, checkpoint, monitor);
}

}  // namespace

void DiffusionRunOptions::check() const {
  window.check();
  check_at_least_one("number of trajectories", trajectories);
}

RelaxationWindow relaxation_window(const AnyModel& model, const DiffusionRunOptions& options) {
  const RelaxationOptions& given = options.relaxation;
  const double size = largest_size(model);
  RelaxationWindow window{options.window.interval, given.records.value_or(options.window.records), given.wave_numbers,
                          given.overlap_length.value_or(0.3 * size)};
  const std::size_t species = mixture_of(model).species.size();
  if (window.wave_numbers.empty()) window.wave_numbers = {7.25 / size};
  if (window.wave_numbers.size() == 1) window.wave_numbers.assign(species, window.wave_numbers[0]);
  if (window.wave_numbers.size() != species)
    throw_bad_input(fmt::format("{} wave numbers are given for model {}: 1 is allowed, or {}, one for each species",
                                window.wave_numbers.size(), mixture_of(model).name, species));
  window.check();
  return window;
}

DiffusionRunOptions source_diffusion_options(std::size_t species, double packing_fraction) {
  struct Row {
    double below, interval;
  };
  static constexpr Row mono[] = {{0.075, 1e-3}, {0.175, 5e-4}, {0.275, 2e-4}, {0.375, 1e-4}, {0.455, 5e-5}, {1.0, 3e-5}};
  static constexpr Row mixed[] = {{0.075, 6e-4}, {0.175, 4e-4}, {0.275, 2e-4}, {0.375, 1.5e-4}, {0.495, 1e-4}, {1.0, 2e-5}};
  const bool mixture = species > 1, dense = mixture && packing_fraction >= 0.495;
  const Row* row = mixture ? mixed : mono;
  while (packing_fraction >= row->below) ++row;
  const std::uint64_t lags = dense ? 100'000 : mixture ? 40'000 : 30'000;
  const std::uint64_t origins = dense ? 200'000 : mixture ? 150'000 : 100'000;
  DiffusionRunOptions options;
  options.window = {row->interval, lags, origins + lags};
  options.trajectories = mixture ? 10 : 5;
  options.between = mixture ? 200'000 : 100'000;
  return options;
}

DiffusionRunOptions soft_diffusion_options() {
  DiffusionRunOptions options;
  options.window = {0.01, 1000, 11'000};
  return options;
}

DiffusionRunResult run_diffusion(const AnyModel& model, const Configuration& start, const DiffusionRunOptions& options, Isa isa,
                                 const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  options.check();
  check_periodic(start.box, "diffusion coefficients");
  return std::visit(
      Overloaded{[&](const HardSphereModel& hard) {
                   check_no_overlap(start, kernel_table(isa));
                   return run<HardSource>(hard, start, options, isa, checkpoint, monitor);
                 },
                 [&](const StateMixtureModel& states) {
                   return run_soft<StateMixtureLandscape>(states, start, options, isa, checkpoint, monitor);
                 },
                 [&](const PairModel& soft) { return run_soft<PairLandscape>(soft, start, options, isa, checkpoint, monitor); }},
      model);
}

}  // namespace lanescape
