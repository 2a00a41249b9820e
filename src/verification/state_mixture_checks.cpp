#include "verification/state_mixture_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/overloaded.hpp"
#include "interaction/state/local_density.hpp"
#include "interaction/state/state_mixture.hpp"
#include "verification/check.hpp"

namespace lanescape {
namespace {

reference::RadialFunction table_function(const StateMixtureModel::Table& table) {
  const double spacing = (table.last - table.first) / static_cast<double>(table.values.size() - 1);
  const auto spline = std::make_shared<UniformSpline>(table.first, spacing, table.values, std::nullopt, 0.0);
  return [spline, first = table.first, last = table.last](double r) -> reference::Radial {
    if (r >= last) return {};
    if (r < first) return {spline->value(first) + spline->slope(first) * (r - first), spline->slope(first)};
    return {spline->value(r), spline->slope(r)};
  };
}

reference::RadialFunction radial_function(const StateMixtureModel::Potential& potential, double cutoff) {
  return std::visit(Overloaded{[&](const StateMixtureModel::LennardJones& lj) -> reference::RadialFunction {
                                 const auto inside = reference::shifted_lennard_jones(lj.epsilon, lj.sigma, cutoff);
                                 return [inside, cutoff](double r) { return r < cutoff ? inside(r) : reference::Radial{}; };
                               },
                               [](const StateMixtureModel::Table& table) { return table_function(table); }},
                    potential);
}

reference::RadialFunction switching_function(const StateMixtureModel::Switching& w, SwitchingForm form) {
  if (form == SwitchingForm::exact) return reference::tapered_switch(w.threshold, w.width, w.cutoff);
  const auto spline = std::make_shared<SwitchingFunction>(SwitchingFunction::tapered_tanh(w.threshold, w.width, w.cutoff));
  return [spline](double r) -> reference::Radial { return {spline->value(r), spline->slope(r)}; };
}

double largest_reach(const StateMixtureModel& model) {
  double reach = 0.0;
  for (std::size_t s = 0; s < model.species.size(); ++s)
    for (std::size_t t = 0; t < model.species.size(); ++t) reach = std::max(reach, model.reach(s, t));
  return reach;
}

// The largest deviation of a gradient, relative to the absolute forces on each particle; infinite if padding is not zero.
double gradient_deviation(const AlignedArray& gradient, const ParticleLayout& layout, const reference::StateEvaluation& expected) {
  const std::vector<double> g = layout.to_user(gradient);
  double worst = 0.0;
  for (std::size_t k = 0; k < g.size(); ++k)
    worst = std::max(worst, relative(g[k], expected.gradient[k], expected.gradient_magnitude[k / 3]));
  const AlignedArray clean = layout.to_slots(g);
  return clean == gradient ? worst : std::numeric_limits<double>::infinity();
}

double tensor_deviation(const std::array<double, 6>& tensor, const reference::StateEvaluation& expected) {
  double worst = 0.0;
  for (std::size_t k = 0; k < 6; ++k)
    worst = std::max(worst, relative(tensor[k], expected.virial_tensor[k], 12.0 * expected.magnitude));
  return worst;
}

bool has_tables(const StateMixtureModel& model) {
  return std::any_of(model.potentials.begin(), model.potentials.end(), [](const auto& u) {
    return std::visit(Overloaded{[](const StateMixtureModel::LennardJones&) { return false; },
                                 [](const StateMixtureModel::Table&) { return true; }},
                      u);
  });
}

// The checks of the kernels of one kind of potential.
struct PotentialChecks {
  Check energy, gradient_energy, gradient, virial, stress_gradient, tensor, one_body, energy_bits, gradient_bits;

