// Tests whether a whole configuration of hard spheres overlaps: from scratch over all pairs and by cells, and over the path
// finder's list. The liquid has no overlaps, so an early exit does not help. Every available instruction set, and the scalar
// reference for comparison.

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "bench_support.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"
#include "landscape/hard_sphere_landscape.hpp"
#include "reference/hard_sphere.hpp"

namespace lanescape::bench {
namespace {

enum class Form { all_pairs, cells, list };

// Checks these kernels on this liquid and on one where a particle overlaps its neighbour; returns the error, or an empty string.
std::string check(const Configuration& liquid, Isa isa) {
  Configuration squeezed = liquid;
  for (double& radius : squeezed.radii) radius *= 1.01;
  for (const Configuration* c : {&liquid, static_cast<const Configuration*>(&squeezed)}) {
    const ParticleLayout layout(c->species, 2);
    HardSphereLandscape landscape(c->box, layout, c->radii, isa);
    const AlignedArray positions = layout.to_slots(c->positions);
    const auto expected = reference::overlaps(c->positions, c->radii, c->box.length);
    for (const SpherePairSearch search : {SpherePairSearch::all_pairs, SpherePairSearch::cells}) {
      HardSphereOverlap spheres(c->box, layout, c->radii, kernel_table(isa), search);
      if (spheres.any_overlap(positions) == expected.empty()) return "from scratch: wrong verdict";
      if (spheres.pairs_within(positions, 0.0).size() != expected.size()) return "from scratch: wrong number of overlaps";
    }
    if (landscape.allowed(positions) != expected.empty()) return "list: wrong verdict";
    if (landscape.find_contacts(positions).count != expected.size()) return "list: wrong number of overlaps";
  }
  return "";
}

void test_overlap(benchmark::State& state, Form form, std::size_t particles, double packing_fraction, Isa isa) {
  const Configuration& liquid = hard_liquid(hard_sphere_binary(), particles, packing_fraction);
  if (const std::string wrong = check(liquid, isa); !wrong.empty()) return state.SkipWithError(wrong.c_str());
  const ParticleLayout layout(liquid.species, 2);
  HardSphereLandscape landscape(liquid.box, layout, liquid.radii, isa);
  HardSphereOverlap spheres(liquid.box, layout, liquid.radii, kernel_table(isa),
                            form == Form::cells ? SpherePairSearch::cells : SpherePairSearch::all_pairs);
  const AlignedArray positions = layout.to_slots(liquid.positions);
  for (auto _ : state) {
    bool overlap = form == Form::list ? !landscape.allowed(positions) : spheres.any_overlap(positions);
    benchmark::DoNotOptimize(overlap);
    benchmark::ClobberMemory();
  }
  if (form == Form::list) state.counters["listed_pairs"] = static_cast<double>(landscape.list().pairs());
}

void test_scalar_reference(benchmark::State& state, std::size_t particles, double packing_fraction) {
  const Configuration& liquid = hard_liquid(hard_sphere_binary(), particles, packing_fraction);
  for (auto _ : state) {
    bool overlap = reference::any_overlap(liquid.positions, liquid.radii, liquid.box.length);
    benchmark::DoNotOptimize(overlap);
  }
}

void register_all() {
  for (const auto& [form, name] :
       {std::pair{Form::all_pairs, "all_pairs"}, std::pair{Form::cells, "cells"}, std::pair{Form::list, "list"}})
    for (const std::size_t particles : {108U, 256U, 500U, 1000U, 2000U, 4000U})
      for (const Isa isa : available_isas())
        benchmark::RegisterBenchmark(fmt::format("overlap/{}/N:{}/phi:0.50/{}", name, particles, to_string(isa)).c_str(),
                                     test_overlap, form, particles, 0.50, isa)
            ->Unit(benchmark::kMicrosecond);
  benchmark::RegisterBenchmark("overlap/all_pairs/N:108/phi:0.50/reference", test_scalar_reference, 108, 0.50)
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace
}  // namespace lanescape::bench

int main(int argc, char** argv) {
  lanescape::bench::register_all();
  return lanescape::bench::run_benchmarks(argc, argv);
}
