#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"
#include "core/slot_work.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "kernel_table.hpp"
#include "neighbour/exclusions.hpp"
#include "neighbour/neighbour_list.hpp"

namespace lanescape {

// Slots of a layout that have no particle, and what their gradients are.
std::vector<std::size_t> slots_without_particle(const ParticleLayout& layout);
void clear_slots(const std::vector<std::size_t>& slots, AlignedArray& gradient);

// The sums over pairs that depend on positions, by whichever way of finding the pairs; PairInteraction adds the rest.
class PairSums {
 public:
  virtual ~PairSums() = default;
  virtual double energy(const AlignedArray& positions) = 0;
  virtual void gradient_only(const AlignedArray& positions, AlignedArray& gradient) = 0;
  // The same at the positions to which `move` brings the particles.
  virtual void gradient_after(const SlotWork& move, const AlignedArray& positions, AlignedArray& gradient) {
    move(0, positions.size() / 3);
    gradient_only(positions, gradient);
  }
  virtual void gradient(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) = 0;
  virtual void stress(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) = 0;
  // Takes another box for what follows.
  virtual void set_box(const PairModel& model, const Box& box) = 0;
  // What an evaluation does to that which exchange() archives.
  virtual void pass_over(const AlignedArray&) {}
  // What else than the positions the bits depend on.
  virtual void exchange(Archive&) {}
};

// Every pair once, whether near or not: for small systems, and for the minimum-image rule in small boxes. One thread.
class AllPairsSums final : public PairSums {
 public:
  AllPairsSums(const PairModel& model, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table);

  double energy(const AlignedArray& positions) override;
  void gradient_only(const AlignedArray& positions, AlignedArray& gradient) override;
  void gradient(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) override;
  void stress(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) override;
  void set_box(const PairModel& model, const Box& box) override;

 private:
  // Sets input_.shells; returns whether a pair needs a search over lattice shifts.
  bool find_images(const PairModel& model, const Box& box);
  kernels::PairInput input(const AlignedArray& positions);

  const kernels::PairKernels* kernels_;
  std::vector<kernels::SpeciesBlock> blocks_;
  std::vector<kernels::PairParameters> pairs_;
  std::vector<kernels::ImageSearch> images_;  // of pairs_
  AlignedArray scratch_;
  AlignedArray given_diameters_, diameters_;  // the second in the unit of pairs_
  double scale_;                              // of cutoffs
  kernels::PairInput input_{};
};

// Over a neighbour list, on any number of threads with the same bits.
class ListSums final : public PairSums {
 public:
  ListSums(const PairModel& model, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table, double skin,
           int threads, Precision precision);

  double energy(const AlignedArray& positions) override;
  void gradient_only(const AlignedArray& positions, AlignedArray& gradient) override;
  void gradient_after(const SlotWork& move, const AlignedArray& positions, AlignedArray& gradient) override;
  void gradient(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) override;
  void stress(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) override;
  void set_box(const PairModel&, const Box& box) override { list_.set_box(box); }
  void pass_over(const AlignedArray& positions) override { list_.update(positions); }
  void exchange(Archive& archive) override { list_.exchange(archive); }

  // Per slot, half of each of its pairs. Writes to every slot that has a particle.
  void energies(const AlignedArray& positions, AlignedArray& energies);
  void set_exclusions(std::shared_ptr<const Exclusions> exclusions) { list_.set_exclusions(std::move(exclusions)); }

  const NeighbourList& list() const { return list_; }
  NeighbourList& list() { return list_; }

 private:
  // evaluate(input of a block's rows, records for their gradients, sums of the block) for every block, after `move`.
  template <class Evaluate>
  void for_each_block(const AlignedArray& positions, Evaluate evaluate, const SlotWork& move = {});
  void put_gradient(std::size_t block, const double* records, AlignedArray& gradient) const;
  kernels::PairOutput total() const;

  const kernels::PairKernels* kernels_;
  Precision precision_;
  std::vector<kernels::PairParameters> pairs_;
  std::vector<kernels::SinglePairParameters> single_pairs_;  // of mixed precision, else none
  NeighbourList list_;
  AlignedArray diameters_;                 // per slot, where the form has them
  std::uint64_t diameters_at_ = 0;         // the rebuild after which the list was given them
  std::vector<std::size_t> padding_;       // slots without a particle
  std::vector<kernels::PairOutput> sums_;  // of each block
};

}  // namespace lanescape
