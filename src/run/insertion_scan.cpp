#include "run/insertion_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "insertion/holes.hpp"
#include "insertion/search.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/probe_field.hpp"
#include "observables/statistics.hpp"
#include "observables/widom.hpp"

namespace lanescape {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Rows of plain numbers, as they are archived.
struct ScanRows {
  std::vector<double> states, costs, holes, errors, map;
};

// One combination of method, tolerance and step, over all configurations of a state.
struct Combination {
  InsertionOptions options;
  InsertionHistory history;
  std::vector<Insertion> places;
  double target_sum = 0.0, seconds = 0.0;

  void add_to(std::vector<double>& costs, const InsertionScanOptions::State& at, double configurations) const {
    double evaluations = 0.0, squares = 0.0, trials = 0.0, candidates = 0.0, distance = 0.0, largest = 0.0, error = 0.0,
           found = 0.0;
    for (const Insertion& place : places) {
      const auto n = static_cast<double>(place.evaluations);
      evaluations += n;
      squares += n * n;
      trials += static_cast<double>(place.trials);
      candidates += static_cast<double>(place.candidates);
      if (!place.found) continue;
      found += 1.0;
      distance += place.distance;
      largest = std::max(largest, place.distance);
      error += place.error;
    }
    const double n = static_cast<double>(places.size()), mean = evaluations / n;
    const double deviation = std::sqrt(std::max(0.0, squares / n - mean * mean)), per_found = 1.0 / std::max(1.0, found);
    costs.insert(costs.end(),
                 {at.density, at.temperature, static_cast<double>(options.method), options.tolerance,
                  options.largest_step.value_or(0.0), target_sum / configurations, mean, deviation / std::sqrt(n), deviation,
                  trials / n, candidates / n, distance * per_found, largest, error * per_found, n - found, seconds / n});
  }
};

class StateScan {
 public:
  StateScan(const PairModel& model, const InsertionScanOptions& options, Isa isa, std::size_t which)
      : model_(&model), options_(&options), isa_(isa), at_(options.states[which]), holes_(options.iso_energies.size()) {
    for (const InsertionMethod method : options.methods)
      for (const double tolerance : options.tolerances)
        for (const auto& step : options.largest_steps) {
          Combination combination{options.insertion, {}, {}};
          combination.options.method = method;
          combination.options.tolerance = tolerance;
          if (step) combination.options.largest_step = step;
          combinations_.push_back(std::move(combination));
        }
  }

  // False if the monitor stopped it.
  bool run(ScanRows& out, std::uint64_t states_done, RunMonitor& monitor) {
    MovingFluid fluid(*model_, fluid_on_lattice(*model_, options_->particles, at_.density, at_.temperature, options_->seed),
                      options_->time_step, isa_, options_->threads);
    equilibrate(fluid, at_.temperature, options_->equilibration_steps);
    for (std::uint64_t c = 0; c < options_->configurations; ++c) {
      equilibrate(fluid, at_.temperature, options_->between_steps);
      look_at(fluid, out);
      monitor.progress(
          "scan", static_cast<double>(states_done) + static_cast<double>(c + 1) / static_cast<double>(options_->configurations),
          static_cast<double>(options_->states.size()));
      if (monitor.stop_requested()) return false;
    }
    const Estimate widom = estimate_mean(widom_);
    out.states.insert(out.states.end(),
                      {at_.density, at_.temperature, estimate_mean(temperature_).value, estimate_mean(excess_).value,
                       estimate_mean(pressure_).value, widom.value, widom.error.value_or(0.0)});
    for (const Combination& combination : combinations_)
      combination.add_to(out.costs, at_, static_cast<double>(options_->configurations));
    for (std::size_t k = 0; k < holes_.size(); ++k) add_holes(out, k);
    if (options_->map_points > 0) add_map(fluid, out);
    return true;
  }

