#include "reference/insertion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace lanescape::reference {
namespace {

/// One image of a particle at r, d the probe's position less r. Own images stand for half a pair and exert no force: d and -d
/// cancel.
void add_pair(Probe& sum, const Vector& d, const PairPotential& potential, bool own_image) {
  const double r = std::sqrt(dot(d, d));
  const PairValue pair = value(potential, r);
  const double weight = own_image ? 0.5 : 1.0;
  sum.energy += weight * pair.u;
  sum.magnitude += weight * pair.u_magnitude;
  if (own_image) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sum.gradient[axis] += pair.slope / r * d[axis];
    sum.gradient_magnitude[axis] += pair.slope_magnitude / r * std::abs(d[axis]);
  }
}

void add_images(Probe& sum, const Vector& separation, const Particles& fluid, const PairPotential& potential, bool itself) {
  const double r_c = cutoff(potential);
  for_each_image(separation, fluid.box, fluid.periodic, r_c, ImageRule::all, [&](const Image& image) {
    if (itself && image.nearest) return;
    if (!(dot(image.separation, image.separation) >= r_c * r_c)) add_pair(sum, image.separation, potential, itself);
  });
}

/// The sum over a, b of 2 pi N_a N_b / V times an integral grows by this with one more particle.
void add_tail_growth(Probe& sum, int species, const Particles& fluid, const PairMixture& mixture) {
  const std::vector<double> count = species_counts(fluid, mixture);
  const double volume = fluid.box[0] * fluid.box[1] * fluid.box[2];
  for (std::size_t b = 0; b < mixture.species; ++b) {
    const PairPotential& potential = mixture.potential(species, static_cast<int>(b));
    if (potential.truncation != Truncation::tail) continue;
    const double pairs = 2.0 * count[b] + (b == static_cast<std::size_t>(species) ? 1.0 : 0.0);
    const double energy = 2.0 * std::numbers::pi * pairs / volume * tail_integrals(potential).energy;
    sum.energy += energy;
    sum.magnitude += std::abs(energy);
  }
}

}  // namespace

Probe probe(const Probed& probed, const Particles& fluid, const PairMixture& mixture) {
  check(fluid, mixture);
  if (probed.species < 0 || static_cast<std::size_t>(probed.species) >= mixture.species)
    throw std::invalid_argument("probe: species " + std::to_string(probed.species) + " outside [0, " +
                                std::to_string(mixture.species) + ")");
  if (!(probed.diameter > 0.0))
    throw std::invalid_argument("probe: diameter " + std::to_string(probed.diameter) + " is not positive");
  Probe sum;
  for (std::size_t j = 0; j < fluid.species.size(); ++j) {
    PairPotential potential = mixture.potential(probed.species, fluid.species[j]);
    if (!fluid.diameters.empty()) potential = between(potential, probed.diameter, fluid.diameters[j]);
    Vector separation = probed.position;
    for (std::size_t axis = 0; axis < 3; ++axis) separation[axis] -= fluid.positions[3 * j + axis];
    add_images(sum, separation, fluid, potential, false);
  }
  const PairPotential& own = mixture.potential(probed.species, probed.species);
  add_images(sum, {0.0, 0.0, 0.0}, fluid, between(own, probed.diameter, probed.diameter), true);
  add_tail_growth(sum, probed.species, fluid, mixture);
  return sum;
}

bool is_clear(const Vector& position, std::span<const double> clearances, std::span<const double> positions,
              std::span<const int> species, const Vector& box, const Periodic& periodic) {
  for (std::size_t j = 0; j < species.size(); ++j) {
    const double clearance = clearances[static_cast<std::size_t>(species[j])];
    Vector separation = position;
    for (std::size_t axis = 0; axis < 3; ++axis) separation[axis] -= positions[3 * j + axis];
    bool clear = true;
    for_each_image(separation, box, periodic, clearance, ImageRule::minimum,
                   [&](const Image& image) { clear = !(dot(image.separation, image.separation) < clearance * clearance); });
    if (!clear) return false;
  }
  return true;
}

Vector usher_step(const UsherRule& rule, double energy, const Vector& gradient) {
  const double slope = std::hypot(gradient[0], gradient[1], gradient[2]);
  const double ds = energy > rule.overlap_energy ? rule.contact - std::pow(4.0 / energy, 1.0 / 12.0)
                                                 : std::min(std::abs(energy - rule.target) / slope, rule.largest_step);
  const double sign = energy > rule.target ? 1.0 : -1.0;
  Vector step;
  for (std::size_t axis = 0; axis < 3; ++axis) step[axis] = -sign * ds * gradient[axis] / slope;
  return step;
}

UsherTrial usher_trial(const UsherRule& rule, double tolerance, std::size_t most, const Vector& start,
                       const std::function<Probe(const Vector&)>& evaluate) {
  UsherTrial trial{false, start, 0.0, 0};
  double previous = 0.0, sign = 0.0;
  while (trial.evaluations < most) {
    const Probe here = evaluate(trial.position);
    ++trial.evaluations;
    trial.energy = here.energy;
    trial.found = std::abs(here.energy - rule.target) <= tolerance;
    const bool uphill = trial.evaluations > 1 && sign * (here.energy - previous) > 0.0 && sign * (here.energy - rule.target) > 0.0;
    if (trial.found || uphill) return trial;
    previous = here.energy;
    sign = here.energy > rule.target ? 1.0 : -1.0;
    const Vector step = usher_step(rule, here.energy, here.gradient);
    for (std::size_t axis = 0; axis < 3; ++axis) trial.position[axis] += step[axis];
  }
  return trial;
}

}  // namespace lanescape::reference
