#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <lanescape/version.h>
#include <lanescape/export.hpp>

// What other programs link against. Reduced units: lengths in sigma, energies in epsilon, k_B = 1.
namespace lanescape {
LANESCAPE_ABI_BEGIN

// The library's version, e.g. "0.1.0".
LANESCAPE_API const char* version() noexcept;
// Instruction sets the kernels can use on this processor, best last.
LANESCAPE_API std::vector<std::string> instruction_sets();

// The potential energy of a Lennard-Jones mixture in a periodic orthorhombic box. Not thread-safe: one object per thread.
//
// Results do not depend on the caller's floating-point environment: rounding mode, traps and flushing to zero are set aside during
// a call. Two particles at one place give an energy and forces that are not finite.
class LANESCAPE_API LennardJonesPotential {
 public:
  struct Options {
    std::string model = "kob-andersen";  // or "lennard-jones"
    double cutoff = 2.5;                 // in units of sigma_ab
    std::string truncation = "shifted";  // or "plain", "tail"
    std::string images = "all";          // or "minimum"
    std::string isa = "auto";            // or a name from instruction_sets()
  };

  // `species[i]` is 0 or 1 for Kob-Andersen's A and B, 0 for the one component of "lennard-jones"; `box` holds edge lengths.
  // Throws std::runtime_error with one line saying what is wrong and what is allowed.
  LennardJonesPotential(std::span<const int> species, const std::array<double, 3>& box, const Options& options);
  ~LennardJonesPotential();
  LennardJonesPotential(LennardJonesPotential&&) noexcept;
  LennardJonesPotential& operator=(LennardJonesPotential&&) noexcept;

  // Positions x0 y0 z0 x1 ..., 3N of them, wrapped or not. Throws std::runtime_error if the length is not 3N or a
  // coordinate is not finite.
  double energy(std::span<const double> positions);
  // Also forces, -dV/dr, in the order of the positions, and optionally the virial sum r.f.
  double energy_and_forces(std::span<const double> positions, std::span<double> forces, double* virial = nullptr);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// Pairs of particles within a cutoff as arrays of one length, with ASE's conventions (neighbor_list("ijSDd")). An entry for each
// pair and direction, (i, j) and (j, i); pairs of a particle with its own images, i == j and S != 0, are among them. Sorted by i, j
// and S.
struct NeighbourPairs {
  std::vector<std::size_t> first, second;         // i and j, particles from 0
  std::vector<std::array<int, 3>> shift;          // S: whole boxes, for the positions as they were given
  std::vector<std::array<double, 3>> separation;  // D = r_j - r_i + S . box, in the unit of the positions
  std::vector<double> distance;                   // d = |D| < cutoff, in the unit of the positions
};

// All pairs in a periodic orthorhombic box, in time O(N) at a given density. `positions` x0 y0 z0 x1 ..., 3N of them, wrapped or
// not; `box` holds edge lengths. Any unit of length will do if it is the same for all. d < cutoff is decided in double precision,
// and the result is the same on every instruction set. Throws std::runtime_error with one line saying what is wrong and what is
// allowed: if the number of coordinates is not 3N, a number is not finite, an edge or the cutoff is not above 0, the cutoff is
// above 32 times the shortest edge, a particle is more than 1e8 boxes away, or there would be more than 1e9 images to look at.
LANESCAPE_API NeighbourPairs neighbour_pairs(std::span<const double> positions, const std::array<double, 3>& box, double cutoff);

LANESCAPE_ABI_END
}  // namespace lanescape
