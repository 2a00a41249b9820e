#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lanescape/lanescape.hpp>

namespace lanescape_kim {

// The library's units are those of model files, Angstrom and eV; a simulator's are so many times these.
struct Units {
  double length = 1.0, energy = 1.0;
};

// What a simulator hands over for an evaluation: particles that contribute to the energy, and others around them.
struct Particles {
  std::span<const int> species, contributing;
  const double* coordinates;

  std::size_t size() const { return species.size(); }
};

// A potential over the particles of one simulator, with lists of its own. The simulator has lists too, but nobody says when they
// change: to compare them with the last ones takes longer than to look for neighbours once a particle has moved far enough.
class ListedParticles {
 public:
  ListedParticles(const lanescape::Model& model, const Units& units);

  struct Outputs {
    double *energy, *forces, *energies, *virial;  // null: not wanted
  };
  // In the simulator's units. Throws lanescape::Error for coordinates that are not finite.
  void evaluate(const Particles& particles, const Outputs& outputs);

 private:
  // Positions in the library's unit.
  std::span<const double> positions_of(const Particles& particles);
  // Whether the lists have all neighbours of these: the same particles, none farther than half the skin from where it was.
  bool lists_last(const Particles& particles, std::span<const double> positions) const;
  void find_neighbours(const Particles& particles, std::span<const double> positions);

  Units units_;
  double skin_;
  lanescape::ListedPotential potential_;
  lanescape::NeighbourFinder finder_;
  // Of the last lists.
  std::vector<double> listed_at_;
  std::vector<int> species_, contributing_, rows_;
  std::vector<int> neighbours_, lengths_;
  std::vector<const int*> lists_;
  std::vector<double> scaled_, own_;
};

}  // namespace lanescape_kim
