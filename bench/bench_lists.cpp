// Large systems: forces, energies, whole steps of molecular dynamics and of contour paths over neighbour lists, as functions of the
// numbers of particles and of threads.
//
//     bench_lists [--configuration=FILE] [--model=kob-andersen|lennard-jones] [--benchmark_...]
//
// Without a file: Kob-Andersen at density 1.2 and Lennard-Jones at density 0.8442, T = 1, both truncated at 2.5 sigma and shifted.
// Large liquids are periodic copies of a smaller one, so each particle has exactly the same surroundings as in the small liquid.
// The scalar reference verifies the gradients of 64 particles before anything is timed. Names that end in -mixed are in mixed
// precision.
//
// Counters: `ns_per_particle` per evaluation or step; `ns_per_pair` per pair within the cutoff, each counted once; `gflops` of the
// operations that such a pair needs at least, 15 multiply-adds (bench_landscape.cpp), 6 for the energy alone; `fraction_of_peak`
// relative to the measured rate of these operations on as many cores; `flops_per_byte`, where list, points, positions and gradients
// count once each; `bytes_per_particle` of the list and its data. The context has peak_gflops and memory_gb_per_second of one core.
// `sort_ns` and `rows_ns` are the two parts of a renewal: points and images sorted by cells, and neighbours found, per particle.

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <string_view>

#include "bench_support.hpp"
#include "core/available_threads.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "io/extended_xyz.hpp"
#include "neighbour/neighbour_list.hpp"
#include "neighbour/neighbour_rows.hpp"
#include "neighbour/periodic_points.hpp"
#include "path/finder.hpp"
#include "stepper/contour.hpp"
#include "verification/kernel_checks.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape::bench {
namespace {

constexpr double md_time_step = 0.005;

struct Size {
  std::size_t base, times;  // particles, and copies along each axis

  std::size_t particles() const { return base * times * times * times; }
};

constexpr Size sizes[] = {{256, 1}, {4000, 1}, {4000, 2}, {4000, 4}, {2048, 8}};

// A liquid whose gradient the reference has verified.
struct System {
  PairModel model;
  Configuration configuration;
  std::string wrong;  // the error of the gradient; empty if there is none
  double pairs = 0.0;
};

Configuration melt(const PairModel& model, std::size_t particles, double density) {
  Configuration configuration = melted(model, particles, density, {5.0, 1.0}, 1500, 100, 2e-3, available_isas().back());
  configuration.wrap();
  return configuration;
}

// A particle, stored first, and all particles within reach of it, in a box large enough to exclude other images.
Configuration surroundings(const Configuration& all, std::size_t particle, double reach) {
  Configuration near{{{100.0, 100.0, 100.0}}, {all.species[particle]}, {50.0, 50.0, 50.0}};
  for (std::size_t j = 0; j < all.size(); ++j) {
    std::array<double, 3> d{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      d[axis] = all.box.nearest_image(axis, all.positions[3 * j + axis] - all.positions[3 * particle + axis]);
    if (j == particle || d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > reach * reach) continue;
    near.species.push_back(all.species[j]);
    for (const double component : d) near.positions.push_back(50.0 + component);
  }
  return near;
}

// Mixed precision takes clusters where they are faster.
PairSearch search_of(Precision precision) { return precision == Precision::mixed ? PairSearch::automatic : PairSearch::list; }

std::string check_gradient(const System& system, Precision precision) {
  const ParticleLayout layout = ParticleLayout::in_space_order(system.configuration, system.model.species.size());
  PairInteraction interaction(system.model, system.configuration.box, layout, kernel_table(choose_isa("auto")),
                              {.search = search_of(precision), .precision = precision});
  AlignedArray in_slots(layout.dimension(), 0.0);
  interaction.gradient(layout.to_slots(system.configuration.positions), in_slots);
  const std::vector<double> gradient = layout.to_user(in_slots);
  const double allowed = precision == Precision::mixed ? tolerance::mixed_gradient : 1e-11;
  const std::size_t n = system.configuration.size();
  std::mt19937 choose(1);
  for (int k = 0; k < 64; ++k) {
    const std::size_t i = choose() % n;
    const reference::Evaluation expected =
        evaluate_reference(system.model, surroundings(system.configuration, i, system.model.cutoff));
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!(std::fabs(gradient[3 * i + axis] - expected.gradient[axis]) <= allowed * expected.gradient_magnitude[0]))
        return fmt::format("particle {}: gradient in {} precision {} where the reference has {}", i, to_string(precision),
                           gradient[3 * i + axis], expected.gradient[axis]);
  }
  return "";
}

// Pairs within the cutoff, each once.
double count_pairs(const NeighbourList& list, const PairModel& model) {
  std::size_t ends = 0;
  for (std::size_t b = 0; b < list.block_count(); ++b) {
    const kernels::NeighbourRows rows = list.rows_of(b);
    for_each_neighbour(rows, [&](std::size_t k, std::size_t species, std::uint32_t offset) {
      const double *row = rows.points + rows.rows[k], *point = rows.points + offset;
      const double cutoff = model.cutoff_of(model.pair(list.species_of(b), species));
      const double dx = point[0] - row[0], dy = point[1] - row[1], dz = point[2] - row[2];
      ends += dx * dx + dy * dy + dz * dz < cutoff * cutoff ? 1 : 0;
    });
  }
  return 0.5 * static_cast<double>(ends);
}

System verified(const PairModel& model, Configuration configuration) {
  System system{model, std::move(configuration), "", 0.0};
  const ParticleLayout layout = ParticleLayout::in_space_order(system.configuration, model.species.size());
  PairInteraction interaction(model, system.configuration.box, layout, kernel_table(choose_isa("auto")),
                              {.search = PairSearch::list});
  interaction.energy(layout.to_slots(system.configuration.positions));  // builds the list
  system.wrong = check_gradient(system, Precision::double_precision) + check_gradient(system, Precision::mixed);
  system.pairs = count_pairs(*interaction.list(), model);
  return system;
}

// Only one is kept at a time: the largest take hundreds of megabytes.
const System& system_of(const std::string& key, const std::function<System()>& make) {
  static std::string kept;
  static System system;
  if (kept != key) {
    system = make();
    kept = key;
  }
  return system;
}

using Source = std::function<const System&()>;

Source generated(const std::string& model_name, Size size) {
  return [=]() -> const System& {
    return system_of(fmt::format("{} {}", model_name, size.particles()), [&] {
      const PairModel model = named_pair_model(model_name);
      const Configuration base = melt(model, size.base, model_name == "kob-andersen" ? 1.2 : 0.8442);
      return verified(model, size.times == 1 ? base : repeated(base, size.times));
    });
  };
}

// Times every iteration of a benchmark by wall-clock time; seconds per iteration.
template <class Body>
double timed(benchmark::State& state, Body body) {
  double seconds = 0.0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    body();
    benchmark::ClobberMemory();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    state.SetIterationTime(taken.count());
    seconds += taken.count();
  }
  return seconds / static_cast<double>(state.iterations());
}

