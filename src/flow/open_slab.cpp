#include "flow/open_slab.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "flow/buffer_heat.hpp"
#include "flow/buffer_landscape.hpp"

namespace lanescape {
namespace {

// Particles are sorted in space after so many exchanges with the outside; until then few have gone far.
constexpr std::uint64_t couplings_per_sort = 50;
// As in other runs at constant energy.
constexpr double longest_step = 0.02;

void sort_in_space(FluidState& fluid) {
  const std::vector<std::size_t> order = ParticleLayout::in_space_order(fluid.configuration, 1).order();
  FluidState sorted{{fluid.configuration.box, fluid.configuration.species, {}}, {}};
  for (const std::size_t i : order)
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      sorted.configuration.positions.push_back(fluid.configuration.positions[k]);
      sorted.velocities.push_back(fluid.velocities[k]);
    }
  fluid = std::move(sorted);
}

Point momentum_of(const FluidState& fluid, double mass) {
  Point sum{};
  for (std::size_t k = 0; k < fluid.velocities.size(); ++k) sum[k % 3] += mass * fluid.velocities[k];
  return sum;
}

}  // namespace

struct OpenSlab::Interval {
  Interval(const PairModel& model, const FluidState& fluid, const SlabGeometry& geometry, const OpenSlabOptions& options,
           const Outside::Demands& demands)
      : layout(ParticleLayout::in_users_order(fluid.configuration, 1)),
        pairs(model, fluid.configuration.box, layout, options.isa, {.threads = options.threads}),
        buffered(pairs, layout, geometry, demands, model.species.front().mass, options.time_step),
        verlet(buffered, model, layout, layout.to_slots(fluid.configuration.positions), options.time_step) {
    verlet.set_velocity(layout.to_slots(fluid.velocities));
  }

  ParticleLayout layout;
  PairLandscape pairs;
  BufferLandscape buffered;
  VelocityVerlet verlet;
};

void OpenSlabOptions::check(const PairModel& model, const Box& box) const {
  if (model.species.size() != 1 || model.form->has_diameters)
    throw_bad_input(fmt::format("model {} is not allowed in an open slab: one species of one size is needed", model.name));
  if (box.periodic != std::array<bool, 3>{false, true, true})
    throw_bad_input("an open slab needs a box that is open along x and periodic along y and z");
  if (model.truncation == Truncation::tail)
    throw_bad_input("truncation tail is not allowed in an open slab: its fluid is not uniform beyond the cutoff");
  check_positive("time step", time_step, longest_step);
  check_at_least_one("steps per exchange", steps_per_exchange);
  check_at_least_one("exchanges per coupling", exchanges_per_coupling);
  check_positive("buffer width", buffer, 0.5 * box.length[0]);
  check_positive("slice", slice, box.length[0]);
  if (!(faces.nearest >= 0.0 && faces.nearest < faces.farthest && faces.farthest <= 0.5 * box.length[0]))
    throw_bad_input(fmt::format("insertion from {} to {} of a face is not allowed: from 0 to half the slab, {}", faces.nearest,
                                faces.farthest, 0.5 * box.length[0]));
  if (!(faces.thermostat_rate >= 0.0) || !std::isfinite(faces.thermostat_rate))
    throw_bad_input(fmt::format("thermostat rate {} is not allowed: 0 or more", faces.thermostat_rate));
  faces.insertion.check(box);
}

OpenSlab::OpenSlab(const PairModel& model, FluidState start, const OpenSlabOptions& options, Outside& outside)
    : model_(&model),
      options_(options),
      outside_(&outside),
      geometry_((options.check(model, start.configuration.box), start.configuration.box), options.buffer, options.slice),
      fluid_(std::move(start)),
      faces_{{{model, geometry_, 0, options.faces, options.isa, options.threads},
              {model, geometry_, 1, options.faces, options.isa, options.threads}}},
      sampler_(geometry_, model.species.front().mass) {}

std::array<BesideBuffer, 2> OpenSlab::beside_buffers() const {
  const double mass = model_->species.front().mass;
  return {{{geometry_, 0, mass}, {geometry_, 1, mass}}};
}

Outside::Reports OpenSlab::look() {
  std::array<BesideBuffer, 2> beside = beside_buffers();
  Interval now(*model_, fluid_, geometry_, options_, {});
  for (BesideBuffer& one : beside) one.add(fluid_.configuration.positions, fluid_.velocities, energies_of(now));
  keep_balance(now);
  Outside::Reports reports{};
  for (std::size_t face = 0; face < 2; ++face) beside[face].put_means(reports[face]);
  return reports;
}