 private:
  void look_at(MovingFluid& fluid, ScanRows& out) {
    const MovingFluid::Potential potential = fluid.potential();
    const Configuration configuration = fluid.state().configuration;
    const double excess = potential.energy / static_cast<double>(configuration.size());
    temperature_.push_back(fluid.temperature());
    pressure_.push_back(potential.pressure);
    excess_.push_back(excess);
    const ProbeField field(*model_, configuration, options_->species, kernel_table(isa_));
    if (options_->widom_probes > 0)
      widom_.push_back(widom_chemical_potential(field, at_.temperature, options_->widom_probes,
                                                CounterRandom(options_->seed, RandomStream::sites), widom_.size() + 1));
    for (Combination& combination : combinations_) {
      InsertionOptions& with = combination.options;
      if (options_->target == ScanTarget::mean_excess_energy) with.target = excess;
      if (options_->target == ScanTarget::chemical_potential) with.target = widom_.back();
      combination.target_sum += with.target;
      const auto start = Clock::now();
      for (const Insertion& place : find_places(field, with, options_->count, combination.history, options_->threads))
        combination.places.push_back(place);
      combination.seconds += seconds_since(start);
    }
    look_at_holes(field, excess);
    trace_errors(field, excess, out);
  }

  // Holes around positions of the mean excess energy, as in [U].
  void look_at_holes(const ProbeField& field, double excess) {
    if (options_->holes == 0) return;
    InsertionOptions with = options_->insertion;
    with.target = excess;
    for (const Insertion& place : find_places(field, with, options_->holes, hole_history_, options_->threads))
      for (std::size_t k = 0; k < holes_.size() && place.found; ++k)
        if (const auto hole = measure_hole(field, place.position, options_->iso_energies[k])) holes_[k].push_back(*hole);
  }

  void add_holes(ScanRows& out, std::size_t which) const {
    const std::vector<Hole>& holes = holes_[which];
    // A few holes are long tubes, whose fits would dominate a mean.
    const auto median_of = [&](double Hole::* member) {
      std::vector<double> values;
      for (const Hole& hole : holes) values.push_back(hole.*member);
      return median(std::move(values));
    };
    out.holes.insert(out.holes.end(),
                     {at_.density, at_.temperature, options_->iso_energies[which], static_cast<double>(holes.size()),
                      median_of(&Hole::mean_radius), median_of(&Hole::semi_minor), median_of(&Hole::semi_major),
                      median_of(&Hole::anisotropy), median_of(&Hole::eccentricity), median_of(&Hole::open_directions)});
  }

  void trace_errors(const ProbeField& field, double excess, ScanRows& out) {
    InsertionOptions with = options_->insertion;
    with.target = excess;
    for (std::uint64_t k = 0; k < options_->traced_searches; ++k) {
      std::vector<double> errors;
      std::uint64_t trial = 0;
      InsertionSearch search(field, with, traced_++, 1e-12 * std::abs(excess), 100,
                             [&](std::uint64_t now, const InsertionSearch::Point&, double energy) {
                               if (now != trial) errors.clear();
                               trial = now;
                               errors.push_back(std::abs(energy - excess) / std::abs(excess));
                             });
      search.run();
      // Errors of the successful trial.
      for (std::size_t j = 0; j + 1 < errors.size() && search.result().found; ++j)
        out.errors.insert(out.errors.end(), {at_.density, errors[j], errors[j + 1]});
    }
  }

  // Rows of constant z, and in each increasing y. Both edges of the box are on the map: they are the same points.
  void add_map(MovingFluid& fluid, ScanRows& out) const {
    const Configuration configuration = fluid.state().configuration;
    const double target = fluid.potential().energy / static_cast<double>(configuration.size());
    const ProbeField field(*model_, configuration, options_->species, kernel_table(isa_));
    const std::uint64_t n = options_->map_points;
    std::vector<double> positions;
    for (std::uint64_t row = 0; row < n; ++row)
      for (std::uint64_t column = 0; column < n; ++column) {
        const auto part = [&](std::uint64_t k) { return static_cast<double>(k) / static_cast<double>(n - 1); };
        positions.insert(positions.end(), {0.0, part(column) * field.box().length[1], part(row) * field.box().length[2]});
      }
    std::vector<double> energies(n * n);
    field.energies(positions, energies);
    for (std::size_t k = 0; k < energies.size(); ++k)
      out.map.insert(out.map.end(),
                     {at_.density, at_.temperature, positions[3 * k + 1], positions[3 * k + 2], energies[k], target});
  }