struct Setting {
  Source source;
  Isa isa;
  int threads;
  Precision precision = Precision::double_precision;

  PairSearchOptions search() const { return {.search = search_of(precision), .threads = threads, .precision = precision}; }
};

void set_time_counters(benchmark::State& state, const System& system, int threads, double seconds) {
  const auto n = static_cast<double>(system.configuration.size());
  state.counters["particles"] = n;
  state.counters["threads"] = threads;
  state.counters["ns_per_particle"] = 1e9 * seconds / n;
  state.counters["ns_per_pair"] = 1e9 * seconds / system.pairs;
  state.counters["pairs_in_range"] = system.pairs;
}

enum class Quantity { energy, force, all };

void evaluate(benchmark::State& state, Quantity quantity, const Setting& setting) {
  const System& system = setting.source();
  if (!system.wrong.empty()) return state.SkipWithError(system.wrong.c_str());
  const ParticleLayout layout = ParticleLayout::in_space_order(system.configuration, system.model.species.size());
  const AlignedArray positions = layout.to_slots(system.configuration.positions);
  AlignedArray gradient(layout.dimension(), 0.0);
  PairInteraction interaction(system.model, system.configuration.box, layout, kernel_table(setting.isa), setting.search());
  const auto once = [&] {
    if (quantity == Quantity::energy) benchmark::DoNotOptimize(interaction.energy(positions));
    if (quantity == Quantity::force) interaction.gradient(positions, gradient);
    if (quantity == Quantity::all) benchmark::DoNotOptimize(interaction.energy_and_gradient(positions, gradient).energy);
  };
  once();  // builds the list
  const double seconds = timed(state, once);
  set_time_counters(state, system, setting.threads, seconds);

  const double operations = 2.0 * (quantity == Quantity::energy ? 6.0 : 15.0) * system.pairs;
  const double peak = 2.0 * static_cast<double>(kernel_table(setting.isa).lanes) / seconds_per_vector_instruction(setting.isa);
  const auto n = static_cast<double>(system.configuration.size());
  state.counters["gflops"] = 1e-9 * operations / seconds;
  state.counters["fraction_of_peak"] = operations / seconds / peak / setting.threads;
  state.counters["bytes_per_particle"] = static_cast<double>(interaction.list_memory()) / n;
  if (interaction.list() == nullptr) return;
  const double bytes = 4.0 * static_cast<double>(interaction.list()->neighbours()) + (32.0 + 24.0 + 24.0) * n;
  state.counters["flops_per_byte"] = operations / bytes;
}

