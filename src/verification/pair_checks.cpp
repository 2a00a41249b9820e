#include "verification/pair_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "interaction/pair/cluster_sums.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/pair_parameters.hpp"
#include "verification/check.hpp"
#include "verification/probe_checks.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

double energy_deviation(double energy, const reference::Evaluation& expected) {
  return relative(energy, expected.energy, expected.magnitude);
}

double virial_deviation(double virial, const reference::Evaluation& expected) {
  return relative(virial, expected.virial, expected.virial_magnitude);
}

double tensor_deviation(const std::array<double, 6>& tensor, const reference::Evaluation& expected) {
  double worst = 0.0;
  for (std::size_t k = 0; k < 6; ++k)
    worst = std::max(worst, relative(tensor[k], expected.virial_tensor[k], expected.virial_magnitude));
  return worst;
}

// Per particle, relative to its largest component, because a component that happens to be small inherits the rounding of positions
// from the others. Padding must stay zero, because the vector algebra sums over it.
double gradient_deviation(const AlignedArray& gradient, const ParticleLayout& layout, const reference::Evaluation& expected) {
  const std::vector<double> in_users_order = layout.to_user(gradient);
  double worst = 0.0;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const auto scales = std::span(expected.gradient_magnitude).subspan(3 * i, 3);
    const double scale = *std::max_element(scales.begin(), scales.end());
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
      worst = std::max(worst, relative(in_users_order[k], expected.gradient[k], scale));
  }
  AlignedArray padding = gradient;
  for (std::size_t i = 0; i < layout.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) padding[axis * layout.slots() + layout.slot_of(i)] = 0.0;
  const bool clean = std::all_of(padding.begin(), padding.end(), [](double g) { return g == 0.0; });
  return clean ? worst : std::numeric_limits<double>::infinity();
}

// The checks of the kernels of one search method against the reference; `prefix` starts the names of the results.
struct SearchChecks {
  SearchChecks(const kernels::KernelTable& table, const std::string& prefix)
      : energy(table, prefix + "energy", tolerance::pair_sums),
        gradient_energy(table, prefix + "gradient energy", tolerance::pair_sums),
        gradient(table, prefix + "gradient gradient", tolerance::pair_gradient),
        gradient_virial(table, prefix + "gradient virial", tolerance::pair_sums),
        stress_energy(table, prefix + "stress energy", tolerance::pair_sums),
        stress_gradient(table, prefix + "stress gradient", tolerance::pair_gradient),
        stress_virial(table, prefix + "stress virial", tolerance::pair_sums),
        tensor(table, prefix + "stress tensor", tolerance::pair_sums),
        energy_bits(table, fmt::format("{0}energy, {0}gradient, {0}stress: same energy", prefix), tolerance::exact),
        virial_bits(table, fmt::format("{0}gradient, {0}stress: same virial", prefix), tolerance::exact),
        gradient_bits(table, fmt::format("{0}force, {0}gradient, {0}stress: same gradient", prefix), tolerance::exact) {}

  Check energy, gradient_energy, gradient, gradient_virial, stress_energy, stress_gradient, stress_virial, tensor;
  Check energy_bits, virial_bits, gradient_bits;

  void add(const PairCase& one, const kernels::KernelTable& table, PairSearch search) {
    const auto& [name, model, configuration] = one;
    const reference::Evaluation expected = evaluate_reference(model, configuration);
    const ParticleLayout layout = ParticleLayout::in_users_order(configuration, model.species.size());
    const AlignedArray positions = layout.to_slots(configuration.positions);
    PairInteraction interaction(model, configuration.box, layout, table, {.search = search});
    // NaN makes values visible that a kernel does not write.
    AlignedArray g(layout.dimension(), std::numeric_limits<double>::quiet_NaN()), g_stress = g, g_only = g;
    const double e = interaction.energy(positions);
    interaction.gradient(positions, g_only);
    const auto with_gradient = interaction.energy_and_gradient(positions, g);
    const auto with_stress = interaction.energy_and_stress(positions, g_stress);

    const double allowance = rounding_allowance(configuration);
    energy.add(name, energy_deviation(e, expected) / allowance);
    gradient_energy.add(name, energy_deviation(with_gradient.energy, expected) / allowance);
    gradient.add(name, gradient_deviation(g, layout, expected) / allowance);
    gradient_virial.add(name, virial_deviation(with_gradient.virial, expected) / allowance);
    stress_energy.add(name, energy_deviation(with_stress.energy, expected) / allowance);
    stress_gradient.add(name, gradient_deviation(g_stress, layout, expected) / allowance);
    stress_virial.add(name, virial_deviation(with_stress.virial, expected) / allowance);
    tensor.add(name, tensor_deviation(with_stress.virial_tensor, expected) / allowance);
    energy_bits.add(name, !same_bits(e, with_gradient.energy) + !same_bits(e, with_stress.energy));
    virial_bits.add(name, !same_bits(with_gradient.virial, with_stress.virial));
    gradient_bits.add(name, (g_only != g) + (g_stress != g));
  }

