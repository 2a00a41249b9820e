#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/archive.hpp"
#include "landscape/soft_landscape.hpp"
#include "path/polyline.hpp"
#include "path/shortening/node_blocks.hpp"

namespace lanescape {

// The nodes of a path on a landscape, with V, grad V and the level that V must not exceed at each.
class SoftNodes {
 public:
  SoftNodes(const SoftLandscapeMaker& make_landscape, std::size_t nodes, int threads);

  const NodeBlocks& blocks() const { return blocks_; }
  const VectorAlgebra& algebra() const { return landscapes_.front()->algebra(); }
  std::uint64_t evaluations() const;

  // V, its slope |grad V| and its unit normal grad V/|grad V| at nodes of a path.
  struct Field {
    explicit Field(const Polyline& at) : nodes(at), normals(at), energies(at.size(), 0.0), slopes(at.size(), 1.0) {}
    Polyline nodes, normals;
    std::vector<double> energies, slopes;
  };
  void evaluate(Field& field);
  // Moves each node by its step and, where V is above its level, back along the gradient. False if that fails at a node.
  bool move(Field& field, const Field& from, const Polyline& steps, const std::vector<double>& levels, double longest_correction);
  bool restore(Field& field, const std::vector<double>& levels, double longest_correction);
  // Adds factor times the second derivative of V at node k times a direction to `out`, where the factor is above 0. It is the
  // difference of grad V at R_k and at R_k + u, with u along the direction and of the length `displacement`. From a loop over
  // blocks.
  void add_curvature(const Field& field, std::size_t k, std::size_t block, const AlignedArray& direction, double factor,
                     double displacement, AlignedArray& out);
  // The largest V on each segment.
  std::vector<double> segment_energies(const Field& field, std::size_t samples);

  void exchange(Archive& archive);

 private:
  struct Block {
    std::uint64_t evaluations = 0;
    AlignedArray position, gradient;
  };
  void evaluate_node(Field& field, std::size_t k, std::size_t block);
  bool restore_node(Field& field, std::size_t k, std::size_t block, double level, double longest_correction);

  // Nodes lie further apart than lists reach: where lists are kept, each node has its own, unless they took too much memory.
  SoftLandscape& landscape(std::size_t k, std::size_t block) { return *landscapes_[has_one_per_node_ ? k : block]; }

  NodeBlocks blocks_;
  bool has_one_per_node_ = false;
  std::vector<std::unique_ptr<SoftLandscape>> landscapes_;
  std::vector<Block> scratch_;
};

}  // namespace lanescape
