#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/hard_sphere_model.hpp"
#include "configuration/lattice.hpp"
#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/event_driven.hpp"
#include "dynamics/hard_sphere_start.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "landscape/pair_landscape.hpp"

namespace lanescape::bench {

inline PairModel kob_andersen_with(ImageRule images) {
  PairModel model = kob_andersen();
  model.images = images;
  return model;
}

// A liquid made from a lattice: `steps` steps of molecular dynamics at each of these temperatures, with velocities rescaled every
// `rescale_interval` steps. With the default instruction set the result has the same bits whichever kernels are timed later.
inline Configuration melted(const PairModel& model, std::size_t particles, double density,
                            std::initializer_list<double> temperatures, int steps, int rescale_interval, double time_step = 2e-3,
                            Isa isa = available_isas().front()) {
  Configuration configuration = fcc_start(model, particles, density, 1);
  const ParticleLayout layout = ParticleLayout::in_space_order(configuration, model.species.size());
  PairLandscape landscape(model, configuration.box, layout, isa);
  VelocityVerlet verlet(landscape, model, layout, layout.to_slots(configuration.positions), time_step);
  verlet.draw_velocities(*temperatures.begin(), 1);
  for (const double temperature : temperatures)
    for (int step = 0; step < steps; ++step) {
      if (step % rescale_interval == 0) verlet.rescale_to(temperature);
      verlet.step();
    }
  configuration.positions = layout.to_user(verlet.position());
  return configuration;
}

// Periodic copies of a configuration: each particle has exactly the same surroundings as in the base.
inline Configuration repeated(const Configuration& base, std::size_t times) {
  Configuration whole{base.box, {}, {}};
  for (double& length : whole.box.length) length *= static_cast<double>(times);
  for (std::size_t cell = 0; cell < times * times * times; ++cell) {
    const std::array<std::size_t, 3> at = {cell / (times * times), cell / times % times, cell % times};
    whole.species.insert(whole.species.end(), base.species.begin(), base.species.end());
    whole.radii.insert(whole.radii.end(), base.radii.begin(), base.radii.end());
    for (std::size_t k = 0; k < base.positions.size(); ++k)
      whole.positions.push_back(base.positions[k] + static_cast<double>(at[k % 3]) * base.box.length[k % 3]);
  }
  return whole;
}

// A Kob-Andersen liquid of density 1.2: melted for 5 time units at T = 5 and then cooled for 5 time units at T = 1.
inline const Configuration& liquid(std::size_t particles) {
  static std::map<std::size_t, Configuration> made;
  const auto found = made.find(particles);
  if (found != made.end()) return found->second;
  return made.emplace(particles, melted(kob_andersen(), particles, 1.2, {5.0, 1.0}, 5000, 500, 1e-3)).first->second;
}

// A liquid of hard spheres: grown from a dilute melt and equilibrated for 200 collisions per particle. It has the same bits
// whichever kernels are timed later.
inline const Configuration& hard_liquid(const HardSphereModel& model, std::size_t particles, double packing_fraction) {
  static std::map<std::tuple<std::string, std::size_t, double>, Configuration> made;
  const auto key = std::make_tuple(model.name, particles, packing_fraction);
  const auto found = made.find(key);
  if (found != made.end()) return found->second;
  SilentMonitor monitor;
  Configuration start =
      *make_hard_sphere_start(model, particles, packing_fraction, StartMethod::growth, 1, available_isas().front(), monitor);
  EventDriven dynamics(start, std::vector<double>(particles, 1.0), kernel_table(available_isas().front()));
  dynamics.draw_velocities(1);
  for (std::size_t k = 0; k < 200 * particles; ++k) dynamics.collide();
  dynamics.positions(0.5 * (dynamics.time() + dynamics.next_event_time()), start.positions);
  return made.emplace(key, std::move(start)).first->second;
}

// Seconds per multiply-add of whole vectors with all pipes full: the best of many short runs of a loop without other work. Without
// fma (SSE2 and the portable instruction set) one multiply-add counts as a product and a sum.
inline double seconds_per_vector_instruction(Isa isa) {
  static std::map<Isa, double> measured;
  const auto found = measured.find(isa);
  if (found != measured.end()) return found->second;
  const kernels::KernelTable& table = kernel_table(isa);
  double best = 1.0, sink = 0.0;
  for (int run = 0; run < 200; ++run) {
    const auto start = std::chrono::steady_clock::now();
    const double operations = table.peak_rounds(20'000, &sink);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    benchmark::DoNotOptimize(sink);
    best = std::min(best, seconds.count() * 2.0 * static_cast<double>(table.lanes) / operations);
  }
  return measured.emplace(isa, best).first->second;
}

// Bytes per second that one core reads from memory: the best of several passes over an array that no cache holds.
inline double bytes_per_second_from_memory(Isa isa) {
  const std::size_t count = std::size_t{1} << 24;  // 128 MiB each
  const AlignedArray a(count, 1.0), b(count, 1.0);
  double best = 1e300;
  for (int run = 0; run < 4; ++run) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(kernel_table(isa).dot(a.data(), b.data(), count));
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return static_cast<double>(2 * count * sizeof(double)) / best;
}

// Registers a benchmark of one whole run that sets its own time.
template <class Function>
void register_run(const std::string& name, Function function) {
  benchmark::RegisterBenchmark(name.c_str(), std::move(function))->Iterations(1)->UseManualTime()->Unit(benchmark::kSecond);
}

// The main function of a benchmark; returns 2 for unknown arguments.
inline int run_benchmarks(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace lanescape::bench
