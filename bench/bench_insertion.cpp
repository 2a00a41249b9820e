// Finds positions with a given energy in a Lennard-Jones fluid of 10^4 particles. Positions are checked against the scalar
// reference before anything is timed. Fluids are melted for 5 time units; the cutoff is 3 with long-range corrections; the target
// is the mean excess energy.

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bench_support.hpp"
#include "insertion/insertion.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape::bench {
namespace {

constexpr std::size_t particles = 10'000;

PairModel full_lennard_jones() {
  PairModel model = lennard_jones();
  model.cutoff = 3.0;
  model.truncation = Truncation::tail;
  return model;
}

struct Fluid {
  PairModel model = full_lennard_jones();
  Configuration configuration;
  double excess_energy = 0.0;
};

const Fluid& fluid_at(double density, double temperature) {
  static std::map<std::pair<double, double>, Fluid> made;
  const auto found = made.find({density, temperature});
  if (found != made.end()) return found->second;
  Fluid fluid;
  fluid.configuration = melted(fluid.model, particles, density, {temperature}, 2500, 50);
  fluid.configuration.wrap();
  const ParticleLayout layout = ParticleLayout::in_space_order(fluid.configuration, 1);
  PairInteraction interaction(fluid.model, fluid.configuration.box, layout, kernel_table(available_isas().front()));
  fluid.excess_energy = interaction.energy(layout.to_slots(fluid.configuration.positions)) / static_cast<double>(particles);
  return made.emplace(std::pair{density, temperature}, std::move(fluid)).first->second;
}

// Checks eight of the positions; exits if one does not have the recorded energy.
void check_places(const Fluid& fluid, const std::vector<Insertion>& places, const InsertionOptions& options) {
  for (std::size_t k = 0; k < places.size(); k += places.size() / 8) {
    const double energy = probe_reference(fluid.model, fluid.configuration, places[k].position, 0).energy;
    if (places[k].found && std::abs(energy - places[k].energy) < 1e-9 &&
        std::abs(energy - options.target) <= options.tolerance * std::abs(options.target))
      continue;
    std::fprintf(stderr, "bench_insertion: place %zu has energy %.12g, its record says %.12g\n", k, energy, places[k].energy);
    std::exit(1);
  }
}

InsertionOptions options_for(const Fluid& fluid, InsertionMethod method) {
  InsertionOptions options;
  options.target = fluid.excess_energy;
  options.method = method;
  return options;
}

// Time per position found in a fluid that does not change; density and temperature in hundredths.
void places(benchmark::State& state, InsertionMethod method) {
  const Fluid& fluid = fluid_at(0.01 * static_cast<double>(state.range(0)), 0.01 * static_cast<double>(state.range(1)));
  const ProbeField field(fluid.model, fluid.configuration, 0, kernel_table(choose_isa("auto")));
  const InsertionOptions options = options_for(fluid, method);
  constexpr std::size_t count = 1000;
  InsertionHistory checked;
  check_places(fluid, find_places(field, options, count, checked, 1), options);
  double evaluations = 0.0, searches = 0.0;
  for (auto _ : state) {
    InsertionHistory history;
    for (const Insertion& place : find_places(field, options, count, history, 1))
      evaluations += static_cast<double>(place.evaluations);
    searches += count;
  }
  state.counters["us_per_place"] = benchmark::Counter(searches * 1e-6, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["evaluations"] = evaluations / searches;
}

// Time per insertion, where inserted particles stay in the fluid: one per hundred present. Copying the fluid is not timed.
void insertions(benchmark::State& state, InsertionMethod method) {
  const Fluid& fluid = fluid_at(0.01 * static_cast<double>(state.range(0)), 0.01 * static_cast<double>(state.range(1)));
  const ProbeField field(fluid.model, fluid.configuration, 0, kernel_table(choose_isa("auto")));
  constexpr std::size_t count = particles / 100;
  double inserted = 0.0;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    state.PauseTiming();
    ProbeField copy = field;
    InsertionOptions options = options_for(fluid, method);
    options.seed = ++seed;
    InsertionHistory history;
    state.ResumeTiming();
    benchmark::DoNotOptimize(insert_particles(copy, options, count, history, 1));
    inserted += count;
  }
  state.counters["us_per_insertion"] =
      benchmark::Counter(inserted * 1e-6, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// One evaluation of energy and gradient at random positions, and of the energy alone.
void probes(benchmark::State& state) {
  const Fluid& fluid = fluid_at(0.01 * static_cast<double>(state.range(0)), 2.5);
  const ProbeField field(fluid.model, fluid.configuration, 0, kernel_table(choose_isa("auto")));
  const CounterRandom random(1, RandomStream::sites);
  std::uint64_t k = 0;
  for (auto _ : state) {
    ProbeField::Point place = random.uniform_point(k++, 0);
    for (std::size_t axis = 0; axis < 3; ++axis) place[axis] *= fluid.configuration.box.length[axis];
    benchmark::DoNotOptimize(field.sample(place));
  }
}

void register_all() {
  using enum InsertionMethod;
  for (const InsertionMethod method : {usher, usher_near, usher_indirect, screened, descent})
    for (const auto& [density, temperature] : {std::pair{40, 250}, std::pair{60, 300}, std::pair{80, 250}, std::pair{80, 100}})
      benchmark::RegisterBenchmark(("places/" + std::string(to_string(method))).c_str(), places, method)
          ->Args({density, temperature})
          ->Unit(benchmark::kMillisecond);
  for (const InsertionMethod method : {usher, screened})
    benchmark::RegisterBenchmark(("insertions/" + std::string(to_string(method))).c_str(), insertions, method)
        ->Args({80, 250})
        ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("probe", probes)->Arg(40)->Arg(80);
}

}  // namespace
}  // namespace lanescape::bench

int main(int argc, char** argv) {
  lanescape::bench::register_all();
  return lanescape::bench::run_benchmarks(argc, argv);
}
