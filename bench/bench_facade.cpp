// What the facade adds to the kernels: V and gradient of a Kob-Andersen liquid, N = 108, by the bare kernels in the library's
// arrays and through lanescape::Potential from a host's arrays; and the path finder on a model and on the same landscape as a host
// gives it.

#include <lanescape/lanescape.hpp>

#include "bench_support.hpp"
#include "interaction/pair/pair_sums.hpp"

namespace lanescape::bench {
namespace {

constexpr std::size_t particles = 108;

struct Liquid {
  const Configuration& configuration = liquid(particles);
  Potential potential{Model::named("kob-andersen"), configuration.species, configuration.box.length};
  std::vector<double> forces = std::vector<double>(3 * particles);
};

void bare_kernel(benchmark::State& state) {
  const Configuration& configuration = liquid(particles);
  const PairModel model = kob_andersen();
  const ParticleLayout layout(configuration.species, model.species.size());
  const AlignedArray positions = layout.to_slots(configuration.positions);
  AlignedArray gradient(layout.dimension(), 0.0);
  AllPairsSums sums(model, configuration.box, layout, kernel_table(choose_isa("auto")));
  kernels::PairOutput out{};
  for (auto _ : state) {
    sums.gradient(positions, gradient, out);
    benchmark::DoNotOptimize(out);
    benchmark::ClobberMemory();
  }
}

// Gives `state` an error unless the facade has the energy of the layers below.
bool verified(benchmark::State& state, Liquid& l) {
  const PairModel model = kob_andersen();
  const ParticleLayout layout(l.configuration.species, model.species.size());
  AlignedArray gradient(layout.dimension(), 0.0);
  PairInteraction interaction(model, l.configuration.box, layout, kernel_table(choose_isa("auto")));
  const double expected = interaction.energy_and_gradient(layout.to_slots(l.configuration.positions), gradient).energy;
  if (l.potential.energy_and_forces(l.configuration.positions, l.forces) == expected) return true;
  state.SkipWithError("the facade has another energy than the interaction");
  return false;
}

void interleaved(benchmark::State& state) {
  Liquid l;
  if (!verified(state, l)) return;
  for (auto _ : state) benchmark::DoNotOptimize(l.potential.energy_and_forces(l.configuration.positions, l.forces));
}

void separate(benchmark::State& state) {
  Liquid l;
  if (!verified(state, l)) return;
  std::vector<double> r[3], f[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < particles; ++i) r[axis].push_back(l.configuration.positions[3 * i + axis]);
    f[axis].resize(particles);
  }
  const auto positions = Vectors<const double>::separate(r[0], r[1], r[2]);
  const Outputs outputs{.forces = Vectors<double>::separate(f[0], f[1], f[2])};
  for (auto _ : state) benchmark::DoNotOptimize(l.potential.evaluate(positions, outputs));
}

// Each particle somewhat aside.
std::vector<double> displaced(const std::vector<double>& positions, double by) {
  std::vector<double> moved = positions;
  for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += by * std::sin(1.7 * static_cast<double>(k));
  return moved;
}

// The same landscape, whose nature the finder cannot see.
struct OfHost final : Landscape {
  explicit OfHost(Potential& potential) : inner(&potential) {}
  std::size_t particles() const override { return inner->particles(); }
  double energy(std::span<const double> positions) override { return inner->energy(positions); }
  double energy_and_gradient(std::span<const double> positions, std::span<double> gradient) override {
    return inner->energy_and_gradient(positions, gradient);
  }
  Potential* inner;
};

enum class Of { model, potential, host };

void path(benchmark::State& state, Of of) {
  Liquid l;
  OfHost host(l.potential);
  Landscape& landscape = of == Of::host ? static_cast<Landscape&>(host) : l.potential;
  const Model model = Model::named("kob-andersen");
  const std::vector<double> finish = displaced(l.configuration.positions, 0.1);
  PathSettings settings{.max_steps = 2000, .frames = 0};
  std::uint64_t evaluations = 0;
  for (auto _ : state) {
    const Path found = of != Of::model ? find_path(landscape, l.configuration.positions, finish, settings)
                                       : find_path(model, l.configuration.species, l.configuration.box.length,
                                                   l.configuration.positions, finish, settings);
    evaluations += found.evaluations;
  }
  state.counters["per_evaluation"] =
      benchmark::Counter(static_cast<double>(evaluations), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK(bare_kernel)->Unit(benchmark::kMicrosecond);
BENCHMARK(interleaved)->Unit(benchmark::kMicrosecond);
BENCHMARK(separate)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(path, of_a_model, Of::model)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(path, of_a_potential, Of::potential)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(path, of_a_host, Of::host)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lanescape::bench

int main(int argc, char** argv) { return lanescape::bench::run_benchmarks(argc, argv); }
