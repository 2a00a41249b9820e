#include "particles.hpp"

#include <algorithm>

namespace lanescape_kim {
namespace {

using lanescape::ListedPotential;
using lanescape::NeighbourFinder;
using lanescape::Vectors;

// The skin of lists, in largest cutoffs: half a sigma of Lennard-Jones at 2.5.
constexpr double relative_skin = 0.2;

}  // namespace

ListedParticles::ListedParticles(const lanescape::Model& model, const Units& units)
    : units_(units),
      skin_(relative_skin * model.largest_cutoff()),
      potential_(model, {.lists = ListedPotential::Lists::gradient}),
      finder_({.cutoffs = {model.largest_cutoff() + skin_},
               .periodic = {false, false, false},
               .order = NeighbourFinder::Order::any,
               .quantities = {.S = false, .D = false, .d = false}}) {}

std::span<const double> ListedParticles::positions_of(const Particles& particles) {
  const std::span<const double> given(particles.coordinates, 3 * particles.size());
  if (units_.length == 1.0) return given;
  scaled_.resize(given.size());
  std::ranges::transform(given, scaled_.begin(), [&](double x) { return x / units_.length; });
  return scaled_;
}

bool ListedParticles::lists_last(const Particles& particles, std::span<const double> positions) const {
  if (!std::ranges::equal(species_, particles.species) || !std::ranges::equal(contributing_, particles.contributing)) return false;
  double furthest = 0.0;  // squared
  for (std::size_t k = 0; k < positions.size(); k += 3) {
    const double x = positions[k] - listed_at_[k], y = positions[k + 1] - listed_at_[k + 1],
                 z = positions[k + 2] - listed_at_[k + 2];
    furthest = std::max(x * x + y * y + z * z, furthest);  // what is not finite is for the potential to name
  }
  return furthest <= 0.25 * skin_ * skin_;
}

void ListedParticles::find_neighbours(const Particles& particles, std::span<const double> positions) {
  species_.clear();  // nothing is known if this throws
  rows_.clear();
  own_.clear();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.contributing[i] == 0) continue;
    rows_.push_back(static_cast<int>(i));
    own_.insert(own_.end(), positions.begin() + static_cast<std::ptrdiff_t>(3 * i),
                positions.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
  }
  finder_.set_particles(positions, {1.0, 1.0, 1.0});
  const NeighbourFinder::Pairs pairs = finder_.neighbours(own_);
  lengths_.assign(particles.size(), 0);
  lists_.assign(particles.size(), nullptr);
  neighbours_.resize(pairs.count);
  int* next = neighbours_.data();
  for (std::size_t k = 0; k < pairs.count;) {  // the neighbours of a point follow each other
    const std::int64_t point = pairs.i[k];
    const int row = rows_[static_cast<std::size_t>(point)];
    int* const list = next;
    for (; k < pairs.count && pairs.i[k] == point; ++k)
      if (pairs.j[k] != row) *next++ = static_cast<int>(pairs.j[k]);
    lists_[static_cast<std::size_t>(row)] = list;
    lengths_[static_cast<std::size_t>(row)] = static_cast<int>(next - list);
  }
  potential_.set_lists({.species = particles.species, .rows = rows_, .neighbours = lists_.data(), .lengths = lengths_.data()});
  contributing_.assign(particles.contributing.begin(), particles.contributing.end());
  listed_at_.assign(positions.begin(), positions.end());
  species_.assign(particles.species.begin(), particles.species.end());
}

void ListedParticles::evaluate(const Particles& particles, const Outputs& outputs) {
  const std::span<const double> positions = positions_of(particles);
  if (!lists_last(particles, positions)) find_neighbours(particles, positions);
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
