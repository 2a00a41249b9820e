#include "run/flow_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "run/flow_record.hpp"
#include "run/moving_fluid.hpp"

namespace lanescape {
namespace {

constexpr std::uint64_t equilibration_chunk = 250, thermostat_interval = 50;
constexpr std::uint64_t intervals_per_checkpoint = 40;
// Of the thermostat of a fluid that comes to rest, per time.
constexpr double thermal_rate = 1.0;

class FlowWork final : public ResumableWork {
 public:
  FlowWork(const PairModel& model, const Configuration& start, const FlowOptions& options, Outside* outside)
      : model_(&model),
        options_(&options),
        given_(outside),
        fluid_{start, {}},
        density_(static_cast<double>(start.size()) / start.box.volume()) {
    if (!start.box.periodic[0]) equilibrated_ = options.equilibration_steps;
    const CounterRandom random(options.seed, RandomStream::velocities);
    const double mass = model.species.front().mass;
    for (std::size_t i = 0; i < start.size(); ++i) {
      const Point velocity = maxwellian_velocity(random, i, options.temperature, mass);
      fluid_.velocities.insert(fluid_.velocities.end(), velocity.begin(), velocity.end());
    }
  }

  bool finished() const override {
    return slab_ && (slab_->outcome() != FlowOutcome::followed || intervals_ == resting() + flowing());
  }
  void advance(RunMonitor& monitor) override {
    if (equilibrated_ < options_->equilibration_steps) {
      equilibrate_more();
      return monitor.progress("equilibration", static_cast<double>(equilibrated_),
                              static_cast<double>(options_->equilibration_steps));
    }
    if (!slab_) begin();
    if (intervals_ == resting()) slab_->set_outside(*outside_);
    // The buffers form, which costs energy and sends waves.
    if (intervals_ < thermalized()) slab_->thermalize(options_->temperature, 1.0 - std::exp(-thermal_rate * interval_time()));
    if (slab_->advance() != FlowOutcome::followed) return;
    ++intervals_;
    if (intervals_ > resting()) record_.add_insertions(*slab_, time());
    if (intervals_ % per_row() == 0) record_.add_row(*slab_, present_outside(), time());
    monitor.progress("flow", static_cast<double>(intervals_), static_cast<double>(resting() + flowing()));
  }
  bool save_due() const override { return intervals_ % intervals_per_checkpoint == 0; }
  void exchange(Archive& archive) override {
    archive.field("equilibrated", equilibrated_);
    archive.field("virial_pressure", virial_pressure_);
    archive.field("excess_energy", excess_energy_);
    archive.field("samples", samples_);
    archive.field("intervals", intervals_);
    auto begun = static_cast<std::uint64_t>(slab_ ? 1 : 0);
    archive.field("begun", begun);
    if (begun == 0) return fluid_.exchange(archive);
    if (archive.reading()) begin();
    slab_->exchange(archive);
    record_.exchange(archive);
  }

  FlowResult result(bool interrupted) {
    FlowResult result;
    result.interrupted = interrupted;
    result.seconds = clock().seconds();
    result.pressure = pressure();
    result.last = slab_ ? slab_->fluid() : fluid_;
    if (!slab_) return result;
    result.outcome = slab_->outcome();
    record_.put_into(result);
    const double sampled = static_cast<double>(options_->sampling_steps) * options_->slab.time_step,
                 end = static_cast<double>(flowing()) * interval_time();
    const double margin = std::max(options_->slab.buffer, options_->slab.faces.farthest);
    put_means(result, end - sampled, margin, slab_->geometry().length - margin);
    return result;
  }

 private:
  std::uint64_t steps_per_interval() const { return options_->slab.steps_per_exchange * options_->slab.exchanges_per_coupling; }
  double interval_time() const { return static_cast<double>(steps_per_interval()) * options_->slab.time_step; }
  std::uint64_t intervals_of(std::uint64_t steps) const { return (steps + steps_per_interval() - 1) / steps_per_interval(); }
  // Whole rows.
  std::uint64_t per_row() const { return std::max<std::uint64_t>(1, intervals_of(options_->row_steps)); }
  std::uint64_t rows_of(std::uint64_t steps) const { return (intervals_of(steps) + per_row() - 1) / per_row() * per_row(); }
  std::uint64_t resting() const { return rows_of(options_->resting_steps); }
  std::uint64_t thermalized() const { return resting() / 4 * 3; }
  std::uint64_t flowing() const { return rows_of(options_->flow_steps); }
  double time() const { return (static_cast<double>(intervals_) - static_cast<double>(resting())) * interval_time(); }

  void equilibrate_more() {
    MovingFluid fluid(*model_, fluid_, options_->slab.time_step, options_->slab.isa, options_->slab.threads);
    const std::uint64_t end = std::min(equilibrated_ + equilibration_chunk, options_->equilibration_steps);
    while (equilibrated_ < end) {
      fluid.rescale_to(options_->temperature);
      const std::uint64_t steps = std::min(thermostat_interval, end - equilibrated_);
      fluid.run(steps);
      equilibrated_ += steps;
      if (2 * equilibrated_ <= options_->equilibration_steps) continue;
      const MovingFluid::Potential potential = fluid.potential();
      const double kinetic = fluid.temperature() * density_;
      virial_pressure_ += (potential.pressure - kinetic - virial_pressure_) / static_cast<double>(++samples_);
      excess_energy_ +=
          (potential.energy / static_cast<double>(fluid_.configuration.size()) - excess_energy_) / static_cast<double>(samples_);
    }
    fluid.rescale_to(options_->temperature);
    fluid_ = fluid.state();
  }