// What sorting the points of a list takes on average.
double sort_seconds(const System& system, const ParticleLayout& layout, const std::vector<double>& cutoffs, int threads,
                    const AlignedArray& here, const AlignedArray& there) {
  std::vector<double> margins(layout.blocks().size(), 0.0);
  for (std::size_t k = 0; k < cutoffs.size(); ++k)
    margins[k % margins.size()] = std::max(margins[k % margins.size()], cutoffs[k] + default_skin);
  PeriodicPoints points(system.configuration.box, layout, margins, threads);
  points.sort(here);  // takes memory
  const std::size_t times = std::max<std::size_t>(4, 400'000 / layout.size());
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k < times; ++k) points.sort(k % 2 == 0 ? there : here);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / static_cast<double>(times);
}

// Rebuilds the list: particles move forth and back by the skin.
void renew(benchmark::State& state, const Setting& setting) {
  const System& system = setting.source();
  const ParticleLayout layout = ParticleLayout::in_space_order(system.configuration, system.model.species.size());
  std::vector<double> cutoffs;
  for (const double sigma : system.model.sigma) cutoffs.push_back(system.model.cutoff * sigma);
  NeighbourList list(system.configuration.box, layout, cutoffs, default_skin, kernel_table(setting.isa), setting.threads);
  const AlignedArray here = layout.to_slots(system.configuration.positions);
  Configuration moved = system.configuration;
  for (double& x : moved.positions) x += default_skin;
  const AlignedArray there = layout.to_slots(moved.positions);
  bool away = false;
  const double seconds = timed(state, [&] {
    away = !away;
    list.update(away ? there : here);
  });
  if (list.rebuilds() != static_cast<std::uint64_t>(state.iterations()))
    return state.SkipWithError("the list was not always renewed");
  set_time_counters(state, system, setting.threads, seconds);
  const double sort = 1e9 / static_cast<double>(layout.size()) * sort_seconds(system, layout, cutoffs, setting.threads, here, there);
  state.counters["sort_ns"] = sort;
  state.counters["rows_ns"] = 1e9 * seconds / static_cast<double>(layout.size()) - sort;
}

// Whole steps of molecular dynamics at T = 1; lists are rebuilt when needed.
void step(benchmark::State& state, const Setting& setting) {
  const System& system = setting.source();
  const ParticleLayout layout = ParticleLayout::in_space_order(system.configuration, system.model.species.size());
  PairLandscape landscape(system.model, system.configuration.box, layout, setting.isa, setting.search());
  VelocityVerlet verlet(landscape, system.model, layout, layout.to_slots(system.configuration.positions), md_time_step);
  verlet.draw_velocities(1.0, 1);
  const auto total = [&] { return (verlet.potential_energy() + verlet.kinetic_energy()) / static_cast<double>(layout.size()); };
  for (int k = 0; k < 20; ++k) verlet.step();
  const double before = total();
  const double seconds = timed(state, [&] { verlet.step(); });
  if (!(std::fabs(total() - before) < 0.02)) return state.SkipWithError("the energy is not conserved");
  set_time_counters(state, system, setting.threads, seconds);
}

