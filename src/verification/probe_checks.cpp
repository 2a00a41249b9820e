#include "verification/probe_checks.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/random.hpp"
#include "interaction/pair/probe_field.hpp"
#include "verification/check.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

// Only a few of the large cases, because the reference visits every particle.
constexpr std::size_t probes_per_case = 12;

bool fits_probe(const PairModel& model, const Box& box) {
  constexpr double largest_diameter = 1.2;  // of form_cases()
  const double cutoff = model.largest_cutoff() * (model.form->has_diameters ? largest_diameter : 1.0);
  return model.images == ImageRule::all || 2.0 * cutoff <= box.shortest();
}

Configuration without(const Configuration& all, std::size_t particle) {
  Configuration rest = all;
  const auto at = static_cast<std::ptrdiff_t>(particle);
  rest.species.erase(rest.species.begin() + at);
  if (!rest.diameters.empty()) rest.diameters.erase(rest.diameters.begin() + at);
  rest.positions.erase(rest.positions.begin() + 3 * at, rest.positions.begin() + 3 * at + 3);
  return rest;
}

// The number of random positions at which kernel and reference differ. The first query covers all positions; each later query
// covers those after the last clear one.
double wrongly_clear(const PairModel& model, const Configuration& configuration, const kernels::KernelTable& table) {
  constexpr std::size_t places = 40;
  constexpr double clear_energy = 60.0;
  const CounterRandom random(1, RandomStream::sites);
  const ProbeField field(model, configuration, 0, table);
  const std::vector<double> clearances = field.clearances(clear_energy);
  std::vector<double> positions;
  std::vector<bool> expected, found(places, false);
  for (std::uint32_t k = 0; k < places; ++k) {
    std::array<double, 3> place = random.uniform_point(0, k);
    for (std::size_t axis = 0; axis < 3; ++axis) positions.push_back(place[axis] *= configuration.box.length[axis]);
    expected.push_back(reference::is_clear(place, clearances, configuration.positions, configuration.species,
                                           configuration.box.length, configuration.box.periodic));
  }
  for (std::size_t k = 0; k < places; ++k) {
    k += field.first_clear(clearances, std::span(positions).subspan(3 * k));
    if (k < places) found[k] = true;
  }
  double wrong = 0.0;
  for (std::size_t k = 0; k < places; ++k) wrong += found[k] != expected[k];
  return wrong;
}

}  // namespace

std::vector<Deviation> verify_probes(const kernels::KernelTable& table, const std::vector<PairCase>& cases,
                                     const std::string& form) {
  Check energy(table, form + "_probe energy", tolerance::pair_sums),
      gradient(table, form + "_probe gradient", tolerance::pair_gradient),
      energy_bits(table, form + "_probe, " + form + "_probe_energies: same energy", tolerance::exact),
      clear(table, "probe_first_clear (" + form + ")", tolerance::exact);
  for (const auto& [name, model, configuration] : with_open_cases(cases)) {
    if (!fits_probe(model, configuration.box)) continue;
    const double allowance = rounding_allowance(configuration);
    clear.add(name, wrongly_clear(model, configuration, table));
    const std::size_t stride = std::max<std::size_t>(1, configuration.size() / probes_per_case);
    for (std::size_t i = 0; i < configuration.size(); i += stride) {
      const Configuration rest = without(configuration, i);
      const auto position = configuration.position(i);
      const double diameter = configuration.diameters.empty() ? 1.0 : configuration.diameters[i];
      const reference::Probe expected = probe_reference(model, rest, position, configuration.species[i], diameter);
      const ProbeField field(model, rest, configuration.species[i], table, diameter);
      const ProbeField::Sample sample = field.sample(position);
      energy.add(name, relative(sample.energy, expected.energy, expected.magnitude) / allowance);
      const double scale = *std::max_element(expected.gradient_magnitude.begin(), expected.gradient_magnitude.end());
      for (std::size_t axis = 0; axis < 3; ++axis)
        gradient.add(name, relative(sample.gradient[axis], expected.gradient[axis], scale) / allowance);
      energy_bits.add(name, !same_bits(sample.energy, field.energy(position)));
    }
  }
  return {energy.deviation, gradient.deviation, energy_bits.deviation, clear.deviation};
}

}  // namespace lanescape
