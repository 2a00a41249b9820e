#include "verification/kernel_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/random.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "verification/check.hpp"
#include "verification/event_driven_checks.hpp"
#include "verification/hard_sphere_cases.hpp"
#include "verification/hard_sphere_checks.hpp"
#include "verification/probe_checks.hpp"
#include "verification/reference_bridge.hpp"
#include "verification/state_mixture_checks.hpp"

namespace lanescape {

double rounding_allowance(const Configuration& configuration) {
  double largest = tolerance::position_extent;
  for (const double x : configuration.positions) largest = std::max(largest, std::abs(x));
  return largest / tolerance::position_extent;
}

namespace {

double energy_deviation(double energy, const reference::Evaluation& expected) {
  return relative(energy, expected.energy, expected.magnitude);
}

// r.f weights the powers of u(r) by up to 12, and so does its rounding.
double virial_deviation(double virial, const reference::Evaluation& expected) {
  return relative(virial, expected.virial, 12.0 * expected.magnitude);
}

double tensor_deviation(const std::array<double, 6>& tensor, const reference::Evaluation& expected) {
  double worst = 0.0;
  for (std::size_t k = 0; k < 6; ++k)
    worst = std::max(worst, relative(tensor[k], expected.virial_tensor[k], 12.0 * expected.magnitude));
  return worst;
}

// Per particle relative to its largest component: a component that happens to be small inherits the rounding of the
// positions from the others. Padding must stay zero, for the vector algebra sums over it.
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

// Inputs of the vector algebra: numbers of either sign with fractions that fill the mantissa.
AlignedArray random_array(std::size_t length, std::uint64_t which) {
  const CounterRandom random(1, RandomStream::displacements);
  AlignedArray values(length);
  for (std::size_t i = 0; i < length; ++i) values[i] = 20.0 * random.uniform(which, static_cast<std::uint32_t>(i)) - 10.0;
  return values;
}

// A sum of products and of their absolute values.
struct Sum {
  long double value = 0.0L, magnitude = 0.0L;
  void add(long double term) {
    value += term;
    magnitude += std::abs(term);
  }
};

}  // namespace

std::string describe(const Deviation& d) {
  return fmt::format("{} on {}: worst deviation {:.3g}, allowed {:.3g}, of {} cases the worst is '{}'", d.kernel, d.isa, d.worst,
                     d.tolerance, d.cases, d.worst_case);
}

namespace {

// The kernels of one way of finding pairs; `prefix` begins their names.
std::vector<Deviation> verify_search(const kernels::KernelTable& table, const std::vector<PairCase>& cases, PairSearch search,
                                     const std::string& prefix) {
  const std::string with_energy = prefix + "gradient", with_tensor = prefix + "stress";
  Check energy(table, prefix + "energy", tolerance::lj_sums);
  Check gradient_energy(table, with_energy + " energy", tolerance::lj_sums),
      gradient(table, with_energy + " gradient", tolerance::lj_gradient),
      gradient_virial(table, with_energy + " virial", tolerance::lj_sums);
  Check stress_energy(table, with_tensor + " energy", tolerance::lj_sums),
      stress_gradient(table, with_tensor + " gradient", tolerance::lj_gradient),
      stress_virial(table, with_tensor + " virial", tolerance::lj_sums), tensor(table, with_tensor + " tensor", tolerance::lj_sums);
  Check energy_bits(table, fmt::format("{}energy, {}, {}: same energy", prefix, with_energy, with_tensor), tolerance::exact);
  Check virial_bits(table, fmt::format("{}, {}: same virial", with_energy, with_tensor), tolerance::exact);
  Check gradient_bits(table, fmt::format("{}force, {}, {}: same gradient", prefix, with_energy, with_tensor), tolerance::exact);

  for (const auto& [name, model, configuration] : cases) {
    if (search == PairSearch::list && !fits_list(model, configuration.box, default_skin)) continue;
    const reference::Evaluation expected = evaluate_reference(model, configuration);
    const ParticleLayout layout(configuration.species, model.species.size());
    const AlignedArray positions = layout.to_slots(configuration.positions);
    PairInteraction interaction(model, configuration.box, layout, table, {.search = search});
    // Whatever a kernel does not write must show.
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
    // Over all pairs there is no kernel that leaves the energy out.
    if (search == PairSearch::list) gradient_bits.add(name, (g_only != g) + (g_stress != g));
  }
  std::vector<Deviation> deviations = {
      energy.deviation,          gradient_energy.deviation, gradient.deviation, gradient_virial.deviation, stress_energy.deviation,
      stress_gradient.deviation, stress_virial.deviation,   tensor.deviation,   energy_bits.deviation,     virial_bits.deviation};
  if (search == PairSearch::list) deviations.push_back(gradient_bits.deviation);
  return deviations;
}

}  // namespace

std::vector<Deviation> verify_lennard_jones(const kernels::KernelTable& table, const std::vector<PairCase>& cases) {
  return verify_search(table, cases, PairSearch::all_pairs, "lennard_jones_");
}

std::vector<Deviation> verify_lennard_jones_lists(const kernels::KernelTable& table, const std::vector<PairCase>& cases) {
  return verify_search(table, cases, PairSearch::list, "lennard_jones_list_");
}

namespace {

// Whether some pair is so near to the cutoff that in single precision it may be on the other side. Untruncated, all energies at a
// cutoff beyond the minimum have one sign.
bool has_pair_at_cutoff(const PairModel& model, const Configuration& configuration) {
  PairModel nearer = model;
  nearer.truncation = Truncation::plain;
  PairModel further = nearer;
  nearer.cutoff = model.cutoff * (1.0 - tolerance::lj_mixed_cutoff);
  further.cutoff = model.cutoff * (1.0 + tolerance::lj_mixed_cutoff);
  return evaluate_reference(nearer, configuration).energy != evaluate_reference(further, configuration).energy;
}

}  // namespace

std::vector<Deviation> verify_lennard_jones_mixed(const kernels::KernelTable& table, const std::vector<PairCase>& cases) {
  Check energy(table, "lennard_jones_list_energy_mixed", tolerance::lj_mixed_sums),
      gradient_energy(table, "lennard_jones_list_gradient_mixed energy", tolerance::lj_mixed_sums),
      gradient(table, "lennard_jones_list_gradient_mixed gradient", tolerance::lj_mixed_gradient),
      virial(table, "lennard_jones_list_gradient_mixed virial", tolerance::lj_mixed_sums);
  Check energy_bits(table, "lennard_jones_list_energy_mixed, lennard_jones_list_gradient_mixed: same energy", tolerance::exact);
  Check gradient_bits(table, "lennard_jones_list_force_mixed, lennard_jones_list_gradient_mixed: same gradient", tolerance::exact);
  for (const auto& [name, model, configuration] : cases) {
    if (!fits_list(model, configuration.box, default_skin) || has_pair_at_cutoff(model, configuration)) continue;
    const reference::Evaluation expected = evaluate_reference(model, configuration);
    const ParticleLayout layout(configuration.species, model.species.size());
    const AlignedArray positions = layout.to_slots(configuration.positions);
    PairInteraction interaction(model, configuration.box, layout, table, {.precision = Precision::mixed});
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

std::vector<Deviation> verify_vector_algebra(const kernels::KernelTable& table) {
  Check dot(table, "dot", tolerance::vector_sum), distance(table, "distance_squared", tolerance::vector_sum),
      second(table, "displacement_moments second", tolerance::vector_sum),
      fourth(table, "displacement_moments fourth", tolerance::vector_sum);
  Check difference(table, "difference", tolerance::exact), combine(table, "combine", tolerance::linear_combination),
      axpy(table, "axpy", tolerance::linear_combination),
      largest_displacement(table, "largest_displacement_squared", tolerance::displacement),
      lengths(table, "add_particle_lengths", tolerance::displacement);
  // The short ones leave each remainder of the four partial sums; the long ones show how errors grow.
  for (const std::size_t slots : {0U, 8U, 16U, 24U, 32U, 40U, 48U, 56U, 64U, 72U, 112U, 264U, 1000U}) {
    const std::size_t n = 3 * slots;
    const std::string name = fmt::format("3 x {} slots", slots);
    const AlignedArray a = random_array(n, 1), b = random_array(n, 2), c = random_array(n, 3);
    const double p = 1.0 / 3.0, q = -1.0 / 7.0;

    Sum product, square;
    for (std::size_t i = 0; i < n; ++i) {
      product.add(static_cast<long double>(a[i]) * b[i]);
      square.add((static_cast<long double>(a[i]) - b[i]) * (static_cast<long double>(a[i]) - b[i]));
    }
    dot.add(name, relative(table.dot(a.data(), b.data(), n), product.value, product.magnitude));
    distance.add(name, relative(table.distance_squared(a.data(), b.data(), n), square.value, square.magnitude));

    Sum squares, fourths;
    long double largest = 0.0L;
    double worst_length = 0.0;
    AlignedArray sums = random_array(slots, 4);
    const AlignedArray before = sums;
    table.add_particle_lengths(sums.data(), a.data(), b.data(), slots);
    for (std::size_t i = 0; i < slots; ++i) {
      long double r2 = 0.0L;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const long double d = static_cast<long double>(b[axis * slots + i]) - a[axis * slots + i];
        r2 += d * d;
      }
      squares.add(r2);
      fourths.add(r2 * r2);
      largest = std::max(largest, r2);
      const long double r = std::sqrt(r2);
      worst_length = std::max(worst_length, relative(sums[i], before[i] + r, std::abs(before[i]) + r));
    }
    largest_displacement.add(name,
                             relative(table.largest_displacement_squared(a.data(), b.data(), slots, 0, slots), largest, largest));
    lengths.add(name, worst_length);
    const kernels::DisplacementMoments moments = table.displacement_moments(a.data(), b.data(), slots);
    second.add(name, relative(moments.second, squares.value, squares.magnitude));
    fourth.add(name, relative(moments.fourth, fourths.value, fourths.magnitude));

    AlignedArray out(n, std::numeric_limits<double>::quiet_NaN());
    table.difference(out.data(), a.data(), b.data(), n);
    double wrong = 0.0;
    for (std::size_t i = 0; i < n; ++i) wrong += !same_bits(out[i], a[i] - b[i]);
    difference.add(name, wrong);

    double worst = 0.0;
    table.axpy(out.data(), a.data(), p, b.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
      Sum expected;
      expected.add(a[i]);
      expected.add(static_cast<long double>(p) * b[i]);
      worst = std::max(worst, relative(out[i], expected.value, expected.magnitude));
    }
    axpy.add(name, worst);

    worst = 0.0;
    table.combine(out.data(), a.data(), p, b.data(), q, c.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
      Sum expected;
      expected.add(a[i]);
      expected.add(static_cast<long double>(p) * b[i]);
      expected.add(static_cast<long double>(q) * c[i]);
      worst = std::max(worst, relative(out[i], expected.value, expected.magnitude));
    }
    combine.add(name, worst);
  }
  return {dot.deviation,        distance.deviation, second.deviation, fourth.deviation,
          difference.deviation, combine.deviation,  axpy.deviation,   largest_displacement.deviation,
          lengths.deviation};
}

std::vector<Deviation> verify_kernels(Isa isa, const std::vector<PairCase>& cases) {
  const kernels::KernelTable& table = kernel_table(isa);
  std::vector<Deviation> deviations = verify_lennard_jones(table, cases);
  for (auto& deviation : verify_lennard_jones_lists(table, cases)) deviations.push_back(std::move(deviation));
  for (auto& deviation : verify_lennard_jones_mixed(table, cases)) deviations.push_back(std::move(deviation));
  for (auto& deviation : verify_probes(table, cases)) deviations.push_back(std::move(deviation));
  for (auto& deviation : verify_vector_algebra(table)) deviations.push_back(std::move(deviation));
  for (auto& deviation : verify_state_mixtures(table, state_mixture_cases())) deviations.push_back(std::move(deviation));
  for (auto& deviation : verify_hard_spheres(table, hard_sphere_cases())) deviations.push_back(std::move(deviation));
  for (auto& deviation : verify_event_driven(table)) deviations.push_back(std::move(deviation));
  return deviations;
}

}  // namespace lanescape
