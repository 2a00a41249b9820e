#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <lanescape/export.hpp>
#include <lanescape/owned.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// Finds pairs of particles within a cutoff, in orthorhombic boxes with periodic or open axes, with ASE's conventions
// (neighbor_list("ijSDd")): D = r_j - r_i + S . box for the positions as they were given, and d = |D| < cutoff, each operation
// rounded to double, so that pairs at the cutoff are the same on every instruction set. Any unit of length will do if it is the
// same for all. Time and memory are O(N) at a given density, in clusters far apart O(N log N).
//
// An object keeps its memory: calls allocate nothing once they have seen their largest system. Not thread-safe: one object per
// thread. All members throw Error(bad_input) with one line saying what is wrong and what is allowed; the object can still be used.
class LANESCAPE_API NeighbourFinder {
 public:
  enum class Members {
    full,  // (i, j, S) and (j, i, -S)
    half,  // that of the two with j > i; of a particle's own images that with S > 0 in the order x, y, z
  };
  enum class Order {
    sorted,  // by i, j and S
    any,     // faster; the order depends on the instruction set
  };
  // What is not wanted is neither computed nor written.
  struct Quantities {
    bool i = true, j = true, S = true, D = true, d = true;
    bool segments = false;  // needs Order::sorted
  };
  struct Options {
    // One cutoff, above 0; or species x species, symmetric, where 0 means that such pairs are never listed. At most 32 times the
    // shortest edge of a periodic axis.
    std::vector<double> cutoffs{};
    std::array<bool, 3> periodic{true, true, true};
    std::array<double, 3> origin{};  // the box's corner; open axes have no use for it
    Members members = Members::full;
    Order order = Order::sorted;
    Quantities quantities{};
    int threads = 1;                       // no result depends on it
    std::string instruction_set = "auto";  // or a name from instruction_sets()
  };
  // Views of the object's memory, valid until its next call; what is not wanted is empty.
  struct Pairs {
    std::size_t count = 0;
    std::span<const std::int64_t> i, j;      // particles from 0
    std::span<const std::int32_t> S;         // 3 per pair, whole boxes
    std::span<const double> D;               // 3 per pair
    std::span<const double> d;               // |D|
    std::span<const std::int64_t> segments;  // the first pair of each i, and `count`
  };

  explicit NeighbourFinder(const Options& options);
  ~NeighbourFinder();
  NeighbourFinder(NeighbourFinder&&) noexcept;
  NeighbourFinder& operator=(NeighbourFinder&&) noexcept;

  // Pairs (i, j) that find() never lists, in either direction, such as bonded ones. They replace those of the last call.
  void exclude(std::span<const std::pair<std::int64_t, std::int64_t>> pairs);

  // All pairs among particles, pairs of a particle with its own images included. `positions` x0 y0 z0 x1 ..., 3N numbers, wrapped
  // or not, along periodic axes at most 1e9 boxes from the origin; `box` holds edge lengths from 1e-100 to 1e100, open axes have no
  // use for them; `species` one per particle from 0, or none for a single species.
  Pairs find(std::span<const double> positions, const std::array<double, 3>& box, std::span<const std::int32_t> species = {});

  // Prepares the neighbours of other points among these particles.
  void set_particles(std::span<const double> positions, const std::array<double, 3>& box,
                     std::span<const std::int32_t> species = {});
  // The particles within the cutoff of each point, all of them whatever Members and exclusions say; i numbers the points.
  Pairs neighbours(std::span<const double> points, std::span<const std::int32_t> species = {});
  // Those of a single point.
  Pairs neighbours(const std::array<double, 3>& point, std::int32_t species = 0);

 private:
  struct Implementation;
  detail::Owned<Implementation> implementation_;
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

// All pairs in a periodic orthorhombic box: NeighbourFinder for a single call. `positions`, `box` and `cutoff` as there.
LANESCAPE_API NeighbourPairs neighbour_pairs(std::span<const double> positions, const std::array<double, 3>& box, double cutoff);

LANESCAPE_ABI_END
}  // namespace lanescape
