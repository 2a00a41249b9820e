#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/aligned_array.hpp"
#include "path/shortening/block_tridiagonal.hpp"
#include "path/shortening/gap_constraints.hpp"

namespace lanescape {

// Minimises the energy of a string with tensions, half the sum of w_k |R_{k+1} + y_{k+1} - R_k - y_k|^2, over moves y of its inner
// nodes that close none of the gaps, as these are linearised: a primal-dual interior-point method with Mehrotra's predictor and
// corrector (Nocedal and Wright, Numerical Optimization, 2nd ed., section 16.6). Each step factors a block-tridiagonal matrix.
class InteriorPoint {
 public:
  struct String {
    const std::vector<AlignedArray>& gradient;  // of the energy at y = 0, of each inner node
    const std::vector<double>& tensions;        // of each segment
    const std::vector<AlignedArray>& tangents;  // unit vectors along the segments
    double softness;                            // share of its stiffness along the segments that the string lacks
    double damping;                             // half of it times |y|^2 is added to the energy
    double bulge;                               // share of the gaps' second derivative across that is taken into account
  };
  struct Goal {
    double barrier;    // mean product of slacks and multipliers
    double violation;  // of a gap [sigma]
    double force;      // length of the part of the gradient at a node that no gap accounts for
    int most_steps;
  };

  // For paths of this many nodes, ends included.
  InteriorPoint(const kernels::KernelTable& kernels, std::size_t nodes, std::size_t dimension, int threads);

  // Moves slacks and multipliers along. The bulge is left out from where it makes the energy have no minimum. Ends early where
  // rounding leaves the matrix not positive definite.
  void solve(const String& string, SegmentGapConstraints& segments, const Goal& goal);
  // y of each inner node.
  const std::vector<AlignedArray>& moves() const { return moves_; }

 private:
  using Segments = SegmentGapConstraints;
  struct Lengths {
    double primal = 1.0, dual = 1.0;
  };

  const double* node(const std::vector<AlignedArray>& field, std::size_t k) const;
  template <class Body>
  void for_each_inner(const Body& body) const;
  template <class Body>
  void for_each_segment(Segments& segments, const Body& body) const;
  // What the whole path leaves to do: the mean product of slacks and multipliers, and how much gaps miss their slacks at most.
  struct State {
    double product, violation;
  };
  State survey(const String& string, Segments& segments);
  State total(const Segments& segments) const;
  double complementarity(Segments& segments, const Lengths& lengths);
  void soften(const String& string, std::size_t segment);
  void clear_pulls(std::size_t segment);
  void add_pulls(std::size_t node, AlignedArray& out) const;
  double largest_rest() const;
  template <class Add>
  void second_derivatives(const GapConstraint& gap, std::size_t row, std::size_t column, const Add& add) const;
  void add_diagonal(const String& string, const Segments& segments, std::size_t node);
  void set_coupling(const String& string, const Segments& segments, std::size_t segment, BlockTridiagonal::Coupling& out) const;
  bool factor(const String& string, const Segments& segments);
  Lengths find_step(Segments& segments, double target, bool corrected);
  Lengths allowed(Segments& segments);
  void take_step(Segments& segments, const Lengths& lengths);

  std::size_t inner_, dimension_;
  int threads_;
  double bulge_ = 0.0;
  BlockTridiagonal matrix_;
  std::vector<AlignedArray> moves_, rest_, step_;
  std::array<std::vector<AlignedArray>, 2> pulls_;  // of each segment on the node before and behind it
  std::vector<State> of_segment_;                   // partial results, added in one order
};

}  // namespace lanescape