  FaceDemand rest() const {
    FaceDemand demand;
    demand.pressure = pressure();
    demand.temperature = options_->temperature;
    demand.energy = options_->energy;
    return demand;
  }

  double pressure() const { return options_->pressure.value_or(virial_pressure_ + density_ * options_->temperature); }
  double mass_flux() const { return options_->mass_flux.value_or(density_ * options_->velocity); }
  std::optional<double> enthalpy(double velocity) const {
    if (options_->enthalpy_kind == FlowOptions::Enthalpy::free) return std::nullopt;
    if (options_->enthalpy_kind == FlowOptions::Enthalpy::number) return options_->enthalpy;
    const double mass = model_->species.front().mass;
    return 1.5 * options_->temperature + excess_energy_ + pressure() / density_ + 0.5 * mass * velocity * velocity;
  }

  // That of the last interval.
  Outside& present_outside() {
    if (intervals_ > resting()) return *outside_;
    return *resting_outside_;
  }

  void begin() {
    const FaceDemand rest = this->rest();
    resting_outside_.emplace(
        ConstantOutsideOptions{{rest, rest}, options_->impedance, !options_->constant_force, enthalpy(0.0), density_, slab_area()});
    outside_ = given_;
    if (!given_) {
      FaceDemand inlet = rest;
      inlet.velocity = {options_->velocity, 0.0, 0.0};
      inlet.mass_flux = mass_flux();
      FaceDemand outlet = inlet;
      inlet.shear = {options_->shear, 0.0};
      outlet.shear = {-options_->shear, 0.0};
      constant_outside_.emplace(ConstantOutsideOptions{
          {inlet, outlet}, options_->impedance, !options_->constant_force, enthalpy(options_->velocity), {}, slab_area()});
      outside_ = &*constant_outside_;
    }
    if (fluid_.configuration.box.periodic[0]) thin_out_buffers();
    fluid_.configuration.box.periodic[0] = false;
    slab_.emplace(*model_, fluid_, options_->slab, present_outside());
  }
  // A fluid cut out of a larger one is as dense at its faces as inside. Without what its buffers will not hold, it keeps its
  // density.
  void thin_out_buffers() {
    const SlabGeometry geometry(fluid_.configuration.box, options_->slab.buffer, options_->slab.slice);
    const CounterRandom random(options_->seed, RandomStream::flow);
    FluidState kept{{fluid_.configuration.box, {}, {}}, {}};
    for (std::size_t i = 0; i < fluid_.configuration.size(); ++i) {
      const Point position = fluid_.configuration.position(i);
      const bool in_buffer = geometry.depth(0, position[0]) > 0.0 || geometry.depth(1, position[0]) > 0.0;
      if (!in_buffer || random.uniform(0, static_cast<std::uint32_t>(i), 20) < usual_filling)
        kept.add(0, position, point_at(fluid_.velocities.data(), i));
    }
    fluid_ = std::move(kept);
  }
  double slab_area() const { return fluid_.configuration.box.length[1] * fluid_.configuration.box.length[2]; }

  const PairModel* model_;
  const FlowOptions* options_;
  Outside* given_;
  Outside* outside_ = nullptr;
  FluidState fluid_;
  double density_, virial_pressure_ = 0.0, excess_energy_ = 0.0;  // of the start; means of its equilibration
  std::uint64_t equilibrated_ = 0, samples_ = 0, intervals_ = 0;
  std::optional<ConstantOutside> resting_outside_, constant_outside_;
  std::optional<OpenSlab> slab_;
  FlowRecord record_;
};

}  // namespace

void FlowOptions::check(const PairModel& model, const Configuration& start) const {
  Box open = start.box;
  open.periodic[0] = false;
  slab.check(model, open);
  if (!start.box.periodic[0] && !pressure)
    throw_bad_input("a start that is open along x needs a pressure: only an equilibration in a periodic box could measure it");
  if (!start.box.periodic[0] && enthalpy_kind == Enthalpy::of_fluid)
    throw_bad_input(
        "a start that is open along x needs an enthalpy, a number or none: only an equilibration in a periodic box could measure "
        "it");
  check_positive("temperature", temperature);
  if (pressure) check_positive("pressure", *pressure);
  check_at_least_one("flow steps", flow_steps);
  check_at_least_one("row steps", row_steps);
  if (sampling_steps > flow_steps)
    throw_bad_input(fmt::format("{} sampling steps are not allowed: at most the {} flow steps, of which they are the last",
                                sampling_steps, flow_steps));
  for (const auto& [name, value] : {std::pair("shear", shear), {"enthalpy", enthalpy}})
    if (!std::isfinite(value)) throw_bad_input(fmt::format("{} {} is not allowed: it must be finite", name, value));
  for (const auto& [name, value] :
       {std::pair("mass flux", mass_flux.value_or(0.0)), {"impedance", impedance}, {"velocity", velocity}})
    if (!(value >= 0.0) || !std::isfinite(value)) throw_bad_input(fmt::format("{} {} is not allowed: 0 or more", name, value));
}

FlowResult run_flow(const PairModel& model, const Configuration& start, const FlowOptions& options, Outside* outside,
                    const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  options.check(model, start);
  FlowWork work(model, start, options, outside);
  const bool interrupted = run_to_end(work, "flow.h5", checkpoint, monitor);
  return work.result(interrupted);
}

}  // namespace lanescape
