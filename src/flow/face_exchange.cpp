#include "flow/face_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/enum_words.hpp"
#include "flow/buffer_heat.hpp"
#include "interaction/pair/probe_field.hpp"

namespace lanescape {
namespace {

// At this distance from a particle the fluid is uniform [sigma].
constexpr double correlation_length = 3.0;
// Of these, drawn at random, the one that disturbs least is taken out: all of a region would cost a hundred times as much.
constexpr std::size_t removal_candidates = 16;
// A buffer gives particles only while it holds more than this share of those that it would at the density beside it.
constexpr double least_filling = 0.4;
// A face that lags behind by more than the insertions allowed in this time cannot follow.
constexpr double longest_lag = 20.0;

constexpr EnumWord<FlowOutcome> outcomes[] = {{FlowOutcome::followed, "done"},
                                              {FlowOutcome::no_place, "no place for a particle"},
                                              {FlowOutcome::rate_too_high, "rate too high"},
                                              {FlowOutcome::no_particle, "no particle left"}};

void erase(FluidState& fluid, std::vector<std::size_t> particles) {
  std::sort(particles.begin(), particles.end());
  auto next = particles.begin();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < fluid.configuration.size(); ++i) {
    if (next != particles.end() && *next == i) {
      ++next;
      continue;
    }
    fluid.configuration.species[kept] = fluid.configuration.species[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      fluid.configuration.positions[3 * kept + axis] = fluid.configuration.positions[3 * i + axis];
      fluid.velocities[3 * kept + axis] = fluid.velocities[3 * i + axis];
    }
    ++kept;
  }
  fluid.configuration.species.resize(kept);
  fluid.configuration.positions.resize(3 * kept);
  fluid.velocities.resize(3 * kept);
}

}  // namespace

const char* to_string(FlowOutcome outcome) { return word_of(outcomes, outcome); }

// The particles near the face, within reach of all that is put in or taken out, as a fluid of their own.
struct FaceExchange::Neighbourhood {
  Configuration fluid;
  std::vector<std::size_t> particles;        // of it, in the slab
  std::vector<std::size_t> left, in_region;  // those beyond the face; those in the region, indices in `fluid`
  std::vector<std::size_t> gone, in_buffer;  // taken out; in the buffer: in the slab
  double density = 0.0;                      // of a layer of the thickness of the cutoff beside the buffer
  std::optional<ProbeField> field;
};

FaceExchange::FaceExchange(const PairModel& model, const SlabGeometry& geometry, std::size_t face,
                           const FaceExchangeOptions& options, Isa isa, int threads)
    : model_(&model),
      geometry_(geometry),
      face_(face),
      options_(options),
      isa_(isa),
      threads_(threads),
      mass_(model.species.front().mass) {}

Region FaceExchange::region(const Box& box) const {
  Region region{{}, box.length};
  region.low[0] = face_ == 0 ? options_.nearest : geometry_.length - options_.farthest;
  region.high[0] = face_ == 0 ? options_.farthest : geometry_.length - options_.nearest;
  return region;
}

double FaceExchange::volume() const { return geometry_.area * (options_.farthest - options_.nearest); }

double FaceExchange::insertion_rate(double density, double temperature) const {
  return volume() / std::pow(correlation_length, 3) * 4.0 * density * std::sqrt(std::numbers::pi * temperature);
}

void FaceExchange::count_out(const FluidState& fluid, std::size_t particle, double energy, FaceReport& report) {
  const Point velocity = point_at(fluid.velocities.data(), particle);
  passed_ -= 1.0;
  report.particles -= sign();
  for (std::size_t axis = 0; axis < 3; ++axis) report.momentum[axis] -= sign() * mass_ * velocity[axis];
  report.energy -= sign() * (energy + 0.5 * mass_ * dot(velocity, velocity));
}

void FaceExchange::take_out_left(FluidState& fluid, Neighbourhood& near, FaceReport& report) {
  for (const std::size_t k : near.left) {
    const Point position = near.fluid.position(k);
    near.field->remove(position, 0);
    count_out(fluid, near.particles[k], near.field->energy(position), report);
    near.gone.push_back(near.particles[k]);
    ++counts_.left;
  }
}

FlowOutcome FaceExchange::put_in(FluidState& fluid, Neighbourhood& near, const FaceDemand& demand, std::uint64_t count,
                                 double target, double now, FaceReport& report) {
  InsertionOptions with = options_.insertion;
  with.target = target;
  with.region = region(fluid.configuration.box);
  with.seed += face_;
  const double density = static_cast<double>(near.in_region.size()) / (geometry_.area * options_.farthest);
  if (!with.largest_step) with.largest_step = 0.1 * std::pow(std::max(density, 0.05), -1.5);
  const CounterRandom random(with.seed, RandomStream::flow);
  for (const Insertion& one : insert_particles(*near.field, with, count, history_, threads_)) {
    if (!one.found) return FlowOutcome::no_place;
    const Point velocity = maxwellian_velocity(random, 2 * counts_.put_in + face_, demand.temperature, mass_, demand.velocity);
    fluid.add(0, one.position, velocity);
    insertions_.push_back({now, density, one.evaluations, one.energy, one.distance});
    ++counts_.put_in;
    passed_ += 1.0;
    report.particles += sign();
    for (std::size_t axis = 0; axis < 3; ++axis) report.momentum[axis] += sign() * mass_ * velocity[axis];
    report.energy += sign() * (one.energy + 0.5 * mass_ * dot(velocity, velocity));
  }
  return FlowOutcome::followed;
}