  PotentialChecks(const kernels::KernelTable& table, const std::string& prefix)
      : energy(table, prefix + "energy", tolerance::state_sums),
        gradient_energy(table, prefix + "gradient energy", tolerance::state_sums),
        gradient(table, prefix + "gradient, state_density_gradient gradient", tolerance::state_gradient),
        virial(table, prefix + "gradient, state_density_gradient virial", tolerance::state_sums),
        stress_gradient(table, prefix + "stress, state_density_stress gradient", tolerance::state_gradient),
        tensor(table, prefix + "stress, state_density_stress tensor", tolerance::state_sums),
        one_body(table, prefix + "gradient one-body energy", tolerance::state_sums),
        energy_bits(table, prefix + "energy, gradient, stress: same energy", tolerance::exact),
        gradient_bits(table, prefix + "gradient, stress: same gradient and virial", tolerance::exact) {}

  std::vector<Deviation> deviations() const {
    return {energy.deviation, gradient_energy.deviation, gradient.deviation,    virial.deviation,       stress_gradient.deviation,
            tensor.deviation, one_body.deviation,        energy_bits.deviation, gradient_bits.deviation};
  }
};

// The potentials between all states of species s and all states of species t, and their ranges.
void add_potentials(reference::StateSystem& system, const StateMixtureModel& model, std::size_t s, std::size_t t) {
  double cutoff = 0.0;
  for (std::size_t a = 0; a < system.states; ++a)
    for (std::size_t b = 0; b < system.states; ++b) {
      if (a >= model.states_of(s) || b >= model.states_of(t)) {
        system.potential.emplace_back([](double) { return reference::Radial{}; });
        continue;
      }
      const auto& u = model.potentials[model.potential_at(s, a, t, b)];
      system.potential.push_back(radial_function(u, model.cutoff));
      cutoff = std::max(cutoff, StateMixtureModel::end_of(u, model.cutoff));
    }
  system.potential_cutoff.push_back(cutoff);
}

}  // namespace

reference::StateSystem reference_system(const StateMixtureModel& model, SwitchingForm form) {
  reference::StateSystem system;
  system.species = model.species.size();
  system.states = model.most_states();
  system.filter = model.filter;
  system.entropy_temperature = model.entropy_temperature;
  for (std::size_t s = 0; s < system.species; ++s) {
    const auto& states = model.states[s];
    system.switching.push_back(switching_function(states.switching, form));
    system.switching_cutoff.push_back(states.switching.cutoff);
    std::vector<double> thresholds, widths;
    for (const auto& step : states.steps) {
      thresholds.push_back(step.threshold);
      widths.push_back(step.width);
    }
    system.probabilities.push_back(reference::tanh_cascade(thresholds, widths));
    system.mu.insert(system.mu.end(), states.mu.begin(), states.mu.end());
    system.mu.resize((s + 1) * system.states, 0.0);
    for (std::size_t t = 0; t < system.species; ++t) add_potentials(system, model, s, t);
  }
  return system;
}

reference::StateEvaluation evaluate_reference(const StateMixtureModel& model, const Configuration& configuration,
                                              SwitchingForm form) {
  const auto neighbours = reference::all_neighbours(configuration.positions, configuration.box.length, largest_reach(model));
  return reference::three_passes(configuration.positions, configuration.species, reference_system(model, form), neighbours);
}

namespace {

struct MixtureChecks {
  const kernels::KernelTable& table;
  Check density, probability, by_tanh_energy, by_tanh_gradient, all_pairs;
  PotentialChecks lj, tables;

  explicit MixtureChecks(const kernels::KernelTable& t)
      : table(t),
        density(t, "state_densities", tolerance::state_density),
        probability(t, "state_densities probabilities", tolerance::state_probability),
        by_tanh_energy(t, "state_* energy, switching by tanh itself", tolerance::switching_spline_energy),
        by_tanh_gradient(t, "state_* gradient, switching by tanh itself", tolerance::switching_spline_gradient),
        all_pairs(t, "state_* over all pairs energy and gradient", tolerance::state_gradient),
        lj(t, "state_lj_"),
        tables(t, "state_table_") {}

