#pragma once

// What other programs link against, all of it. Lengths, energies and masses are in any consistent units; k_B = 1. Wherever a
// function throws, it throws lanescape::Error with a code and one line saying what is wrong, where and what is allowed.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <lanescape/version.h>
#include <lanescape/dynamics.hpp>
#include <lanescape/error.hpp>
#include <lanescape/hard_spheres.hpp>
#include <lanescape/insertion.hpp>
#include <lanescape/landscape.hpp>
#include <lanescape/model.hpp>
#include <lanescape/path.hpp>
#include <lanescape/potential.hpp>
#include <lanescape/states.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// The library's version, e.g. "0.1.0".
LANESCAPE_API const char* version() noexcept;
// Instruction sets the kernels can use on this processor, best last.
LANESCAPE_API std::vector<std::string> instruction_sets();

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