void FaceExchange::take_out(FluidState& fluid, Neighbourhood& near, std::uint64_t count, double target, FaceReport& report) {
  const CounterRandom random(options_.insertion.seed, RandomStream::flow);
  // The outside's force needs particles that bear it, until the flow brings others.
  const double kept = least_filling * near.density * geometry_.area * geometry_.buffer;
  for (std::uint64_t k = 0; k < count; ++k) {
    if (near.in_region.empty() || static_cast<double>(near.in_buffer.size()) - static_cast<double>(k) <= kept) break;
    const auto all = static_cast<std::uint32_t>(near.in_region.size());
    std::vector<std::size_t> candidates;
    for (std::uint32_t c = 0; c < removal_candidates; ++c)
      candidates.push_back(near.in_region[random.below(all, counts_.taken_out, c, 7 + static_cast<std::uint32_t>(face_))]);
    const Removal removal =
        choose_removal(*near.field, near.fluid, candidates, options_.removal, target, random, counts_.taken_out);
    near.field->remove(near.fluid.position(removal.particle), 0);
    count_out(fluid, near.particles[removal.particle], removal.energy, report);
    near.gone.push_back(near.particles[removal.particle]);
    std::erase(near.in_region, removal.particle);
    ++counts_.taken_out;
  }
}

FaceExchange::Neighbourhood FaceExchange::neighbourhood(const FluidState& fluid) const {
  Neighbourhood near{{fluid.configuration.box, {}, {}}, {}, {}, {}, {}, {}, 0.0, {}};
  const double cutoff = model_->largest_cutoff(), reach = std::max(options_.farthest, geometry_.buffer) + cutoff;
  double in_layer = 0.0;
  for (std::size_t i = 0; i < fluid.configuration.size(); ++i) {
    const Point position = fluid.configuration.position(i);
    const double from_face = distance(position[0]);
    if (from_face >= 0.0 && from_face < geometry_.buffer) near.in_buffer.push_back(i);
    if (from_face > reach) continue;
    if (from_face < 0.0) near.left.push_back(near.particles.size());
    if (from_face >= 0.0 && from_face <= options_.farthest) near.in_region.push_back(near.particles.size());
    if (from_face >= geometry_.buffer && from_face < geometry_.buffer + cutoff) in_layer += 1.0;
    near.particles.push_back(i);
    near.fluid.species.push_back(0);
    near.fluid.positions.insert(near.fluid.positions.end(), position.begin(), position.end());
  }
  near.density = in_layer / (geometry_.area * cutoff);
  return near;
}

double FaceExchange::heat(FluidState& fluid, const Neighbourhood& near, const FaceDemand& demand, double time) const {
  const double given = add_heat(fluid, near.in_buffer, mass_, sign() * demand.heat_flux * geometry_.area * time);
  if (options_.thermostat_rate == 0.0) return given;
  return given + redraw_velocities(fluid, near.in_buffer, mass_, demand.temperature,
                                   1.0 - std::exp(-options_.thermostat_rate * time),
                                   CounterRandom(options_.insertion.seed, RandomStream::flow), 2 * exchanges_ + face_);
}

FlowOutcome FaceExchange::settle(FluidState& fluid, Neighbourhood& near, const FaceDemand& demand, double owed, double now,
                                 double time, double mean_energy, FaceReport& report) {
  const double target = demand.energy.value_or(mean_energy);
  const double rate = insertion_rate(near.density, demand.temperature);
  allowed_ = std::min(allowed_ + rate * time, std::max(1.0, rate * time));
  const double now_in = std::clamp(owed, 0.0, std::floor(allowed_));
  allowed_ -= now_in;
  if (std::abs(owed) - now_in > std::max(10.0, rate * longest_lag)) return FlowOutcome::rate_too_high;
  if (owed < 0.0) take_out(fluid, near, static_cast<std::uint64_t>(-owed), target, report);
  return now_in > 0.0 ? put_in(fluid, near, demand, static_cast<std::uint64_t>(now_in), target, now, report)
                      : FlowOutcome::followed;
}

FlowOutcome FaceExchange::pass(FluidState& fluid, const FaceDemand& demand, double now, double time, double mean_energy,
                               FaceReport& report) {
  ++exchanges_;
  due_ += sign() * demand.mass_flux * geometry_.area * time;
  Neighbourhood near = neighbourhood(fluid);
  // While the indices of particles hold.
  const double heat = sign() * this->heat(fluid, near, demand, time);
  report.heat += heat;
  report.energy += heat;
  const double owed = std::floor(due_) - (passed_ - static_cast<double>(near.left.size()));
  if (near.left.empty() && owed == 0.0) return FlowOutcome::followed;
  if (near.particles.empty()) return FlowOutcome::no_particle;
  near.field.emplace(*model_, near.fluid, 0, kernel_table(isa_));
  take_out_left(fluid, near, report);
  const FlowOutcome outcome = settle(fluid, near, demand, owed, now, time, mean_energy, report);
  erase(fluid, std::move(near.gone));
  return outcome;
}

void FaceExchange::exchange(Archive& archive) {
  archive.enter(face_ == 0 ? "inlet" : "outlet");
  archive.field("due", due_);
  archive.field("passed", passed_);
  archive.field("allowed", allowed_);
  archive.field("exchanges", exchanges_);
  archive.field("left", counts_.left);
  archive.field("put_in", counts_.put_in);
  archive.field("taken_out", counts_.taken_out);
  history_.exchange(archive);
  archive.leave();
}

}  // namespace lanescape
