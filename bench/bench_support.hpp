#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/hard_sphere_model.hpp"
#include "configuration/lattice.hpp"
#include "configuration/lennard_jones_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/event_driven.hpp"
#include "dynamics/hard_sphere_start.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "landscape/lennard_jones_landscape.hpp"

namespace lanescape::bench {

inline LennardJonesModel kob_andersen_with(ImageRule images) {
  LennardJonesModel model = kob_andersen();
  model.images = images;
  return model;
}

// A Kob-Andersen liquid of density 1.2: a lattice melted for 5 time units at T = 5 and cooled for as many at T = 1. The same bits
// whichever kernels are timed later, since the least instruction set makes it.
inline const Configuration& liquid(std::size_t particles) {
  static std::map<std::size_t, Configuration> made;
  const auto found = made.find(particles);
  if (found != made.end()) return found->second;
  const LennardJonesModel model = kob_andersen();
  Configuration configuration = fcc_start(model, particles, 1.2, 1);
  const ParticleLayout layout(configuration.species, model.species.size());
  LennardJonesLandscape landscape(model, configuration.box, layout, available_isas().front());
  VelocityVerlet verlet(landscape, model, layout, layout.to_slots(configuration.positions), 1e-3);
  verlet.draw_velocities(5.0, 1);
  for (const double temperature : {5.0, 1.0})
    for (int step = 0; step < 5000; ++step) {
      if (step % 500 == 0) verlet.rescale_to(temperature);
      verlet.step();
    }
  configuration.positions = layout.to_user(verlet.position());
  return made.emplace(particles, std::move(configuration)).first->second;
}

// A liquid of hard spheres: grown from a dilute melt and equilibrated for 200 collisions per particle. The same bits whichever
// kernels are timed later.
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

// Seconds per multiply-add of whole vectors with all pipes full, the best of many short runs: what a loop that does nothing
// else takes on this machine. Without fma, SSE2 and the portable leg, one counts for a product and a sum.
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

// What a benchmark's main does; 2 for arguments it does not know.
inline int run_benchmarks(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace lanescape::bench
