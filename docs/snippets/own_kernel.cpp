// A user's own Lennard-Jones kernel: it is registered, verified on the library's test cases, and then timed together with the
// library's kernels. docs/KERNELS.md explains it.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "kernel_table.hpp"
#include "verification/cases.hpp"
#include "verification/kernel_checks.hpp"
#include "verification/pair_checks.hpp"
#include "verification/reference_bridge.hpp"

namespace {

using namespace lanescape;
using kernels::KernelTable;
using kernels::PairForm;
using kernels::PairInput;
using kernels::PairKernels;
using kernels::PairOutput;

// The kernel: energy, virial and gradient over all pairs and all images within the cutoff, without vector instructions.
void my_gradient(const PairInput& in, double* gradient, PairOutput& out) noexcept {
  out.energy = out.virial = 0.0;
  std::fill(gradient, gradient + 3 * in.slots, 0.0);
  // The unit of length of the pair parameters.
  double scale[3], edge[3];
  for (int k = 0; k < 3; ++k) {
    scale[k] = in.unit == kernels::LengthUnit::box ? 1.0 / in.box[k] : 1.0;
    edge[k] = in.unit == kernels::LengthUnit::box ? 1.0 : in.box[k];
  }
  const auto add_pair = [&](std::size_t i, std::size_t j, const kernels::PairParameters& u) {
    double nearest[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = (in.positions[k * in.slots + i] - in.positions[k * in.slots + j]) * scale[k];
      nearest[k] = d - edge[k] * std::rint(d / edge[k]);
    }
    const bool one_image = u.images == kernels::ImageSearch::nearest;
    const int shells[3] = {one_image ? 0 : in.shells[0], one_image ? 0 : in.shells[1], one_image ? 0 : in.shells[2]};
    for (int a = -shells[0]; a <= shells[0]; ++a)
      for (int b = -shells[1]; b <= shells[1]; ++b)
        for (int c = -shells[2]; c <= shells[2]; ++c) {
          const double d[3] = {nearest[0] + a * edge[0], nearest[1] + b * edge[1], nearest[2] + c * edge[2]};
          const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
          if (!(r2 < u.cutoff_squared)) continue;
          const double rinv6 = 1.0 / (r2 * r2 * r2), c12 = u.coefficient[0], c6 = u.coefficient[1];
          const double virial = (12.0 * c12 * rinv6 - 6.0 * c6) * rinv6;  // -r u'(r)
          out.energy += (c12 * rinv6 - c6) * rinv6 - u.coefficient[2];
          out.virial += virial;
          for (std::size_t k = 0; k < 3; ++k) {
            const double force = virial / r2 * d[k] * scale[k];
            gradient[k * in.slots + i] -= force;
            gradient[k * in.slots + j] += force;
          }
        }
  };
  for (std::size_t s = 0; s < in.block_count; ++s)
    for (std::size_t t = s; t < in.block_count; ++t)
      for (std::size_t i = in.blocks[s].begin; i < in.blocks[s].begin + in.blocks[s].count; ++i)
        for (std::size_t j = s == t ? i + 1 : in.blocks[t].begin; j < in.blocks[t].begin + in.blocks[t].count; ++j)
          add_pair(i, j, in.pairs[s * in.block_count + t]);
}

// A faulty version: one particle feels no force along x.
void faulty_gradient(const PairInput& in, double* gradient, PairOutput& out) noexcept {
  my_gradient(in, gradient, out);
  if (in.block_count > 0 && in.blocks[0].count > 0) gradient[in.blocks[0].begin + in.blocks[0].count - 1] = 0.0;
}

// The library's kernels with another gradient.
PairKernels kernels_with(decltype(PairKernels::gradient) gradient) {
  PairKernels kernels = kernel_table(available_isas().back()).pair_kernels(PairForm::lennard_jones);
  kernels.gradient = gradient;
  return kernels;
}

// The library's table with these Lennard-Jones kernels; `kernels` must outlive it.
KernelTable table_with(const PairKernels& kernels, const char* name) {
  KernelTable table = kernel_table(available_isas().back());
  table.name = name;
  table.pair[static_cast<std::size_t>(PairForm::lennard_jones)] = &kernels;
  return table;
}

// Compares the gradient kernel of this table with the scalar reference on every case; prints a line per result.
bool verified(const KernelTable& table) {
  bool passed = true;
  for (const Deviation& deviation : verify_all_pairs(table, pair_cases())) {
    if (!deviation.kernel.starts_with("lennard_jones_gradient ")) continue;
    fmt::print("{}: {}\n", deviation.passed() ? "passed" : "FAILED", describe(deviation));
    passed = passed && deviation.passed();
  }
  return passed;
}

// Kob-Andersen's mixture, N = 257, minimum image: the last of the largest cases.
PairCase timed_case() {
  const std::vector<PairCase> cases = pair_cases();
  return *std::max_element(cases.rbegin(), cases.rend(),
                           [](const PairCase& a, const PairCase& b) { return a.configuration.size() < b.configuration.size(); });
}

void set_time_per_pair(benchmark::State& state, const PairCase& one) {
  const auto n = static_cast<double>(one.configuration.size());
  using benchmark::Counter;
  state.SetLabel(one.name);
  state.counters["per_pair"] = Counter(0.5 * n * (n - 1.0), Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void time_kernel(benchmark::State& state, const KernelTable& table) {
  const PairCase one = timed_case();
  const ParticleLayout layout(one.configuration.species, one.model.species.size());
  const AlignedArray positions = layout.to_slots(one.configuration.positions);
  AlignedArray gradient(layout.dimension());
  PairInteraction interaction(one.model, one.configuration.box, layout, table);
  for (auto _ : state) {
    benchmark::DoNotOptimize(interaction.energy_and_gradient(positions, gradient));
    benchmark::ClobberMemory();
  }
  set_time_per_pair(state, one);
}

void time_reference(benchmark::State& state) {
  const PairCase one = timed_case();
  for (auto _ : state) benchmark::DoNotOptimize(evaluate_reference(one.model, one.configuration));
  set_time_per_pair(state, one);
}

}  // namespace

int main(int argc, char** argv) {
  const PairKernels my_kernels = kernels_with(my_gradient), faulty_kernels = kernels_with(faulty_gradient);
  const KernelTable mine = table_with(my_kernels, "mine");
  if (!verified(mine)) return 1;
  // A check proves something only if it also finds a known fault.
  if (verified(table_with(faulty_kernels, "faulty"))) return 1;

  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RegisterBenchmark("mine", time_kernel, mine);
  for (const Isa isa : available_isas()) benchmark::RegisterBenchmark(to_string(isa), time_kernel, kernel_table(isa));
  benchmark::RegisterBenchmark("reference", time_reference);
  benchmark::RunSpecifiedBenchmarks();
}
