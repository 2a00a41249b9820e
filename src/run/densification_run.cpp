#include "run/densification_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/probe_field.hpp"

namespace lanescape {
namespace {

using Clock = std::chrono::steady_clock;

// Steps between insertions: fewer would make the neighbour list anew more often than it wears out by itself.
constexpr std::uint64_t least_steps_per_event = 20;
// Around one particle the fluid is uniform again at this distance [sigma].
constexpr double correlation_length = 3.0;
constexpr std::size_t row_numbers = 9;

struct DensificationState {
  FluidState fluid;
  InsertionHistory history;
  std::uint64_t steps = 0, inserted = 0, rows = 0, failed = 0;
  double ledger = 0.0;  // total energy at the start and what insertions brought
  std::vector<double> record;
  double seconds = 0.0;

  void exchange(Archive& archive) {
    fluid.exchange(archive);
    history.exchange(archive);
    archive.field("steps", steps);
    archive.field("inserted", inserted);
    archive.field("rows", rows);
    archive.field("failed", failed);
    archive.field("ledger", ledger);
    archive.field("record", record);
    archive.field("run_seconds", seconds);
  }
};

// Sums over the events of a row.
struct RowSums {
  double time = 0.0, density = 0.0, temperature = 0.0, pressure = 0.0, excess = 0.0, energy = 0.0;
  double brought = 0.0, evaluations = 0.0;
  std::uint64_t events = 0, inserted = 0;

  void finish(double drift, std::vector<double>& record) const {
    const double n = static_cast<double>(events), k = static_cast<double>(std::max<std::uint64_t>(inserted, 1));
    for (const double sum : {time, density, temperature, pressure, excess, energy}) record.push_back(sum / n);
    for (const double number : {brought / k, evaluations / k, drift}) record.push_back(number);
  }
};

class Densification {
 public:
  Densification(const PairModel& model, const DensificationOptions& options, Isa isa, DensificationState& state,
                std::size_t particles_at_start)
      : model_(&model),
        options_(&options),
        isa_(isa),
        state_(&state),
        volume_(state.fluid.configuration.box.volume()),
        per_step_(options.rate * options.time_step * volume_),
        steps_per_event_(std::max(least_steps_per_event, static_cast<std::uint64_t>(std::ceil(1.0 / per_step_)))),
        last_(static_cast<std::uint64_t>(std::llround(options.final_density * volume_)) - particles_at_start) {}

  std::uint64_t last() const { return last_; }
  // Inserted particles at the end of a row.
  std::uint64_t goal(std::uint64_t row) const { return last_ * (row + 1) / options_->rows; }

  // One row; false where an insertion found no place. The state is whole after each.
  bool make_row() {
    RowSums sums;
    bool found = true;
    auto fluid = moving();
    while (found && state_->inserted < goal(state_->rows)) {
      fluid->run(steps_per_event_);
      state_->steps += steps_per_event_;
      const auto due = static_cast<std::uint64_t>(per_step_ * static_cast<double>(state_->steps));
      const std::uint64_t most = std::min(due, goal(state_->rows));
      const double potential = sample(*fluid, sums);
      drift_ = (potential + fluid->kinetic_energy() - state_->ledger) / particles();
      if (most <= state_->inserted) continue;
      const double excess = potential / particles(), temperature = fluid->temperature();
      state_->fluid = fluid->state();
      found = insert(most - state_->inserted, excess, temperature, sums);
      fluid = moving();
    }
    state_->fluid = fluid->state();
    sums.finish(drift_, state_->record);
    ++state_->rows;
    state_->failed += found ? 0 : 1;
    return found;
  }

 private:
  double particles() const { return static_cast<double>(state_->fluid.configuration.size()); }
  std::unique_ptr<MovingFluid> moving() const {
    return std::make_unique<MovingFluid>(*model_, state_->fluid, options_->time_step, isa_, options_->threads);
  }

  // The potential energy.
  double sample(MovingFluid& fluid, RowSums& sums) const {
    const MovingFluid::Potential potential = fluid.potential();
    sums.time += static_cast<double>(state_->steps) * options_->time_step;
    sums.density += particles() / volume_;
    sums.temperature += fluid.temperature();
    sums.pressure += potential.pressure;
    sums.excess += potential.energy / particles();
    sums.energy += (potential.energy + fluid.kinetic_energy()) / particles();
    ++sums.events;
    return potential.energy;
  }

