#include "particles.hpp"

#include <algorithm>

namespace lanescape_kim {
using lanescape::Vectors;

std::span<const double> SimulatedParticles::positions_of(const Particles& particles) {
  const std::span<const double> given(particles.coordinates, 3 * particles.size());
  if (units_.length == 1.0) return given;
  scaled_.resize(given.size());
  std::ranges::transform(given, scaled_.begin(), [&](double x) { return x / units_.length; });
  return scaled_;
}

void SimulatedParticles::evaluate(const Particles& particles, const Outputs& outputs) {
  const std::span<const double> positions = positions_of(particles);
  potential_.set_particles(particles.species, particles.contributing);
  lanescape::ListedOutputs wanted{.energy = outputs.energy != nullptr, .stress = outputs.virial != nullptr};
  const std::span<double> forces(outputs.forces, outputs.forces == nullptr ? 0 : positions.size());
  if (!forces.empty()) wanted.forces = Vectors<double>::interleaved(forces);
  if (outputs.energies != nullptr) wanted.energies = {outputs.energies, particles.size()};
  const lanescape::ListedEvaluation e = potential_.evaluate(Vectors<const double>::interleaved(positions), wanted);
  if (outputs.energy != nullptr) *outputs.energy = e.energy * units_.energy;
  // KIM's virial is the sum of r_a dV/dr_b.
  if (outputs.virial != nullptr)
    std::ranges::transform(e.virial_tensor, outputs.virial, [&](double v) { return -v * units_.energy; });
  if (units_.energy == 1.0 && units_.length == 1.0) return;
  for (double& f : forces) f *= units_.energy / units_.length;
  for (double& energy : wanted.energies) energy *= units_.energy;
}

}  // namespace lanescape_kim
