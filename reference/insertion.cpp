#include "reference/insertion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lanescape::reference {
namespace {

using Vector = std::array<double, 3>;

// u, its absolute terms, and -u'(r)/r with its absolute terms, at r^2 below the cutoff.
struct Pair {
  double u, u_magnitude, pull, pull_magnitude;
};

Pair pair_at(const Mixture& mixture, std::size_t ab, double r_squared, Truncation truncation) {
  const auto powers = [&](double squared) {
    const double x = mixture.sigma[ab] * mixture.sigma[ab] / squared;
    return Vector{4.0 * mixture.epsilon[ab] * std::pow(x, 6), 4.0 * mixture.epsilon[ab] * std::pow(x, 3), 0.0};
  };
  const auto [twelve, six, unused] = powers(r_squared);
  const auto [twelve_c, six_c, unused_c] = powers(mixture.cutoff[ab] * mixture.cutoff[ab]);
  const double shift = truncation == Truncation::shifted ? twelve_c - six_c : 0.0;
  return {twelve - six - shift, twelve + six + std::abs(shift), (12.0 * twelve - 6.0 * six) / r_squared,
          (12.0 * twelve + 6.0 * six) / r_squared};
}

}  // namespace

Probe probe(const Vector& position, int species_of_probe, std::span<const double> positions, std::span<const int> species,
            const Vector& box, const Mixture& mixture, Truncation truncation) {
  Probe sum;
  const auto row = static_cast<std::size_t>(species_of_probe) * mixture.species;
  const auto add_images = [&](const Vector& other, std::size_t ab, double weight, bool self) {
    Vector nearest;
    std::array<int, 3> reach;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = position[axis] - other[axis];
      nearest[axis] = d - box[axis] * std::nearbyint(d / box[axis]);
      reach[axis] = static_cast<int>(std::ceil(mixture.cutoff[ab] / box[axis] + 0.5));
    }
    for (int x = -reach[0]; x <= reach[0]; ++x)
      for (int y = -reach[1]; y <= reach[1]; ++y)
        for (int z = -reach[2]; z <= reach[2]; ++z) {
          if (self && x == 0 && y == 0 && z == 0) continue;
          const Vector d = {nearest[0] + x * box[0], nearest[1] + y * box[1], nearest[2] + z * box[2]};
          const double r_squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
          if (r_squared >= mixture.cutoff[ab] * mixture.cutoff[ab]) continue;
          const Pair pair = pair_at(mixture, ab, r_squared, truncation);
          sum.energy += weight * pair.u;
          sum.magnitude += weight * pair.u_magnitude;
          for (std::size_t axis = 0; axis < 3 && !self; ++axis) {
            sum.gradient[axis] -= pair.pull * d[axis];
            sum.gradient_magnitude[axis] += pair.pull_magnitude * std::abs(d[axis]);
          }
        }
  };
  for (std::size_t j = 0; j < species.size(); ++j)
    add_images({positions[3 * j], positions[3 * j + 1], positions[3 * j + 2]}, row + static_cast<std::size_t>(species[j]), 1.0,
               false);
  add_images(position, row + static_cast<std::size_t>(species_of_probe), 0.5, true);
  if (truncation == Truncation::tail) {
    // 2 pi N_a N_b / V times the integral of r^2 u beyond the cutoff, over a and b, grows with one more particle by this.
    std::vector<double> count(mixture.species, 0.0);
    for (const int s : species) count[static_cast<std::size_t>(s)] += 1.0;
    for (std::size_t b = 0; b < mixture.species; ++b) {
      const double r_c = mixture.cutoff[row + b], x = std::pow(mixture.sigma[row + b] / r_c, 6);
      const double integral = 4.0 * mixture.epsilon[row + b] * std::pow(r_c, 3) * (x * x / 9.0 - x / 3.0);
      const double pairs = 2.0 * count[b] + (b == static_cast<std::size_t>(species_of_probe) ? 1.0 : 0.0);
      sum.energy += 2.0 * std::numbers::pi * pairs / (box[0] * box[1] * box[2]) * integral;
      sum.magnitude += std::abs(2.0 * std::numbers::pi * pairs / (box[0] * box[1] * box[2]) * integral);
    }
  }
  return sum;
}

bool is_clear(const Vector& position, std::span<const double> clearances, std::span<const double> positions,
              std::span<const int> species, const Vector& box) {
  for (std::size_t j = 0; j < species.size(); ++j) {
    double squared = 0.0;  // of the nearest image
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = position[axis] - positions[3 * j + axis], nearest = d - box[axis] * std::nearbyint(d / box[axis]);
      squared += nearest * nearest;
    }
    const double clearance = clearances[static_cast<std::size_t>(species[j])];
    if (squared < clearance * clearance) return false;
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
