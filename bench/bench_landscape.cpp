// V(R), with its gradient and with the stress, of a Kob-Andersen liquid: every available instruction set, both image rules.
//
// Counters: `pairs` N (N - 1)/2; `ns_per_pair`; `x_limit`, the time of an evaluation divided by the arithmetic limit. The limit is
// the time of the multiply-adds and products that a vector of pairs needs at least, at the rate measured on this machine: 3 for
// r^2, 2 for r^-6 from 1/r^2, 1 for the sum of r^-12 (energy: 6); 3 for -u'(r)/r and 6 for the gradients of both particles (15); 9
// for the tensor (24). It leaves out plain additions, the division and the choice of the image, and the second image of the rule
// `all` in a small box: with fma no kernel can reach 1.

#include <fmt/format.h>

#include <ctime>
#include <string>

#include "bench_support.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "verification/kernel_checks.hpp"
#include "verification/pair_checks.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape::bench {
namespace {

enum class Quantity { energy, gradient, stress };

struct QuantityTraits {
  const char* name;
  double vector_instructions;  // per vector of pairs
};

QuantityTraits traits(Quantity quantity) {
  switch (quantity) {
    case Quantity::energy:
      return {"energy", 6.0};
    case Quantity::gradient:
      return {"gradient", 15.0};
    case Quantity::stress:
      return {"stress", 24.0};
  }
  return {};
}

double pair_count(std::size_t particles) {
  const auto n = static_cast<double>(particles);
  return 0.5 * n * (n - 1.0);
}

// Times every iteration of a benchmark by processor time, because the machine may be shared. Seconds per iteration.
template <class Body>
double timed(benchmark::State& state, Body body) {
  const std::clock_t start = std::clock();
  for (auto _ : state) {
    double energy = body();
    benchmark::DoNotOptimize(energy);
    benchmark::ClobberMemory();
  }
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / static_cast<double>(state.iterations());
}

void set_counters(benchmark::State& state, double pairs, double seconds) {
  state.counters["pairs"] = pairs;
  state.counters["ns_per_pair"] = 1e9 * seconds / pairs;
}

// Checks these kernels on this configuration; returns the error, or an empty string.
std::string check(Isa isa, const PairModel& model, const Configuration& configuration) {
  for (const Deviation& d : verify_all_pairs(kernel_table(isa), {{"the benchmark's liquid", model, configuration}}))
    if (!d.passed()) return describe(d);
  return "";
}

void evaluate(benchmark::State& state, Quantity quantity, std::size_t particles, ImageRule images, Isa isa) {
  const PairModel model = kob_andersen_with(images);
  const Configuration& configuration = liquid(particles);
  if (const std::string wrong = check(isa, model, configuration); !wrong.empty()) return state.SkipWithError(wrong.c_str());

  const kernels::KernelTable& table = kernel_table(isa);
  const ParticleLayout layout(configuration.species, model.species.size());
  const AlignedArray positions = layout.to_slots(configuration.positions);
  AlignedArray gradient(layout.dimension(), 0.0);
  PairInteraction interaction(model, configuration.box, layout, table, {.search = PairSearch::all_pairs});
  const double limit = traits(quantity).vector_instructions * pair_count(particles) / static_cast<double>(table.lanes) *
                       seconds_per_vector_instruction(isa);
  const double seconds = timed(state, [&] {
    switch (quantity) {
      case Quantity::energy:
        return interaction.energy(positions);
      case Quantity::gradient:
        return interaction.energy_and_gradient(positions, gradient).energy;
      case Quantity::stress:
        return interaction.energy_and_stress(positions, gradient).energy;
    }
    return 0.0;
  });
  set_counters(state, pair_count(particles), seconds);
  state.counters["x_limit"] = seconds / limit;
}

// For comparison: the scalar reference, which always computes everything.
void evaluate_scalar_reference(benchmark::State& state, std::size_t particles, ImageRule images) {
  const PairModel model = kob_andersen_with(images);
  const Configuration& configuration = liquid(particles);
  const double seconds = timed(state, [&] { return evaluate_reference(model, configuration).energy; });
  set_counters(state, pair_count(particles), seconds);
}

void register_all() {
  for (const Isa isa : available_isas()) {
    const double rate = 2.0 * static_cast<double>(kernel_table(isa).lanes) / seconds_per_vector_instruction(isa);
    benchmark::AddCustomContext(fmt::format("peak {}", to_string(isa)), fmt::format("{:.1f} GFLOP/s", 1e-9 * rate));
  }
  for (const ImageRule images : {ImageRule::minimum, ImageRule::all}) {
    for (const Quantity quantity : {Quantity::energy, Quantity::gradient, Quantity::stress})
      for (const std::size_t particles : {108U, 256U, 500U})
        for (const Isa isa : available_isas()) {
          const auto name = fmt::format("{}/N:{}/{}/{}", traits(quantity).name, particles, to_string(images), to_string(isa));
          benchmark::RegisterBenchmark(name.c_str(), evaluate, quantity, particles, images, isa)->Unit(benchmark::kMicrosecond);
        }
    const auto name = fmt::format("stress/N:108/{}/reference", to_string(images));
    benchmark::RegisterBenchmark(name.c_str(), evaluate_scalar_reference, 108, images)->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace
}  // namespace lanescape::bench

int main(int argc, char** argv) {
  lanescape::bench::register_all();
  return lanescape::bench::run_benchmarks(argc, argv);
}