  bool insert(std::uint64_t count, double excess, double temperature, RowSums& sums) {
    ProbeField field(*model_, state_->fluid.configuration, options_->species, kernel_table(isa_));
    InsertionOptions insertion = options_->insertion;
    insertion.target = excess;
    const CounterRandom random(insertion.seed, RandomStream::insertion);
    const double mass = model_->species[static_cast<std::size_t>(options_->species)].mass;
    for (const Insertion& one : insert_particles(field, insertion, count, state_->history, options_->threads)) {
      if (!one.found) return false;
      const auto velocity = maxwellian_velocity(random, state_->inserted, temperature, mass);
      const double brought =
          one.energy + 0.5 * mass * (velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2]);
      state_->fluid.add(options_->species, one.position, velocity);
      state_->ledger += brought;
      ++state_->inserted;
      sums.brought += brought;
      sums.evaluations += static_cast<double>(one.evaluations);
      ++sums.inserted;
    }
    return true;
  }

  const PairModel* model_;
  const DensificationOptions* options_;
  Isa isa_;
  DensificationState* state_;
  double volume_, per_step_;
  std::uint64_t steps_per_event_, last_;
  double drift_ = 0.0;
};

DensificationResult result_of(const DensificationState& state) {
  DensificationResult result;
  for (std::size_t k = 0; k + row_numbers <= state.record.size(); k += row_numbers) {
    const double* r = state.record.data() + k;
    result.rows.push_back({r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]});
  }
  result.final_state = state.fluid;
  result.inserted = state.inserted;
  result.failures = state.failed;
  result.seconds = state.seconds;
  return result;
}

}  // namespace

void DensificationOptions::check(const FluidState& start) const {
  const auto positive = [](const char* what, double value) {
    if (!(value > 0.0) || !std::isfinite(value))
      throw_bad_input(fmt::format("{} {} is not allowed: it must be finite and above 0", what, value));
  };
  const Box& box = start.configuration.box;
  const double density = static_cast<double>(start.configuration.size()) / box.volume();
  positive("temperature", temperature);
  positive("time step", time_step);
  positive("rate of density", rate);
  if (time_step > 0.02)
    throw_bad_input(fmt::format("time step {} is not allowed: at most 0.02, or energy is not conserved", time_step));
  if (!(final_density <= 2.0) || std::llround(final_density * box.volume()) <= static_cast<long long>(start.configuration.size()))
    throw_bad_input(
        fmt::format("final density {} is not allowed: it must be above the fluid's, {}, by a particle at least, and at "
                    "most 2",
                    final_density, density));
  if (rows == 0) throw_bad_input("number of rows must be at least 1");
  const double most =
      4.0 * density * std::sqrt(std::numbers::pi * temperature) / (correlation_length * correlation_length * correlation_length);
  if (rate > most)
    throw_bad_input(
        fmt::format("rate of density {} is not allowed: at most {}, one particle per (3 sigma)^3 and collision time", rate, most));
  insertion.check(box);
}

DensificationResult run_densification(const PairModel& model, const FluidState& start, const DensificationOptions& options, Isa isa,
                                      const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  const auto file = checkpoint.folder / "densification.h5";
  options.check(start);
  DensificationState state{.fluid = start, .history = {}, .record = {}};
  const bool resumed = checkpoint.enabled() && checkpoint.resume && load_checkpoint(file, state);
  if (!resumed) {
    MovingFluid fluid(model, start, options.time_step, isa, options.threads);
    equilibrate(fluid, options.temperature, options.equilibration_steps);
    state.fluid = fluid.state();
    state.ledger = fluid.potential().energy + fluid.kinetic_energy();
  }
  Densification densification(model, options, isa, state, start.configuration.size());
  bool interrupted = false;
  auto last = Clock::now();
  while (!interrupted && state.failed == 0 && state.rows < options.rows) {
    densification.make_row();
    const auto now = Clock::now();
    state.seconds += std::chrono::duration<double>(now - last).count();
    last = now;
    monitor.progress("densification", static_cast<double>(state.inserted), static_cast<double>(densification.last()));
    if (checkpoint.enabled()) save_checkpoint(file, state);
    interrupted = monitor.stop_requested() && state.rows < options.rows;
  }
  DensificationResult result = result_of(state);
  result.interrupted = interrupted;
  return result;
}

}  // namespace lanescape