  const PairModel* model_;
  const InsertionScanOptions* options_;
  Isa isa_;
  InsertionScanOptions::State at_;
  std::vector<Combination> combinations_;
  std::vector<double> temperature_, pressure_, excess_, widom_;  // per configuration
  InsertionHistory hole_history_;
  std::vector<std::vector<Hole>> holes_;  // by iso-energy
  std::uint64_t traced_ = 0;
};

InsertionScanResult result_of(const ScanRows& rows) {
  InsertionScanResult result;
  const auto for_each_row = [](const std::vector<double>& numbers, std::size_t width, auto action) {
    for (std::size_t k = 0; k + width <= numbers.size(); k += width) action(numbers.data() + k);
  };
  for_each_row(rows.states, 7, [&](const double* r) { result.states.push_back({r[0], r[1], r[2], r[3], r[4], r[5], r[6]}); });
  for_each_row(rows.costs, 16, [&](const double* r) {
    result.costs.push_back({r[0], r[1], static_cast<InsertionMethod>(static_cast<int>(r[2])), r[3], r[4], r[5], r[6], r[7], r[8],
                            r[9], r[10], r[11], r[12], r[13], r[14], r[15]});
  });
  for_each_row(rows.holes, 10,
               [&](const double* r) { result.holes.push_back({r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8], r[9]}); });
  for_each_row(rows.errors, 3, [&](const double* r) { result.errors.push_back({r[0], r[1], r[2]}); });
  for_each_row(rows.map, 6, [&](const double* r) { result.map.push_back({r[0], r[1], r[2], r[3], r[4], r[5]}); });
  return result;
}

// A scan, a state point at a time. A state point is not kept half done: an interrupted one is repeated.
class Scan final : public ResumableWork {
 public:
  Scan(const PairModel& model, const InsertionScanOptions& options, Isa isa) : model_(&model), options_(&options), isa_(isa) {}

  bool finished() const override { return done_ == options_->states.size(); }
  void advance(RunMonitor& monitor) override {
    ScanRows next = rows_;
    if (!StateScan(*model_, *options_, isa_, done_).run(next, done_, monitor)) return;
    rows_ = std::move(next);
    ++done_;
  }
  void exchange(Archive& archive) override {
    archive.field("states", rows_.states);
    archive.field("costs", rows_.costs);
    archive.field("holes", rows_.holes);
    archive.field("errors", rows_.errors);
    archive.field("map", rows_.map);
    archive.field("done", done_);
  }

  InsertionScanResult result(bool interrupted) const {
    InsertionScanResult result = result_of(rows_);
    result.interrupted = interrupted;
    result.seconds = clock().seconds();
    return result;
  }

 private:
  const PairModel* model_;
  const InsertionScanOptions* options_;
  Isa isa_;
  ScanRows rows_;
  std::uint64_t done_ = 0;
};

}  // namespace

void InsertionScanOptions::check(const PairModel& model) const {
  check_at_least_one("number of configurations", configurations);
  check_at_least_one("number of places", count);
  check_at_least_one("number of states", states.size());
  if (!(time_step > 0.0 && time_step <= 0.02))
    throw_bad_input(fmt::format("time step {} is not allowed: above 0 and at most 0.02, or energy is not conserved", time_step));
  constexpr std::uint64_t most_map_points = 1000;  // a million rows of map.csv for each state
  if (map_points == 1 || map_points > most_map_points)
    throw_bad_input(
        fmt::format("number of map points {} is not allowed: 0, or 2 to {} along each edge", map_points, most_map_points));
  if (target == ScanTarget::chemical_potential && widom_probes == 0)
    throw_bad_input("a target of the chemical potential needs Widom probes: their number must be at least 1");
  for (const State& state : states) {
    check_positive("temperature", state.temperature);
    const Configuration start = fcc_start(model, particles, state.density, seed);
    check_cutoff(model, start.box);
    insertion.check(start.box);
  }
  InsertionOptions varied = insertion;
  varied.region.reset();  // checked in each box
  for (const double tolerance : tolerances)
    for (const auto& step : largest_steps) {
      varied.tolerance = tolerance;
      varied.largest_step = step;
      varied.check({});
    }
}

InsertionScanResult run_insertion_scan(const PairModel& model, const InsertionScanOptions& options, Isa isa,
                                       const CheckpointOptions& checkpoint, RunMonitor& monitor) {
  options.check(model);
  Scan work(model, options, isa);
  return work.result(run_to_end(work, "scan.h5", checkpoint, monitor));
}

}  // namespace lanescape
