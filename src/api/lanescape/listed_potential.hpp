#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <lanescape/model.hpp>
#include <lanescape/owned.hpp>
#include <lanescape/potential.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// Neighbour lists as the host has them, of points: its particles, and ghosts, which are images of them or particles of other
// processes. Numbers of points from 0. Nothing is kept of it.
struct ListsOfHost {
  std::span<const int> species{};          // of each point, as the host numbers them (Options::species_of)
  std::span<const int> rows{};             // the points that have a list, each once
  const int* const* neighbours = nullptr;  // of point i: neighbours[i], lengths[i] of them; both indexed by all points
  const int* lengths = nullptr;
  unsigned mask = ~0U;  // the bits of a neighbour that number a point, where the host keeps others beside them
};

struct ListedOutputs {
  bool energy = true;            // costs a little more than forces alone
  Vectors<double> forces{};      // of each point
  bool add_to_forces = false;    // else they are overwritten
  std::span<double> energies{};  // of each point
  bool stress = false;           // the virial tensor; costs more
};

struct ListedEvaluation {
  double energy = 0.0;
  double virial = 0.0;                    // sum over pairs of r.f; with forces and energy, or stress
  std::array<double, 6> virial_tensor{};  // sum over pairs of r_a f_b, xx yy zz yz xz xy
};

// A pair potential over neighbour lists that the host makes: for engines with domains, ghosts and lists of their own. Lists are
// taken over once and used until the next ones; positions come with each call. There is no box: separations are plain differences,
// ghosts are where the host has put them, and the model's rule for images has no effect. Double precision. Not thread-safe: one
// object per thread.
//
// Neighbours farther away than the cutoff contribute nothing. Lists must hold all pairs within the cutoff until they are renewed.
class LANESCAPE_API ListedPotential {
 public:
  enum class Lists {
    // All neighbours of each point that has a list. The energy is half of each pair for each of its ends with a list. Forces are
    // those on the points with lists, complete; on ghosts none.
    rows,
    // The same lists and energy, and the forces that follow from this energy, on ghosts too: of a pair with a ghost half. The host
    // adds the ghosts' to the particles they are images of.
    gradient,
    // Each pair once, in the list of one of its two points. All of them count, forces are on both.
    half
  };
  struct Options {
    Lists lists = Lists::rows;
    std::vector<int> species_of{};  // the model's species of each of the host's; below 0: interacts with nothing. None: the same
    int threads = 1;                // that share an evaluation; no effect on any result
    std::string instruction_set = "auto";  // or a name of instruction_sets()
  };

  // Throws Error(bad_input) unless the model has a pair potential without diameters of particles and without truncation `tail`,
  // whose correction is the host's, as it has the volume.
  explicit ListedPotential(const Model& model);
  ListedPotential(const Model& model, const Options& options);
  ~ListedPotential();
  ListedPotential(ListedPotential&&) noexcept;
  ListedPotential& operator=(ListedPotential&&) noexcept;

  // The distance beyond which two of the model's species do not interact.
  double cutoff(std::size_t a, std::size_t b) const;

  // Call it whenever the host has made new lists. Throws Error(bad_input) for species that are unknown and points that do not
  // exist; there are then no lists.
  void set_lists(const ListsOfHost& lists);
  std::size_t points() const;  // of these lists

  // Positions of each point. Throws Error(bad_input) for another number of points, and naming one that is not finite.
  ListedEvaluation evaluate(const Vectors<const double>& positions, const ListedOutputs& outputs);

 private:
  struct Implementation;
  detail::Owned<Implementation> implementation_;
};

LANESCAPE_ABI_END
}  // namespace lanescape
