#include "verification/probe_checks.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "interaction/probe_field.hpp"
#include "verification/check.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

// Few of the large cases: the reference looks at every particle.
constexpr std::size_t probes_per_case = 12;

bool fits_probe(const LennardJonesModel& model, const Box& box) {
  const double cutoff = model.cutoff * *std::max_element(model.sigma.begin(), model.sigma.end());
  return model.images == ImageRule::all || 2.0 * cutoff <= box.shortest();
}

Configuration without(const Configuration& all, std::size_t particle) {
  Configuration rest = all;
  const auto at = static_cast<std::ptrdiff_t>(particle);
  rest.species.erase(rest.species.begin() + at);
  rest.positions.erase(rest.positions.begin() + 3 * at, rest.positions.begin() + 3 * at + 3);
  return rest;
}

}  // namespace

std::vector<Deviation> verify_probes(const kernels::KernelTable& table, const std::vector<LennardJonesCase>& cases) {
  Check energy(table, "lj_probe energy", tolerance::lj_sums), gradient(table, "lj_probe gradient", tolerance::lj_gradient),
      energy_bits(table, "lj_probe, lj_probe_energies: same energy", tolerance::exact);
  for (const auto& [name, model, configuration] : cases) {
    if (!fits_probe(model, configuration.box)) continue;
    const double allowance = rounding_allowance(configuration);
    const std::size_t stride = std::max<std::size_t>(1, configuration.size() / probes_per_case);
    for (std::size_t i = 0; i < configuration.size(); i += stride) {
      const Configuration rest = without(configuration, i);
      const auto position = configuration.position(i);
      const reference::Probe expected = probe_reference(model, rest, position, configuration.species[i]);
      const ProbeField field(model, rest, configuration.species[i], table);
      const ProbeField::Sample sample = field.sample(position);
      energy.add(name, relative(sample.energy, expected.energy, expected.magnitude) / allowance);
      const double scale = *std::max_element(expected.gradient_magnitude.begin(), expected.gradient_magnitude.end());
      for (std::size_t axis = 0; axis < 3; ++axis)
        gradient.add(name, relative(sample.gradient[axis], expected.gradient[axis], scale) / allowance);
      energy_bits.add(name, !same_bits(sample.energy, field.energy(position)));
    }
  }
  return {energy.deviation, gradient.deviation, energy_bits.deviation};
}

}  // namespace lanescape
