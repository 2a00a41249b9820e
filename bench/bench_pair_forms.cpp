// Compares every pair potential with Lennard-Jones of the same cutoff on the same pairs: V + gradient over all pairs at N = 108
// (minimum image) and forces over a list at N = 4000. The parameters are those of the Kob-Andersen mixture. The instruction set is
// the best available one, or LANESCAPE_ISA.
//
// Counters: `us` per evaluation, and `ratio` to Lennard-Jones. Both are the best of all iterations, which alternate between the two
// potentials.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "bench_support.hpp"
#include "core/random.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "verification/kernel_checks.hpp"
#include "verification/pair_checks.hpp"

namespace lanescape::bench {
namespace {

struct FormCase {
  std::string name;
  PairModel model;
};

PairModel mixture_of_form(const PairForm& form, std::vector<double> numbers, Truncation truncation, double cutoff) {
  PairModel model = kob_andersen();
  model.form = &form;
  model.form_numbers = std::move(numbers);
  model.truncation = truncation;
  model.cutoff = cutoff;
  if (form.has_diameters) model.sigma.assign(4, 1.0);
  return model;
}

std::vector<FormCase> cases() {
  const auto form = [](const char* word, std::vector<double> numbers, double cutoff = 2.5,
                       Truncation truncation = Truncation::shifted) {
    return mixture_of_form(pair_form(word), std::move(numbers), truncation, cutoff);
  };
  return {{"mie-12-6", form("mie", {12, 6})},
          {"mie-14-8", form("mie", {14, 8})},
          {"inverse-power-12", form("inverse-power", {12})},
          {"lennard-jones-12-6-4", form("lennard-jones-12-6-4", {0.25})},
          {"lennard-jones-shifted-force", form("lennard-jones", {}, 2.5, Truncation::shifted_force)},
          {"lennard-jones-smooth", form("lennard-jones", {}, 2.5, Truncation::smooth)},
          {"yukawa", form("yukawa", {1.5})},
          {"polydisperse", form("polydisperse", {0.2}, 1.25, Truncation::plain)},
          {"harmonic", form("harmonic", {}, 1.0)},
          {"hertzian", form("hertzian", {}, 1.0)}};
}

// A crystal with each coordinate displaced by up to 0.05, so that every form has forces.
Configuration rattled(const PairModel& model, std::size_t particles) {
  Configuration configuration = fcc_start(model, particles, 1.2, 1);
  const CounterRandom random(1, RandomStream::displacements);
  for (std::size_t k = 0; k < configuration.positions.size(); ++k)
    configuration.positions[k] += 0.1 * (random.uniform(0, static_cast<std::uint32_t>(k)) - 0.5);
  return configuration;
}

// One model evaluated on one configuration.
class Evaluation {
 public:
  Evaluation(const PairModel& model, const Configuration& configuration, bool over_list)
      : layout_(ParticleLayout::in_space_order(configuration, model.species.size())),
        positions_(layout_.to_slots(configuration.positions)),
        gradient_(layout_.dimension(), 0.0),
        interaction_(model, configuration.box, layout_, kernel_table(choose_isa("auto")),
                     {.search = over_list ? PairSearch::list : PairSearch::all_pairs}),
        over_list_(over_list) {}

  void operator()() {
    if (over_list_)
      interaction_.gradient(positions_, gradient_);
    else
      benchmark::DoNotOptimize(interaction_.energy_and_gradient(positions_, gradient_).energy);
    benchmark::ClobberMemory();
  }

 private:
  ParticleLayout layout_;
  AlignedArray positions_, gradient_;
  PairInteraction interaction_;
  bool over_list_;
};

double seconds_of(Evaluation& evaluate, int times) {
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < times; ++k) evaluate();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / times;
}

void compare(benchmark::State& state, const FormCase& form, bool over_list) {
  PairModel model = form.model;
  const std::size_t particles = over_list ? 4000 : 108;
  model.images = over_list ? ImageRule::all : ImageRule::minimum;
  const Configuration configuration = rattled(model, particles);
  const PairCase verified{form.name, model, over_list ? rattled(model, 256) : configuration};
  const kernels::KernelTable& table = kernel_table(choose_isa("auto"));
  for (const Deviation& d : over_list ? verify_lists(table, {verified}) : verify_all_pairs(table, {verified}))
    if (!d.passed()) return state.SkipWithError(describe(d).c_str());

  PairModel lennard_jones = mixture_of_form(lennard_jones_form(), {}, Truncation::shifted, model.cutoff);
  lennard_jones.sigma = model.sigma;
  lennard_jones.images = model.images;
  Evaluation own(model, configuration, over_list), other(lennard_jones, configuration, over_list);
  const int times = over_list ? 5 : 200;
  double best = HUGE_VAL, best_other = HUGE_VAL;
  for (auto _ : state) {
    best_other = std::min(best_other, seconds_of(other, times));
    const double seconds = seconds_of(own, times);
    state.SetIterationTime(seconds);
    best = std::min(best, seconds);
  }
  state.counters["us"] = 1e6 * best;
  state.counters["ratio"] = best / best_other;
  state.SetLabel(to_string(choose_isa("auto")));
}

void register_all() {
  for (const bool over_list : {false, true})
    for (const FormCase& form : cases())
      benchmark::RegisterBenchmark(fmt::format("{}/{}", over_list ? "list_force/N:4000" : "gradient/N:108", form.name).c_str(),
                                   [form, over_list](benchmark::State& state) { compare(state, form, over_list); })
          ->UseManualTime()
          ->Iterations(over_list ? 100 : 300)
          ->Unit(benchmark::kMicrosecond);
}

}  // namespace
}  // namespace lanescape::bench

int main(int argc, char** argv) {
  lanescape::bench::register_all();
  return lanescape::bench::run_benchmarks(argc, argv);
}
