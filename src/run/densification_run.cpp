#include "run/densification_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/probe_field.hpp"

namespace lanescape {
namespace {

// Fewer steps between insertions would rebuild the neighbour list more often than motion alone does.
constexpr std::uint64_t least_steps_per_event = 20;
// At this distance from a particle the fluid is uniform [sigma].
constexpr double correlation_length = 3.0;
constexpr std::size_t row_numbers = 9;

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

// A fluid whose density grows, one row of the record per chunk.
class Densification final : public ResumableWork {
 public:
  Densification(const PairModel& model, const FluidState& start, const DensificationOptions& options, Isa isa)
      : model_(&model),
        options_(&options),
        isa_(isa),
        volume_(start.configuration.box.volume()),
        per_step_(options.rate * options.time_step * volume_),
        steps_per_event_(std::max(least_steps_per_event, static_cast<std::uint64_t>(std::ceil(1.0 / per_step_)))),
        last_(static_cast<std::uint64_t>(std::llround(options.final_density * volume_)) - start.configuration.size()),
        fluid_(start) {}

  bool finished() const override { return failed_ > 0 || rows_ == options_->rows; }
  void advance(RunMonitor& monitor) override {
    if (rows_ == 0) begin();
    make_row();
    monitor.progress("densification", static_cast<double>(inserted_), static_cast<double>(last_));
  }
  void exchange(Archive& archive) override {
    fluid_.exchange(archive);
    history_.exchange(archive);
    archive.field("steps", steps_);
    archive.field("inserted", inserted_);
    archive.field("rows", rows_);
    archive.field("failed", failed_);
    archive.field("ledger", ledger_);
    archive.field("record", record_);
  }

  DensificationResult result(bool interrupted) const {
    DensificationResult result;
    for (std::size_t k = 0; k + row_numbers <= record_.size(); k += row_numbers) {
      const double* r = record_.data() + k;
      result.rows.push_back({r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]});
    }
    result.final_state = fluid_;
    result.inserted = inserted_;
    result.failures = failed_;
    result.interrupted = interrupted;
    result.seconds = clock().seconds();
    return result;
  }

 private:
  void begin() {
    MovingFluid fluid(*model_, fluid_, options_->time_step, isa_, options_->threads);
    equilibrate(fluid, options_->temperature, options_->equilibration_steps);
    fluid_ = fluid.state();
    ledger_ = fluid.potential().energy + fluid.kinetic_energy();
  }

  // Inserted particles at the end of a row.
  std::uint64_t goal(std::uint64_t row) const { return last_ * (row + 1) / options_->rows; }

  // Ends early where an insertion found no position. The state is whole after each row.
  void make_row() {
    RowSums sums;
    bool found = true;
    auto fluid = moving();
    while (found && inserted_ < goal(rows_)) {
      fluid->run(steps_per_event_);
      steps_ += steps_per_event_;
      const auto due = static_cast<std::uint64_t>(per_step_ * static_cast<double>(steps_));
      const std::uint64_t most = std::min(due, goal(rows_));
      const double potential = sample(*fluid, sums);
      drift_ = (potential + fluid->kinetic_energy() - ledger_) / particles();
      if (most <= inserted_) continue;
      const double excess = potential / particles(), temperature = fluid->temperature();
      fluid_ = fluid->state();
      found = insert(most - inserted_, excess, temperature, sums);
      fluid = moving();
    }
    fluid_ = fluid->state();
    sums.finish(drift_, record_);
    ++rows_;
    failed_ += found ? 0 : 1;
  }

  double particles() const { return static_cast<double>(fluid_.configuration.size()); }
  std::unique_ptr<MovingFluid> moving() const {
    return std::make_unique<MovingFluid>(*model_, fluid_, options_->time_step, isa_, options_->threads);
  }

  // The potential energy.
  double sample(MovingFluid& fluid, RowSums& sums) const {
    const MovingFluid::Potential potential = fluid.potential();
    sums.time += static_cast<double>(steps_) * options_->time_step;
    sums.density += particles() / volume_;
    sums.temperature += fluid.temperature();
    sums.pressure += potential.pressure;
    sums.excess += potential.energy / particles();
    sums.energy += (potential.energy + fluid.kinetic_energy()) / particles();
    ++sums.events;
    return potential.energy;
  }

  bool insert(std::uint64_t count, double excess, double temperature, RowSums& sums) {
    ProbeField field(*model_, fluid_.configuration, options_->species, kernel_table(isa_));
    InsertionOptions insertion = options_->insertion;
    insertion.target = excess;
    const CounterRandom random(insertion.seed, RandomStream::insertion);
    const double mass = model_->species[static_cast<std::size_t>(options_->species)].mass;
    for (const Insertion& one : insert_particles(field, insertion, count, history_, options_->threads)) {
      if (!one.found) return false;
      const auto velocity = maxwellian_velocity(random, inserted_, temperature, mass);
      const double brought =
          one.energy + 0.5 * mass * (velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2]);
      fluid_.add(options_->species, one.position, velocity);
      ledger_ += brought;
      ++inserted_;
      sums.brought += brought;
      sums.evaluations += static_cast<double>(one.evaluations);
      ++sums.inserted;
    }
    return true;
  }

  const PairModel* model_;
  const DensificationOptions* options_;
  Isa isa_;
  double volume_, per_step_;
  std::uint64_t steps_per_event_, last_;  // last_: inserted particles at the end
  double drift_ = 0.0;

  FluidState fluid_;
  InsertionHistory history_;
  std::uint64_t steps_ = 0, inserted_ = 0, rows_ = 0, failed_ = 0;
  double ledger_ = 0.0;  // total energy at the start and what insertions brought
  std::vector<double> record_;
};

}  // namespace

void DensificationOptions::check(const FluidState& start) const {
  const Box& box = start.configuration.box;
  check_periodic(box, "runs at rising density");
  const double density = static_cast<double>(start.configuration.size()) / box.volume();
  check_positive("temperature", temperature);
  check_positive("time step", time_step);
  check_positive("rate of density", rate);
  if (time_step > 0.02)
    throw_bad_input(fmt::format("time step {} is not allowed: at most 0.02, or energy is not conserved", time_step));
  if (!(final_density <= 2.0) || std::llround(final_density * box.volume()) <= static_cast<long long>(start.configuration.size()))
    throw_bad_input(
        fmt::format("final density {} is not allowed: it must be above the fluid's, {}, by a particle at least, and at "
                    "most 2",
                    final_density, density));
  check_at_least_one("number of rows", rows);
  const double most =
      4.0 * density * std::sqrt(std::numbers::pi * temperature) / (correlation_length * correlation_length * correlation_length);
  if (rate > most)
    throw_bad_input(
        fmt::format("rate of density {} is not allowed: at most {}, one particle per (3 sigma)^3 and collision time", rate, most));
  insertion.check(box);
}

DensificationResult run_densification(const PairModel& model, const FluidState& start, const DensificationOptions& options, Isa isa,
                                      const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  options.check(start);
  Densification work(model, start, options, isa);
  return work.result(run_to_end(work, "densification.h5", checkpoint, monitor));
}

}  // namespace lanescape