void OpenSlab::thermalize(double temperature, double probability) {
  std::vector<std::size_t> all(fluid_.configuration.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const CounterRandom random(options_.faces.insertion.seed, RandomStream::flow);
  // Faces count their calls from 1.
  passed_.energy += redraw_velocities(fluid_, all, model_->species.front().mass, temperature, probability, random, ~exchanges_);
}

void OpenSlab::set_outside(Outside& outside) {
  outside_ = &outside;
  const Outside::Reports now = look();
  balance_.start = balance_.now;
  balance_.passed = passed_ = {};
  demands_ = outside_->begin(now);
}

FlowOutcome OpenSlab::advance() {
  if (outcome_ != FlowOutcome::followed) return outcome_;
  if (exchanges_ % (couplings_per_sort * options_.exchanges_per_coupling) == 0) sort_in_space(fluid_);
  if (!demands_) set_outside(*outside_);
  reports_ = {};
  for (FaceExchange& face : faces_) face.forget_insertions();
  std::array<BesideBuffer, 2> beside = beside_buffers();
  for (std::uint64_t k = 0; k < options_.exchanges_per_coupling; ++k)
    if (pass_interval(beside, k == 0) != FlowOutcome::followed) return outcome_;
  for (std::size_t face = 0; face < 2; ++face) beside[face].put_means(reports_[face]);
  demands_ = outside_->advance(reports_, coupling_time());
  return outcome_;
}

FlowOutcome OpenSlab::pass_interval(std::array<BesideBuffer, 2>& beside, bool with_energies) {
  Interval interval(*model_, fluid_, geometry_, options_, *demands_);
  observe(interval, beside, with_energies);
  for (std::uint64_t k = 0; k < options_.steps_per_exchange; ++k) interval.verlet.step();
  if (interval.buffered.emptied()) return outcome_ = FlowOutcome::no_particle;
  take_motion(interval);
  ++exchanges_;
  Outside::Reports passed = interval.buffered.reports();
  for (std::size_t face = 0; face < 2 && outcome_ == FlowOutcome::followed; ++face)
    outcome_ = faces_[face].pass(fluid_, (*demands_)[face], time(), interval_time(), mean_energy_, passed[face]);
  add_reports(passed);
  return outcome_;
}

void OpenSlab::keep_balance(Interval& interval) {
  balance_.now = {static_cast<double>(fluid_.configuration.size()),
                  interval.verlet.potential_energy() + interval.verlet.kinetic_energy(),
                  momentum_of(fluid_, model_->species.front().mass)};
  balance_.passed = passed_;
  for (std::size_t face = 0; face < 2; ++face) balance_.faces[face] = faces_[face].counts();
}

std::vector<double> OpenSlab::energies_of(Interval& interval) {
  AlignedArray of_slots(interval.layout.slots(), 0.0);
  interval.pairs.energies(interval.verlet.position(), of_slots);
  std::vector<double> energies;
  for (std::size_t i = 0; i < fluid_.configuration.size(); ++i) energies.push_back(of_slots[interval.layout.slot_of(i)]);
  return energies;
}

void OpenSlab::observe(Interval& interval, std::array<BesideBuffer, 2>& beside, bool with_energies) {
  const std::vector<double>& positions = fluid_.configuration.positions;
  keep_balance(interval);
  sampler_.add_motion(positions, fluid_.velocities, interval.buffered.forces_across());
  const std::vector<double> energies = with_energies ? energies_of(interval) : std::vector<double>{};
  for (BesideBuffer& one : beside) one.add(positions, fluid_.velocities, energies);
  if (!with_energies) return;
  sampler_.add_energies(positions, energies);
  double between = 0.0, count = 0.0;
  for (std::size_t i = 0; i < energies.size(); ++i) {
    if (geometry_.depth(0, positions[3 * i]) > 0.0 || geometry_.depth(1, positions[3 * i]) > 0.0) continue;
    between += energies[i];
    count += 1.0;
  }
  if (count > 0.0) mean_energy_ = between / count;
}

void OpenSlab::take_motion(const Interval& interval) {
  sampler_.add_passages(interval.buffered.passages().particles, interval.buffered.passages().momentum, interval_time());
  fluid_.configuration.positions = interval.layout.to_user(interval.verlet.position());
  fluid_.velocities = interval.layout.to_user(interval.verlet.velocity());
  fluid_.configuration.wrap();
}

void OpenSlab::add_reports(const Outside::Reports& passed) {
  for (std::size_t face = 0; face < 2; ++face) {
    const double into_slab = face == 0 ? 1.0 : -1.0;
    FaceReport& sum = reports_[face];
    const FaceReport& one = passed[face];
    sum.particles += one.particles;
    sum.energy += one.energy;
    sum.heat += one.heat;
    passed_.particles += into_slab * one.particles;
    passed_.energy += into_slab * one.energy;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sum.momentum[axis] += one.momentum[axis];
      sum.impulse[axis] += one.impulse[axis];
      passed_.momentum[axis] += into_slab * one.momentum[axis];
    }
  }
}

namespace {

void exchange_content(Archive& archive, const char* name, FlowBalance::Content& content) {
  archive.enter(name);
  archive.field("particles", content.particles);
  archive.field("energy", content.energy);
  for (std::size_t axis = 0; axis < 3; ++axis) archive.field(fmt::format("momentum_{}", axis), content.momentum[axis]);
  archive.leave();
}

void exchange_demand(Archive& archive, const char* name, FaceDemand& demand) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> numbers = {demand.pressure,    demand.shear[0],    demand.shear[1],
                                 demand.mass_flux,   demand.velocity[0], demand.velocity[1],
                                 demand.velocity[2], demand.temperature, demand.energy.value_or(none),
                                 demand.heat_flux};
  archive.field(name, numbers);
  if (!archive.reading()) return;
  demand = {numbers.at(0), {numbers.at(1), numbers.at(2)},
            numbers.at(3), {numbers.at(4), numbers.at(5), numbers.at(6)},
            numbers.at(7), std::isnan(numbers.at(8)) ? std::nullopt : std::optional(numbers.at(8)),
            numbers.at(9)};
}

}  // namespace

void OpenSlab::exchange(Archive& archive) {
  archive.enter("fluid");
  fluid_.exchange(archive);
  archive.leave();
  for (FaceExchange& face : faces_) face.exchange(archive);
  sampler_.exchange(archive);
  if (!demands_) demands_.emplace();
  exchange_demand(archive, "demand_inlet", (*demands_)[0]);
  exchange_demand(archive, "demand_outlet", (*demands_)[1]);
  exchange_content(archive, "passed", passed_);
  exchange_content(archive, "start", balance_.start);
  archive.field("exchanges", exchanges_);
  archive.field("mean_energy", mean_energy_);
  exchange_enum(archive, "outcome", outcome_);
  archive.enter("outside");
  outside_->exchange(archive);
  archive.leave();
}

}  // namespace lanescape
