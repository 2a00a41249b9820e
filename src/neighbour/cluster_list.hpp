#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/archive.hpp"
#include "core/parallel.hpp"
#include "core/slot_work.hpp"
#include "neighbour/cluster_blocks.hpp"
#include "neighbour/cluster_columns.hpp"
#include "neighbour/list_frame.hpp"

namespace lanescape {

// Pairs of clusters within a cutoff, with two skins: lists with the larger one are rebuilt rarely; from them those that are
// evaluated are pruned more often. Both happen once a particle has moved by half of the skin, so that no pair is missed. Pruning
// leaves out pairs that contribute nothing and keeps their order, so that no bit of a sum depends on when it happened: the
// positions of the last rebuild are all that a run has to keep.
class ClusterList {
 public:
  // `cutoffs`: species x species, symmetric [sigma]. Of boxes with edges of at least twice the longest cutoff and the larger skin.
  ClusterList(const Box& box, const ParticleLayout& layout, const std::vector<double>& cutoffs, double skin,
              const kernels::KernelTable& table, int threads);

  // The larger skin, which goes with a skin for lists that are not pruned.
  static constexpr double outer_skin(double skin) { return 3.0 * skin; }

  // Calls evaluate(block, pair, lists, gradients) for the lists of each block and pair of species, at the positions of the last
  // update().
  template <class Evaluate>
  void for_each_block(Evaluate evaluate) {
    lanescape::for_each_block(threads_, blocks_.count(), [&](std::size_t b) {
      blocks_.load(b, columns_);
      if (prune_) blocks_.prune(b);
      for (std::size_t p = 0; p < blocks_.species_pairs().size(); ++p) evaluate(b, p, blocks_.lists(b, p), blocks_.gradients(b));
    });
    prune_ = false;
  }
  // Writes `unit` times the gradients that were collected to every slot that has a particle.
  void put_gradients(double unit, AlignedArray& gradient);

  // As an evaluation at these positions does, to which `move` brings the particles, if there is one.
  void update(const AlignedArray& positions, const SlotWork& move = {});
  // Takes another box for what follows. Rebuilds lists then only if they do not outlast the change.
  void set_box(const Box& box);

  std::size_t block_count() const { return blocks_.count(); }
  const std::vector<ClusterBlocks::SpeciesPair>& species_pairs() const { return blocks_.species_pairs(); }
  double fixed_unit() const { return columns_.fixed_unit(); }  // [sigma]
  std::uint64_t rebuilds() const { return rebuilds_; }
  std::size_t memory() const;  // [bytes]

  // Archives where lists were made; reading rebuilds them there.
  void exchange(Archive& archive);

 private:
  void rebuild(const AlignedArray& positions);
  // Whether a particle has moved too far since lists were pruned; brings clusters up to date along the way.
  bool must_prune(const AlignedArray& positions, const SlotWork& move);
  bool is_due(const AlignedArray& positions) const;

  std::size_t slots_;
  int threads_;
  HalfSkin pruned_;  // its reference: where lists were pruned
  ListFrame frame_;
  ClusterColumns columns_;
  ClusterBlocks blocks_;
  std::vector<std::vector<double>> sums_;  // scratch of each thread
  bool prune_ = false;
  std::uint64_t rebuilds_ = 0;
};

}  // namespace lanescape