  // Over all pairs no kernel omits the energy, so the bits of gradients are compared for lists only.
  std::vector<Deviation> deviations(PairSearch search) const {
    std::vector<Deviation> all;
    for (const Check* check : {&energy, &gradient_energy, &gradient, &gradient_virial, &stress_energy, &stress_gradient,
                               &stress_virial, &tensor, &energy_bits, &virial_bits})
      all.push_back(check->deviation);
    if (search == PairSearch::list) all.push_back(gradient_bits.deviation);
    return all;
  }
};

std::vector<Deviation> verify_search(const kernels::KernelTable& table, const std::vector<PairCase>& cases, PairSearch search,
                                     const std::string& prefix) {
  SearchChecks checks(table, prefix);
  for (const PairCase& one : cases)
    if (search == PairSearch::all_pairs || has_list(one)) checks.add(one, table, search);
  return checks.deviations(search);
}

}  // namespace

bool has_list(const PairCase& one) {
  const ParticleLayout layout = ParticleLayout::in_users_order(one.configuration, one.model.species.size());
  return fits_list(one.model, one.configuration.box, default_skin, diameter_scale(one.model, layout));
}

bool has_clusters(const PairCase& one) {
  const ParticleLayout layout = ParticleLayout::in_users_order(one.configuration, one.model.species.size());
  return has_list(one) && ClusterSums::can_hold(one.model, one.configuration.box, layout, default_skin);
}

bool has_pair_at_cutoff(const PairCase& one, double margin) {
  PairModel nearer = one.model;
  nearer.truncation = Truncation::plain;
  PairModel further = nearer;
  nearer.cutoff = one.model.cutoff * (1.0 - margin);
  further.cutoff = one.model.cutoff * (1.0 + margin);
  return evaluate_reference(nearer, one.configuration).energy != evaluate_reference(further, one.configuration).energy;
}

std::vector<Deviation> verify_all_pairs(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                        const std::string& form) {
  return verify_search(table, cases, PairSearch::all_pairs, form + "_");
}

std::vector<Deviation> verify_lists(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                    const std::string& form) {
  return verify_search(table, with_open_cases(cases), PairSearch::list, form + "_list_");
}

namespace {

bool has(PairSearch search, const PairCase& one) { return search == PairSearch::clusters ? has_clusters(one) : has_list(one); }

std::vector<Deviation> verify_single(const kernels::KernelTable& table, const std::vector<PairCase>& cases, PairSearch search,
                                     const std::string& prefix) {
  Check energy(table, prefix + "energy_mixed", tolerance::mixed_sums),
      gradient_energy(table, prefix + "gradient_mixed energy", tolerance::mixed_sums),
      gradient(table, prefix + "gradient_mixed gradient",
               !cases.empty() && cases.front().model.form->has_diameters ? tolerance::mixed_diameters_gradient
                                                                         : tolerance::mixed_gradient),
      virial(table, prefix + "gradient_mixed virial", tolerance::mixed_sums);
  Check energy_bits(table, fmt::format("{0}energy_mixed, {0}gradient_mixed: same energy", prefix), tolerance::exact);
  Check gradient_bits(table, fmt::format("{0}force_mixed, {0}gradient_mixed: same gradient", prefix), tolerance::exact);
  for (const PairCase& one : cases) {
    const auto& [name, model, configuration] = one;
    if (!has(search, one) || has_pair_at_cutoff(one, tolerance::mixed_cutoff)) continue;
    const reference::Evaluation expected = evaluate_reference(model, configuration);
    const ParticleLayout layout = ParticleLayout::in_users_order(configuration, model.species.size());
    const AlignedArray positions = layout.to_slots(configuration.positions);
    PairInteraction interaction(model, configuration.box, layout, table, {.search = search, .precision = Precision::mixed});
    AlignedArray g(layout.dimension(), std::numeric_limits<double>::quiet_NaN()), g_only = g;
    const double e = interaction.energy(positions);
    interaction.gradient(positions, g_only);
    const auto with_gradient = interaction.energy_and_gradient(positions, g);

    energy.add(name, energy_deviation(e, expected));
    gradient_energy.add(name, energy_deviation(with_gradient.energy, expected));
    gradient.add(name, gradient_deviation(g, layout, expected));
    virial.add(name, virial_deviation(with_gradient.virial, expected));
    energy_bits.add(name, !same_bits(e, with_gradient.energy));
    gradient_bits.add(name, g_only != g);
  }
  return {energy.deviation, gradient_energy.deviation, gradient.deviation,
          virial.deviation, energy_bits.deviation,     gradient_bits.deviation};
}

}  // namespace

std::vector<Deviation> verify_mixed(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                    const std::string& form) {
  return verify_single(table, with_open_cases(cases), PairSearch::list, form + "_list_");
}

std::vector<Deviation> verify_clusters(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                       const std::string& form) {
  if (cases.empty() || cases.front().model.form->has_diameters) return {};
  std::vector<PairCase> all = cluster_cases(*cases.front().model.form);
  all.insert(all.end(), cases.begin(), cases.end());
  return verify_single(table, all, PairSearch::clusters, form + "_cluster_");
}

std::vector<Deviation> verify_pairs(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                    const std::string& form) {
  std::vector<Deviation> deviations = verify_all_pairs(table, cases, form);
  for (auto verify : {verify_lists, verify_mixed, verify_clusters, verify_probes})
    for (auto& deviation : verify(table, cases, form)) deviations.push_back(std::move(deviation));
  return deviations;
}

}  // namespace lanescape
