// State-probability interactions: three passes over pairs compared with one pass of plain Lennard-Jones on the same liquid, as
// functions of the numbers of particles and of threads. In scalar code: three passes compared with the nested evaluation that they
// replace, on the same list.
//
//     bench_state_mixture [--benchmark_...]
//
// A Lennard-Jones liquid at density 0.8 and T = 1 with two states, whose local densities and potentials reach 2.5 sigma, with the
// entropy term. Both forms of the scalar reference verify energy and gradient of 500 particles before anything is timed.
//
// Counters: `ns_per_particle` per evaluation of energy and gradient. scalar_passes gives for each cutoff the number of neighbours
// in the list and the time of the nested evaluation divided by that of three passes. `exponent_*` is the slope of log(time) against
// log(neighbours): 1 for a time linear in neighbours and 2 for a quadratic one.

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <string>

#include "bench_support.hpp"
#include "interaction/state/local_density.hpp"
#include "interaction/state/state_mixture.hpp"
#include "neighbour/neighbour_rows.hpp"
#include "verification/state_mixture_checks.hpp"

namespace lanescape::bench {
namespace {

constexpr double density = 0.8;

// Potentials and densities have the same cutoff.
StateMixtureModel two_states(double cutoff) {
  StateMixtureModel model = liquid_vapour();
  model.cutoff = model.states[0].switching.cutoff = cutoff;
  // Parameters near the middle, where nothing is saturated: two thirds of the neighbours within the cutoff.
  const double neighbours = 4.0 / 3.0 * std::numbers::pi * density * cutoff * cutoff * cutoff;
  model.states[0].switching.threshold = 0.9 * cutoff;
  model.states[0].switching.width = 0.1 * cutoff;
  model.states[0].steps[0] = {0.6 * neighbours, 0.2 * neighbours};
  model.states[0].mu = {0.0, 0.3};
  model.entropy_temperature = 1.0;
  return model;
}

const Configuration& small_liquid(std::size_t particles) {
  static std::map<std::size_t, Configuration> made;
  const auto found = made.find(particles);
  if (found != made.end()) return found->second;
  Configuration liquid = melted(lennard_jones(), particles, density, {3.0, 1.0}, 1000, 100);
  liquid.wrap();
  return made.emplace(particles, std::move(liquid)).first->second;
}

// Periodic copies of 4000 particles.
Configuration liquid_of(std::size_t times) { return repeated(small_liquid(4000), times); }

// The neighbours of a list, including the skin, in the reference's format.
reference::StateNeighbours neighbours_of(const NeighbourList& list, const ParticleLayout& layout, const Configuration& c) {
  std::vector<std::size_t> particle_of(layout.slots());
  for (std::size_t i = 0; i < layout.size(); ++i) particle_of[layout.slot_of(i)] = i;
  reference::StateNeighbours neighbours(layout.size());
  for (std::size_t b = 0; b < list.block_count(); ++b) {
    const kernels::NeighbourRows rows = list.rows_of(b);
    for_each_neighbour(rows, [&](std::size_t row, std::size_t, std::uint32_t offset) {
      const std::size_t i = particle_of[list.slot_at(rows.rows[row])], j = particle_of[list.slot_at(offset)];
      std::array<double, 3> shift;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = rows.points[rows.rows[row] + axis] - rows.points[offset + axis];
        shift[axis] = c.positions[3 * i + axis] - c.positions[3 * j + axis] - d;
      }
      neighbours[i].push_back({j, shift});
    });
  }
  return neighbours;
}

// Empty if the kernels' three passes, the reference's three passes and its nested evaluation agree on 500 particles.
const std::string& verdict() {
  static const std::string wrong = [] {
    const Configuration& c = small_liquid(500);
    const ParticleLayout layout(c.species, 1);
    const StateMixtureModel model = two_states(2.5);
    StateMixture interaction(model, c.box, layout, kernel_table(choose_isa("auto")), {});
    AlignedArray g(layout.dimension());
    const double energy = interaction.energy_and_gradient(layout.to_slots(c.positions), g).energy;
    const std::vector<double> gradient = layout.to_user(g);
    const reference::StateSystem system = reference_system(model, SwitchingForm::spline);
    const auto neighbours = neighbours_of(interaction.list(), layout, c);
    for (const auto& expected : {reference::three_passes(c.positions, c.species, system, neighbours),
                                 reference::nested(c.positions, c.species, system, neighbours)}) {
      if (!(std::abs(energy - expected.energy) <= 1e-12 * expected.magnitude))
        return fmt::format("energy {} where the reference has {}", energy, expected.energy);
      for (std::size_t k = 0; k < gradient.size(); ++k)
        if (!(std::abs(gradient[k] - expected.gradient[k]) <= 1e-11 * expected.gradient_magnitude[k / 3]))
          return fmt::format("gradient {} where the reference has {}", gradient[k], expected.gradient[k]);
    }
    return std::string();
  }();
  return wrong;
}

void per_particle(benchmark::State& state, std::size_t particles) {
  using benchmark::Counter;
  state.counters["ns_per_particle"] =
      Counter(1e-9 * static_cast<double>(particles), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void time_lennard_jones(benchmark::State& state, std::size_t times, int threads) {
  if (!verdict().empty()) return state.SkipWithError(verdict().c_str());
  const Configuration c = liquid_of(times);
  const ParticleLayout layout = ParticleLayout::in_space_order(c, 1);
  const AlignedArray positions = layout.to_slots(c.positions);
  PairInteraction interaction(lennard_jones(), c.box, layout, kernel_table(choose_isa("auto")),
                              {.search = PairSearch::list, .threads = threads});
  AlignedArray gradient(layout.dimension());
  interaction.energy_and_gradient(positions, gradient);  // builds the list
  for (auto _ : state) benchmark::DoNotOptimize(interaction.energy_and_gradient(positions, gradient));
  per_particle(state, c.size());
}

void time_three_passes(benchmark::State& state, std::size_t times, int threads) {
  if (!verdict().empty()) return state.SkipWithError(verdict().c_str());
  const Configuration c = liquid_of(times);
  const ParticleLayout layout = ParticleLayout::in_space_order(c, 1);
  const AlignedArray positions = layout.to_slots(c.positions);
  StateMixture::Options options;
  options.threads = threads;
  StateMixture interaction(two_states(2.5), c.box, layout, kernel_table(choose_isa("auto")), options);
  AlignedArray gradient(layout.dimension());
  interaction.energy_and_gradient(positions, gradient);  // builds the list
  for (auto _ : state) benchmark::DoNotOptimize(interaction.energy_and_gradient(positions, gradient));
  per_particle(state, c.size());
}

// A single pass.
enum class Pass { density, pairs, density_force };

void time_pass(benchmark::State& state, Pass pass) {
  const Configuration c = liquid_of(2);
  const ParticleLayout layout = ParticleLayout::in_space_order(c, 1);
  StateMixtureParts parts = make_parts(two_states(2.5));
  Sites sites(c.box, layout, {2.5}, 2, kernel_table(choose_isa("auto")), {1, default_skin});
  sites.move_to(layout.to_slots(c.positions));
  AlignedArray gradient(layout.dimension()), slopes(2 * layout.slots()), values(layout.slots(), 0.5);
  std::fill(sites.site_states().p.begin(), sites.site_states().p.end(), 0.5);
  sites.put_states();
  parts.order_parameter->evaluate(sites, values);  // builds the list of near neighbours
  std::fill(values.begin(), values.end(), 0.5);
  StateSums sums{StateSums::Wanted::gradient, gradient, slopes};
  for (auto _ : state) {
    if (pass == Pass::density) parts.order_parameter->evaluate(sites, values);
    if (pass == Pass::pairs) parts.potentials[0]->add(sites, sums);
    if (pass == Pass::density_force) parts.order_parameter->add_gradient(sites, values, sums);
    benchmark::ClobberMemory();
  }
  per_particle(state, c.size());
}

double seconds_of(const std::function<void()>& action) {
  double best = 1e300;
  for (int run = 0; run < 3; ++run) {
    const auto start = std::chrono::steady_clock::now();
    action();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

// The slope of a least-squares line.
double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    sx += x[k];
    sy += y[k];
    sxx += x[k] * x[k];
    sxy += x[k] * y[k];
  }
  const auto n = static_cast<double>(x.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void time_scalar_passes(benchmark::State& state) {
  if (!verdict().empty()) return state.SkipWithError(verdict().c_str());
  const Configuration& c = small_liquid(500);
  const ParticleLayout layout(c.species, 1);
  std::vector<double> neighbours_log, three_log, nested_log;
  for (auto _ : state)
    for (const double cutoff : {1.5, 2.0, 2.5, 3.0}) {
      const StateMixtureModel model = two_states(cutoff);
      StateMixture interaction(model, c.box, layout, kernel_table(choose_isa("auto")), {});
      interaction.energy(layout.to_slots(c.positions));
      const auto neighbours = neighbours_of(interaction.list(), layout, c);
      const reference::StateSystem system = reference_system(model, SwitchingForm::exact);
      const auto n = static_cast<double>(c.size()), in_list = static_cast<double>(interaction.list().neighbours()) / n;
      const double three = seconds_of([&] { reference::three_passes(c.positions, c.species, system, neighbours); });
      const double nested = seconds_of([&] { reference::nested(c.positions, c.species, system, neighbours); });
      const auto counter = [&](const char* name) -> benchmark::Counter& {
        return state.counters[fmt::format("{}_{}", name, cutoff)];
      };
      counter("neighbours") = in_list;
      counter("ratio") = nested / three;
      counter("three_us_per_particle") = 1e6 * three / n;
      counter("nested_us_per_particle") = 1e6 * nested / n;
      neighbours_log.push_back(std::log(in_list));
      three_log.push_back(std::log(three));
      nested_log.push_back(std::log(nested));
    }
  state.counters["exponent_three"] = slope_of(neighbours_log, three_log);
  state.counters["exponent_nested"] = slope_of(neighbours_log, nested_log);
}

void register_all() {
  for (const std::size_t times : {1U, 2U, 4U})
    for (const int threads : {1, 2}) {
      const std::string size = fmt::format("N={}/threads={}", 4000 * times * times * times, threads);
      benchmark::RegisterBenchmark(("lennard_jones/" + size).c_str(), time_lennard_jones, times, threads)->UseRealTime();
      benchmark::RegisterBenchmark(("three_passes/" + size).c_str(), time_three_passes, times, threads)->UseRealTime();
    }
  benchmark::RegisterBenchmark("pass/density", time_pass, Pass::density);
  benchmark::RegisterBenchmark("pass/pairs", time_pass, Pass::pairs);
  benchmark::RegisterBenchmark("pass/density_force", time_pass, Pass::density_force);
  benchmark::RegisterBenchmark("scalar_passes", time_scalar_passes)->Iterations(1);
}

}  // namespace
}  // namespace lanescape::bench

int main(int argc, char** argv) {
  lanescape::bench::register_all();
  return lanescape::bench::run_benchmarks(argc, argv);
}