  void add_states(const std::string& name, StateMixture& interaction, const ParticleLayout& layout,
                  const reference::StateEvaluation& expected) {
    double worst_density = 0.0, worst_probability = 0.0;
    const std::size_t states = interaction.states().states;
    for (std::size_t i = 0; i < layout.size(); ++i) {
      // With one state, densities are not computed.
      if (states > 1)
        worst_density = std::max(worst_density, relative(interaction.order_parameters()[layout.slot_of(i)], expected.densities[i],
                                                         std::max(1.0, expected.densities[i])));
      for (std::size_t a = 0; a < states; ++a)
        worst_probability = std::max(worst_probability, relative(interaction.states().of(layout.slot_of(i))[a],
                                                                 expected.probabilities[states * i + a], 1.0));
    }
    density.add(name, worst_density);
    probability.add(name, worst_probability);
  }

  void run(const StateMixtureCase& one) {
    const auto& [name, model, configuration] = one;
    const reference::StateEvaluation expected = evaluate_reference(model, configuration);
    const ParticleLayout layout(configuration.species, model.species.size());
    const AlignedArray positions = layout.to_slots(configuration.positions);
    StateMixture interaction(model, configuration.box, layout, table, {});
    // NaN makes values visible that are not written.
    AlignedArray g(layout.dimension(), std::numeric_limits<double>::quiet_NaN()), g_stress = g;
    const double e = interaction.energy(positions);
    const auto with_gradient = interaction.energy_and_gradient(positions, g);
    const auto with_stress = interaction.energy_and_stress(positions, g_stress);
    add_states(name, interaction, layout, expected);

    PotentialChecks& checks = has_tables(model) ? tables : lj;
    checks.energy.add(name, relative(e, expected.energy, expected.magnitude));
    checks.gradient_energy.add(name, relative(with_gradient.energy, expected.energy, expected.magnitude));
    checks.gradient.add(name, gradient_deviation(g, layout, expected));
    checks.virial.add(name, relative(with_gradient.virial, expected.virial, 12.0 * expected.magnitude));
    checks.stress_gradient.add(name, gradient_deviation(g_stress, layout, expected));
    checks.tensor.add(name, tensor_deviation(with_stress.virial_tensor, expected));
    checks.one_body.add(name, relative(with_gradient.one_body_energy, expected.one_body_energy, expected.magnitude));
    checks.energy_bits.add(name, !same_bits(e, with_gradient.energy) + !same_bits(e, with_stress.energy));
    checks.gradient_bits.add(name, (g != g_stress) + !same_bits(with_gradient.virial, with_stress.virial));

    const auto by_tanh = evaluate_reference(model, configuration, SwitchingForm::exact);
    by_tanh_energy.add(name, relative(e, by_tanh.energy, by_tanh.magnitude));
    by_tanh_gradient.add(name, gradient_deviation(g, layout, by_tanh));

    StateMixture::Options over_all;
    over_all.search = PairSearch::all_pairs;
    StateMixture brute(model, configuration.box, layout, table, over_all);
    const auto by_all = brute.energy_and_gradient(positions, g);
    all_pairs.add(name,
                  std::max(relative(by_all.energy, expected.energy, expected.magnitude), gradient_deviation(g, layout, expected)));
  }

  std::vector<Deviation> deviations() const {
    std::vector<Deviation> all = {density.deviation, probability.deviation, by_tanh_energy.deviation, by_tanh_gradient.deviation,
                                  all_pairs.deviation};
    for (const PotentialChecks* checks : {&lj, &tables})
      for (const Deviation& deviation : checks->deviations()) all.push_back(deviation);
    return all;
  }
};

}  // namespace

std::vector<Deviation> verify_state_mixtures(const kernels::KernelTable& table, const std::vector<StateMixtureCase>& cases) {
  MixtureChecks checks(table);
  for (const StateMixtureCase& one : cases) checks.run(one);
  return checks.deviations();
}

}  // namespace lanescape
