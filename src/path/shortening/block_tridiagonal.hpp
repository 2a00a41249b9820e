#pragma once

#include <cstddef>
#include <vector>

#include "core/aligned_array.hpp"
#include "dispatch/isa.hpp"
#include "views/panel.hpp"

namespace lanescape {

// A symmetric positive definite matrix of dense square blocks on and beside the diagonal, factored from both ends towards the
// middle: two threads share the work, and the bits do not depend on their number. factor() does 7/3 dimension^3 floating-point
// operations per block.
class BlockTridiagonal {
 public:
  // At least one block and one number in each.
  BlockTridiagonal(const kernels::KernelTable& kernels, std::size_t blocks, std::size_t dimension, int threads);

  std::size_t blocks() const { return diagonal_.size(); }
  std::size_t dimension() const { return dimension_; }

  void set_zero();
  // Adds x to an element of a block of the diagonal; those below the diagonal, row > column, are ignored. Threads may add to
  // different blocks at the same time.
  void add(std::size_t block, std::size_t row, std::size_t column, double x) {
    diagonal_[block][kernels::panel_offset(rows_, row, column)] += x;
  }
  // The same beside the diagonal: the row belongs to `block`, the column to the block after it.
  void add_coupling(std::size_t block, std::size_t row, std::size_t column, double x) {
    coupling_[block][block < middle_ ? kernels::panel_offset(rows_, row, column) : kernels::panel_offset(rows_, column, row)] += x;
  }
  // Adds factor x x^T, of `dimension` numbers x, to all of a block.
  void add_square(std::size_t block, double factor, const double* x) { add_square(diagonal_[block], factor, x); }
  void add_coupling_square(std::size_t block, double factor, const double* x) { add_square(coupling_[block], factor, x); }

  // Overwrites the matrix by its factor. Returns false, with the matrix spoilt, if it is not positive definite; set_zero() begins
  // anew.
  bool factor();
  // Overwrites `blocks` arrays of `dimension` numbers by the solution. Only after factor().
  void solve(std::vector<AlignedArray>& x) const;

 private:
  // The blocks from one end to the one before the middle, in the order of elimination.
  struct Side {
    std::size_t steps;
    bool upwards;
    std::size_t last;
    std::size_t block(std::size_t step) const { return upwards ? step : last - step; }
    std::size_t next(std::size_t step) const { return upwards ? step + 1 : last - step - 1; }
    std::size_t coupling(std::size_t step) const { return upwards ? step : last - step - 1; }  // of a block and the next
  };
  Side side(std::size_t which) const;
  template <class Body>
  void for_each_side(const Body& body) const;
  template <class Body>
  void for_each_panel(const Body& body) const;

  void add_square(AlignedArray& block, double factor, const double* x) const;
  bool factor_block(const Side& side, std::size_t step);
  void solve_panel(const Side& side, std::size_t step, std::size_t panel);
  void subtract_panel(const Side& side, std::size_t step, std::size_t panel);
  bool eliminate(const Side& side);
  bool eliminate_together();
  void forward(const Side& side, std::vector<AlignedArray>& x) const;
  void backward(const Side& side, std::vector<AlignedArray>& x) const;
  void solve_middle(std::vector<AlignedArray>& x) const;

  const kernels::KernelTable* kernels_;
  std::size_t dimension_, rows_, panels_, middle_;
  int threads_;
  std::vector<AlignedArray> diagonal_;  // by block
  std::vector<AlignedArray> coupling_;  // of a block and the one after it, towards the middle: transposed from there on
};

}  // namespace lanescape
