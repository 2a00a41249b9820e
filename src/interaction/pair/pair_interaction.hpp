#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"
#include "core/segment_bound.hpp"
#include "core/slot_work.hpp"
#include "interaction/pair/images.hpp"
#include "interaction/pair/long_range.hpp"
#include "interaction/pair/pair_search.hpp"
#include "interaction/pair/separations.hpp"
#include "interaction/reduced_positions.hpp"
#include "kernel_table.hpp"

namespace lanescape {

class ClusterSums;
class Exclusions;
class ListSums;
class NearestRows;
class NeighbourList;
class PairSums;

// Energy, gradient and virial of one mixture in one box by the kernels of one instruction set. Holds the scratch memory of an
// evaluation and the neighbour list, so that each caller's thread needs its own. Coordinates are in the layout's order.
class PairInteraction {
 public:
  // Throws what check_cutoff() throws, and Error(bad_input) where a list is asked for, or needed for mixed precision or an open
  // axis, that the minimum-image rule or PairSearch::all_pairs does not allow.
  PairInteraction(const PairModel& model, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table,
                  const PairSearchOptions& options = {});
  PairInteraction(PairInteraction&&) noexcept;
  PairInteraction& operator=(PairInteraction&&) noexcept;
  ~PairInteraction();

  // Takes another box [sigma] for what follows, at a fraction of the cost of a new object and without memory of its own. Throws
  // what the constructor throws; nothing has then changed. Results are those of a new object: to the bit over all pairs, and to
  // rounding over a list, which outlasts small changes of the box (ListFrame) and then has another order than a new one.
  void set_box(const Box& box);
  const Box& box() const { return box_; }

  struct Evaluation {
    double energy = 0.0;                    // [epsilon]
    double virial = 0.0;                    // sum r.f [epsilon]
    std::array<double, 6> virial_tensor{};  // sum r_a f_b, Voigt xx yy zz yz xz xy; from energy_and_stress only
  };

  // Pairs of particles, in the user's order and from 0, that do not interact; they replace those of an earlier call. Only the
  // nearest image of a pair is left out (over a list, the one that was nearest when the list was made), and nothing of a long-range
  // correction. Automatic search then takes a list wherever there can be one: its rows leave the pairs out, at any distance. Over
  // all pairs they are subtracted, which costs up to 1e-14 of a pair's own energy: measured 3e-12 epsilon at half a Lennard-Jones
  // diameter, 1e-6 at a fifth, 5e-3 at a tenth. Throws what Exclusions does; nothing has then changed.
  void set_exclusions(std::span<const std::array<std::size_t, 2>> pairs);

  double energy(const AlignedArray& positions);
  void gradient(const AlignedArray& positions, AlignedArray& gradient);
  // The same at the positions to which `move` brings the particles, in fewer loops of threads where there is a list.
  void gradient_after(const SlotWork& move, const AlignedArray& positions, AlignedArray& gradient);
  Evaluation energy_and_gradient(const AlignedArray& positions, AlignedArray& gradient);
  // In double precision always.
  Evaluation energy_and_stress(const AlignedArray& positions, AlignedArray& gradient);

  // Of each slot: half of each of its pairs and of its own images, and its share of the long-range correction [epsilon]; zero for
  // padding. Their sum is the energy up to rounding. A system without a list takes one for this purpose, made at each call.
  void energies(const AlignedArray& positions, AlignedArray& energies);

  // Bounds of the energy along segments up to `longest` [sigma], null where none is known; they hold for this box.
  std::unique_ptr<SegmentBound> segment_bound(double longest) const;
  // Leaves a list as an evaluation at these positions would.
  void pass_over(const AlignedArray& positions);

  // What else than positions and box the bits of a result depend on: where a list was made.
  void exchange(Archive& archive);
  // Whether pairs are found by a list, of neighbours or of clusters; how often it was made, and its memory [bytes].
  bool has_list() const;
  std::uint64_t rebuilds() const;
  std::size_t list_memory() const;
  // The list of neighbours, if that is it.
  const NeighbourList* list() const;

 private:
  double scale() const;  // of cutoffs
  std::unique_ptr<PairSums> make_sums(const Box& reduced) const;
  // What does not depend on the positions: own images of a particle and long-range corrections.
  void find_constants();
  void add_images_of_self();
  // Those of particles of one kind, whose number is `count`.
  void add_images_of_one(const PairNumbers& numbers, double count, Evaluation& sum) const;
  void add_tail();
  bool wants_list(const Box& reduced) const;
  bool wants_clusters(const Box& reduced) const;
  ClusterSums* clusters() const;  // null if there are none
  // Half of each pair of each slot, where no list is at hand.
  void energies_without_list(const AlignedArray& reduced, AlignedArray& energies);
  void add_constants(AlignedArray& energies) const;
  Evaluation with_constants(const kernels::PairOutput& out) const;

  Box box_;
  ReducedPositions reduced_;
  // Lengths in the reduced unit.
  PairModel model_;
  ParticleLayout layout_;
  const kernels::KernelTable* table_;
  PairSearchOptions options_;
  std::unique_ptr<PairSums> sums_;
  std::unique_ptr<ListSums> spare_;  // for energies() where sums_ has no list
  std::unique_ptr<NearestRows> nearest_;
  std::vector<std::uint32_t> others_;  // for one of its rows
  std::shared_ptr<const Exclusions> exclusions_;  // null: none
  Evaluation constants_;
};

}  // namespace lanescape