// Contour steps between two configurations of a trajectory, and the ratio of their time to that of V and its gradient.
void contour_step(benchmark::State& state, const Setting& setting) {
  const System& system = setting.source();
  const ParticleLayout layout = ParticleLayout::in_space_order(system.configuration, system.model.species.size());
  PairLandscape landscape(
      system.model, system.configuration.box, layout, setting.isa,
      {.search = search_of(setting.precision), .threads = setting.threads, .skin = path_skin, .precision = setting.precision});
  AlignedArray start = layout.to_slots(system.configuration.positions), goal, gradient(layout.dimension(), 0.0);
  {
    VelocityVerlet verlet(landscape, system.model, layout, start, 2e-3);
    verlet.draw_velocities(1.0, 1);
    for (int k = 0; k < 2000; ++k) verlet.step();
    goal = verlet.position();
  }
  const double energy = std::max(landscape.energy(start), landscape.energy(goal));
  PathFinder<ContourStepper> finder(landscape.algebra(), ContourStepper(landscape, energy, {}), start, goal, layout.size(), {});
  while (finder.detour_steps() < 100 && finder.outcome() == Outcome::running) finder.advance(1);
  const std::uint64_t first = finder.detour_steps();
  const double seconds = timed(state, [&] { finder.advance(1); });
  if (finder.outcome() != Outcome::running) return state.SkipWithError("the path has come to its end");
  if (10 * (finder.detour_steps() - first) < 9 * static_cast<std::uint64_t>(state.iterations()))
    return state.SkipWithError("less than nine tenths were contour steps");
  set_time_counters(state, system, setting.threads, seconds);
  double bare = 1e300;
  for (int k = 0; k < 50; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(landscape.energy_and_gradient(finder.position(), gradient));
    bare = std::min(bare, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  state.counters["x_force_and_energy"] = seconds / bare;
}

std::vector<int> thread_counts() {
  std::vector<int> counts;
  for (int t = 1; t <= default_threads(); t *= 2) counts.push_back(t);
  return counts;
}

void register_system(const std::string& model, std::size_t particles, const Source& source) {
  // Enough steps for several rebuilds of the list at any size.
  const auto steps = static_cast<benchmark::IterationCount>(std::max<std::size_t>(48, 1'000'000 / (particles + 1)));
  const auto add_in = [&](Precision precision, const std::string& what, Isa isa, int threads, auto body) {
    const auto name = fmt::format("{}/{}{}/N:{}/threads:{}/{}", model, what, precision == Precision::mixed ? "-mixed" : "",
                                  particles, threads, to_string(isa));
    const Setting setting{source, isa, threads, precision};
    auto* registered =
        benchmark::RegisterBenchmark(name.c_str(), [body, setting](benchmark::State& state) { body(state, setting); });
    registered->UseManualTime()->Unit(benchmark::kMicrosecond);
    if (what.starts_with("step")) registered->Iterations(steps);
  };
  const auto add = [&](const std::string& what, Isa isa, int threads, auto body) {
    add_in(Precision::double_precision, what, isa, threads, body);
    add_in(Precision::mixed, what, isa, threads, body);
  };
  for (const int threads : thread_counts())
    for (const Isa isa : available_isas()) {
      for (const auto& [what, quantity] : {std::pair{"energy", Quantity::energy}, std::pair{"force", Quantity::force},
                                           std::pair{"force+energy+virial", Quantity::all}})
        add(what, isa, threads, [quantity = quantity](benchmark::State& s, const Setting& set) { evaluate(s, quantity, set); });
      add_in(Precision::double_precision, "renew", isa, threads, renew);
      add("step", isa, threads, step);
      if (particles == 4000) add("contour_step", isa, threads, contour_step);
    }
}

// Removes --name=value from the arguments and returns the value; empty if it is not present.
std::string take_option(int& argc, char** argv, std::string_view name) {
  std::string value;
  int kept = 1;
  for (int k = 1; k < argc; ++k) {
    const std::string_view argument = argv[k];
    if (argument.starts_with(name) && argument.substr(name.size()).starts_with('='))
      value = argument.substr(name.size() + 1);
    else
      argv[kept++] = argv[k];
  }
  argc = kept;
  return value;
}

int run(int argc, char** argv) {
  const std::string file = take_option(argc, argv, "--configuration"), chosen = take_option(argc, argv, "--model");
  benchmark::AddCustomContext("peak_gflops",
                              fmt::format("{:.1f}", 2e-9 * static_cast<double>(kernel_table(choose_isa("auto")).lanes) /
                                                        seconds_per_vector_instruction(choose_isa("auto"))));
  benchmark::AddCustomContext("memory_gb_per_second",
                              fmt::format("{:.1f}", 1e-9 * bytes_per_second_from_memory(choose_isa("auto"))));
  if (!file.empty()) {
    const PairModel model = named_pair_model(chosen.empty() ? "kob-andersen" : chosen);
    const Configuration configuration = read_frames(file, model).front().configuration;
    const auto source = [=]() -> const System& { return system_of(file, [&] { return verified(model, configuration); }); };
    register_system(model.name, configuration.size(), source);
  } else {
    for (const std::string model : {"kob-andersen", "lennard-jones"})
      if (chosen.empty() || chosen == model)
        for (const Size size : sizes) register_system(model, size.particles(), generated(model, size));
  }
  return run_benchmarks(argc, argv);
}

}  // namespace
}  // namespace lanescape::bench

int main(int argc, char** argv) {
  try {
    return lanescape::bench::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_lists: {}\n", error.what());
    return 2;
  }
}
