#pragma once

#include <memory>
#include <vector>

#include "interaction/pair/pair_sums.hpp"
#include "neighbour/cluster_list.hpp"

namespace lanescape {

// In mixed precision over clusters, on any number of threads with the same bits; stresses and energies of particles over a list of
// neighbours, which is made when they are first asked for.
class ClusterSums final : public PairSums {
 public:
  ClusterSums(const PairModel& model, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table, double skin,
              int threads);

  // Whether clusters can hold these particles in this box.
  static bool can_hold(const PairModel& model, const Box& box, const ParticleLayout& layout, double skin);
  // From so many particles on steps over clusters are faster than over lists of neighbours (docs/PERFORMANCE.md). Columns of the rarer
  // of several species have few particles, and their clusters are long.
  static constexpr std::size_t crossover(std::size_t species) { return species == 1 ? 4000 : 6000; }

  double energy(const AlignedArray& positions) override;
  void gradient_only(const AlignedArray& positions, AlignedArray& gradient) override;
  void gradient_after(const SlotWork& move, const AlignedArray& positions, AlignedArray& gradient) override;
  void gradient(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) override;
  void stress(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) override;
  void set_box(const PairModel& model, const Box& box) override;
  void pass_over(const AlignedArray& positions) override { list_.update(positions); }
  void exchange(Archive& archive) override;

  // A list of neighbours, which gives what clusters do not.
  ListSums& rows();
  const ClusterList& list() const { return list_; }

 private:
  // Parameters of a pair of species.
  struct Parameters {
    kernels::PairParameters exact;
    kernels::SinglePairParameters single;
  };
  kernels::ClusterInput input(const kernels::ClusterLists& lists, std::size_t pair) const;
  template <class Evaluate>
  void for_each_block(const AlignedArray& positions, Evaluate evaluate, const SlotWork& move = {});
  kernels::PairOutput total() const;
  void put_gradients(AlignedArray& gradient);

  PairModel model_;
  Box box_;
  ParticleLayout layout_;
  const kernels::KernelTable* table_;
  double skin_;
  int threads_;
  const kernels::PairKernels* kernels_;
  ClusterList list_;
  std::vector<kernels::PairParameters> pairs_;
  std::vector<kernels::SinglePairParameters> single_pairs_;
  std::vector<std::size_t> padding_;       // slots without a particle
  std::vector<kernels::PairOutput> sums_;  // of each block and pair of species
  std::unique_ptr<ListSums> rows_;
};

}  // namespace lanescape
