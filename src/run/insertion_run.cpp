#include "run/insertion_run.hpp"

#include <algorithm>
#include <utility>

#include "configuration/particle_layout.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "core/random.hpp"
#include "core/stopwatch.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/probe_field.hpp"

namespace lanescape {
namespace {

double mean_excess_energy(const PairModel& model, const Configuration& fluid, Isa isa) {
  const ParticleLayout layout = ParticleLayout::in_space_order(fluid, model.species.size());
  return PairInteraction(model, fluid.box, layout, kernel_table(isa)).energy(layout.to_slots(fluid.positions)) /
         static_cast<double>(fluid.size());
}

void insert(InsertionRunResult& run, const PairModel& model, const InsertionRunOptions& options, const InsertionOptions& insertion,
            Isa isa, RunMonitor& monitor) {
  constexpr std::uint64_t batch = 64;  // insertions between two looks at the monitor
  const double mass = model.species[static_cast<std::size_t>(options.species)].mass;
  ProbeField field(model, run.fluid, options.species, kernel_table(isa), options.diameter);
  InsertionHistory history;
  const CounterRandom random(insertion.seed, RandomStream::insertion);
  for (std::uint64_t done = 0; done < options.count && !run.interrupted;) {
    const std::uint64_t wanted = std::min(batch, options.count - done);
    for (const Insertion& one : insert_particles(field, insertion, wanted, history, options.threads)) {
      run.evaluations += one.evaluations;
      if (!one.found) {
        ++run.failures;
        continue;
      }
      if (options.temperature)
        run.velocities.push_back(maxwellian_velocity(random, run.insertions.size(), *options.temperature, mass));
      run.insertions.push_back(one);
      run.fluid.species.push_back(options.species);
      if (model.form->has_diameters) run.fluid.diameters.push_back(options.diameter);
      run.fluid.positions.insert(run.fluid.positions.end(), one.position.begin(), one.position.end());
    }
    done += wanted;
    monitor.progress("insertion", static_cast<double>(done), static_cast<double>(options.count));
    run.interrupted = monitor.stop_requested() && done < options.count;
  }
}

void remove(InsertionRunResult& run, const PairModel& model, const InsertionRunOptions& options, const InsertionOptions& insertion,
            Isa isa) {
  const CounterRandom random(insertion.seed, RandomStream::insertion);
  for (std::uint64_t k = 0; k < options.removals && !run.interrupted; ++k) {
    const auto removal =
        choose_removal(model, run.fluid, options.species, options.removal, insertion.region, insertion.target, random, k, isa);
    if (!removal) {
      run.failures += options.removals - k;
      return;
    }
    const auto at = static_cast<std::ptrdiff_t>(removal->particle);
    run.removals.push_back({run.fluid.position(removal->particle), removal->energy});
    run.fluid.species.erase(run.fluid.species.begin() + at);
    if (model.form->has_diameters) run.fluid.diameters.erase(run.fluid.diameters.begin() + at);
    run.fluid.positions.erase(run.fluid.positions.begin() + 3 * at, run.fluid.positions.begin() + 3 * at + 3);
  }
}

}  // namespace

void InsertionRunOptions::check(const PairModel& model, const Configuration& fluid) const {
  if (fluid.size() == 0) throw_bad_input("insertion into an empty fluid is not allowed: at least one particle is needed");
  if (temperature) check_positive("temperature", *temperature);
  check_positive("diameter", diameter);
  insertion.check(fluid.box);
  ProbeField(model, {fluid.box, {}, {}}, species, kernel_table(available_isas().front()),
             diameter);  // throws what box and model do not allow
}

InsertionRunResult run_insertion(const PairModel& model, Configuration fluid, const InsertionRunOptions& options, Isa isa,
                                 RunMonitor& monitor) {
  options.check(model, fluid);
  Stopwatch clock;
  InsertionOptions insertion = options.insertion;
  if (options.mean_target) insertion.target = mean_excess_energy(model, fluid, isa);
  InsertionRunResult run;
  run.fluid = std::move(fluid);
  run.target = insertion.target;
  insert(run, model, options, insertion, isa, monitor);
  remove(run, model, options, insertion, isa);
  clock.lap();
  run.seconds = clock.seconds();
  return run;
}

}  // namespace lanescape
