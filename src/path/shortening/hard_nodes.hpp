#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"
#include "interaction/sphere/segment_gaps.hpp"
#include "path/path_check.hpp"
#include "path/polyline.hpp"
#include "path/shortening/node_blocks.hpp"
#include "stepper/contact_projection.hpp"

namespace lanescape {

// The nodes of a path of hard spheres, each with the planes that keep pairs apart: displacements u with n.(u_j - u_i) >= -gap.
class HardNodes {
 public:
  struct Options {
    double reach;  // of pairs that have planes; no sphere moves by more than half of it before follow() [sigma]
    double unit;   // of length, to which tolerances are relative [sigma]
    int threads;
  };
  HardNodes(const HardSpherePath& path, std::size_t nodes, const Options& options);
  HardNodes(const HardNodes&) = delete;
  HardNodes& operator=(const HardNodes&) = delete;

  const NodeBlocks& blocks() const { return blocks_; }
  const VectorAlgebra& algebra() const { return algebra_; }
  std::uint64_t evaluations() const;  // of the closest approaches of a segment

  enum class Planes : std::uint64_t {
    // Tangent at the node itself, where a pair may come nearer by the smaller of its gaps on both segments. Nodes slide along
    // contacts without resistance; small overlaps of one iteration are removed by the next.
    of_nodes,
    // The same by the mean of both gaps, if the pair touches at both neighbours too: then all segments between them touch.
    of_nodes_evenly,
    // Tangent at the closest approach on each segment, for both its ends. Where both satisfy n.(r_j - r_i) >= s_ij, so does the
    // whole segment, since |r| >= n.r: no overlap ever appears. But nodes between two planes of one pair resist sliding.
    of_segments
  };
  Planes planes() const { return mode_; }
  void use(Planes planes) { mode_ = planes; }

  // Puts the planes where the segments of these nodes are.
  void follow(const Polyline& nodes);
  // Moves inner nodes so that their segments have no overlaps, each as little as that takes. False if that fails at a node. Planes
  // of earlier nodes are lost.
  bool restore(Polyline& nodes);

  // Replaces the displacement of node k, in kinematic coordinates, since follow() by the nearest that is allowed. False, and no
  // displacement, where none is found. A node belongs to one block.
  bool project(std::size_t k, std::size_t block, AlignedArray& displacement);
  // Replaces a field at node k by the part that no contact takes up: field - sum_c lambda_c n_c, lambda_c >= 0.
  void remove_support(std::size_t k, std::size_t block, AlignedArray& field);

  // Directions along the planes that act, as the last projection of each node found them.
  void prepare_faces();
  void keep_to_face(std::size_t k, AlignedArray& field) const;

  void exchange(Archive& archive);

 private:
  using Acting = std::pair<std::uint64_t, double>;  // the key of a plane and its multiplier
  struct Corridor {
    std::vector<PairGap> planes;  // gap: n.(r_j - r_i) - s_ij at the node
    std::vector<std::uint64_t> keys;
    std::vector<std::pair<double, double>> both;  // gaps on the segments before and behind, of planes of nodes
    std::vector<double> multipliers;
  };
  struct Block {
    Block(const HardSpherePath& path, const AlignedArray& inverse_masses, double unit);
    HardSphereOverlap spheres;
    SegmentGaps gaps;
    ContactProjection projection;
    AlignedArray from, to, field;
    std::vector<Approach> before;
    std::vector<PairGap> touching;
    std::vector<double> multipliers;
    std::uint64_t evaluations = 0;
  };
  struct Face;

  void follow_block(const Polyline& nodes, Block& block, std::size_t begin, std::size_t end);
  void add_planes(Corridor& corridor, const std::vector<Approach>& approaches, const AlignedArray& at, const Block& block,
                  std::uint64_t side) const;
  void add_node_planes(Corridor& corridor, const std::vector<Approach>& before, const std::vector<Approach>& behind,
                       const AlignedArray& at) const;
  bool acts(std::size_t k, std::uint64_t number) const;
  void share_gaps(std::size_t k);
  static std::vector<Acting> acting_planes(const Corridor& corridor);
  static void keep_multipliers(Corridor& corridor, const std::vector<Acting>& acting);
  void turn_to_end(std::vector<Approach>& approaches, const AlignedArray& end, const Block& block) const;
  double most_share(const AlignedArray& displacement) const;
  AlignedArray positions(const AlignedArray& q) const;

  Box box_;
  KinematicMetric metric_;
  Options options_;
  VectorAlgebra algebra_;
  NodeBlocks blocks_;
  Planes mode_ = Planes::of_nodes;
  AlignedArray scale_;  // sqrt(<m>/m) per coordinate
  double contact_;      // largest gap of a contact [sigma]
  std::vector<std::unique_ptr<Block>> scratch_;
  std::vector<Corridor> corridors_;  // by node
  std::vector<std::shared_ptr<Face>> faces_;
};

}  // namespace lanescape
