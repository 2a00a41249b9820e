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
class SimulatedParticles {
 public:
  SimulatedParticles(const lanescape::Model& model, const Units& units) : units_(units), potential_(model) {}

  struct Outputs {
    double *energy, *forces, *energies, *virial;  // null: not wanted
  };
  // In the simulator's units. Throws lanescape::Error for coordinates that are not finite.
  void evaluate(const Particles& particles, const Outputs& outputs);

 private:
  // Positions in the library's unit.
  std::span<const double> positions_of(const Particles& particles);

  Units units_;
  lanescape::DomainPotential potential_;
  std::vector<double> scaled_;
};

}  // namespace lanescape_kim
