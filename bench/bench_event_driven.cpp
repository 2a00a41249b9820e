// Collisions per second of event-driven dynamics in a liquid of hard spheres, for every available instruction set. Each run is
// checked before it is timed: no overlap beyond rounding, energy and momentum conserved, and the same bits as with the simplest
// instruction set.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bench_support.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"

namespace lanescape::bench {
namespace {

constexpr std::uint64_t checked_collisions = 200'000, timed_collisions = 1'000'000;
constexpr std::uint64_t most_before_timing = 2'000'000;
constexpr std::size_t largest_grown = 4000;

// A liquid of `times`^3 copies of a smaller one, which velocities make different, with particles in random order: after long runs
// neighbours are not near in the user's order.
Configuration large_liquid(const HardSphereModel& model, std::size_t times, double packing_fraction) {
  const Configuration whole = repeated(hard_liquid(model, largest_grown, packing_fraction), times);
  std::vector<std::size_t> order(whole.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(1));
  Configuration mixed = whole;
  for (std::size_t i = 0; i < order.size(); ++i) {
    mixed.radii[i] = whole.radii[order[i]];
    std::copy_n(&whole.positions[3 * order[i]], 3, &mixed.positions[3 * i]);
  }
  return mixed;
}

EventDriven start(const HardSphereModel& model, std::size_t particles, double packing_fraction, Isa isa) {
  const auto times = static_cast<std::size_t>(std::lround(std::cbrt(static_cast<double>(particles) / largest_grown)));
  EventDriven dynamics(
      particles > largest_grown ? large_liquid(model, times, packing_fraction) : hard_liquid(model, particles, packing_fraction),
      std::vector<double>(particles, 1.0), kernel_table(isa));
  dynamics.draw_velocities(2);
  return dynamics;
}

std::string check(const HardSphereModel& model, std::size_t particles, double packing_fraction, Isa isa) {
  EventDriven dynamics = start(model, particles, packing_fraction, isa);
  const double energy = dynamics.kinetic_energy();
  EventDriven least = start(model, particles, packing_fraction, available_isas().front());
  for (std::uint64_t k = 0; k < checked_collisions; ++k) {
    dynamics.collide();
    least.collide();
  }
  dynamics.resynchronise();
  least.resynchronise();
  if (dynamics.positions() != least.positions()) return "not the same bits as with the least instruction set";
  if (std::fabs(dynamics.kinetic_energy() / energy - 1.0) > 1e-12) return "energy is not conserved";
  for (const double p : dynamics.momentum())
    if (std::fabs(p) > 1e-10) return "momentum is not conserved";
  const Configuration now = dynamics.configuration();
  const ParticleLayout layout(now.species, 1);
  HardSphereOverlap overlap(now.box, layout, now.radii, kernel_table(isa));
  const double gap = overlap.smallest_gap(layout.to_slots(now.positions));
  return gap < -1e-12 ? fmt::format("spheres overlap by {}", -gap) : "";
}

void collide(benchmark::State& state, const HardSphereModel& model, std::size_t particles, double packing_fraction, Isa isa) {
  if (const std::string wrong = check(model, particles, packing_fraction, isa); !wrong.empty())
    return state.SkipWithError(wrong.c_str());
  EventDriven dynamics = start(model, particles, packing_fraction, isa);
  for (std::uint64_t k = 0; k < std::min<std::uint64_t>(50 * particles, most_before_timing); ++k) dynamics.collide();
  const auto before = dynamics.statistics();
  for (auto _ : state)
    for (std::uint64_t k = 0; k < timed_collisions; ++k) dynamics.collide();
  const double collisions = static_cast<double>(state.iterations()) * static_cast<double>(timed_collisions);
  const auto& after = dynamics.statistics();
  state.counters["collisions_per_second"] = benchmark::Counter(collisions, benchmark::Counter::kIsRate);
  state.counters["predictions_per_collision"] = static_cast<double>(after.predictions - before.predictions) / collisions;
  state.counters["list_renewals_per_collision"] = static_cast<double>(after.shell_exits - before.shell_exits) / collisions;
  state.counters["neighbours"] = dynamics.mean_neighbours();
}

void register_all() {
  struct Case {
    const char* name;
    HardSphereModel model;
    std::size_t particles;
    double packing_fraction;
  };
  for (const Case& c : {Case{"mono", hard_sphere(), 108, 0.49}, Case{"mono", hard_sphere(), 4000, 0.49},
                        Case{"mono", hard_sphere(), 32'000, 0.45}, Case{"mono", hard_sphere(), 256'000, 0.45},
                        Case{"binary", hard_sphere_binary(), 4000, 0.55}, Case{"binary", hard_sphere_binary(), 108, 0.57}})
    for (const Isa isa : available_isas())
      benchmark::RegisterBenchmark(
          fmt::format("collisions/{}/N:{}/phi:{:.2f}/{}", c.name, c.particles, c.packing_fraction, to_string(isa)).c_str(),
          [c, isa](benchmark::State& state) { collide(state, c.model, c.particles, c.packing_fraction, isa); })
          ->Unit(benchmark::kSecond)
          ->Iterations(3);
}

}  // namespace
}  // namespace lanescape::bench

int main(int argc, char** argv) {
  lanescape::bench::register_all();
  return lanescape::bench::run_benchmarks(argc, argv);
}
