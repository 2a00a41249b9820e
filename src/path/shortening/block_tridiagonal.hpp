#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/aligned_array.hpp"
#include "dispatch/isa.hpp"
#include "views/panel.hpp"

namespace lanescape {

// A symmetric positive definite matrix of dense square blocks on the diagonal and sparse ones beside it, factored from both ends
// towards the middle: two threads share the work, and the bits do not depend on their number. factor() does 7/3 dimension^3
// floating-point operations per block. Only the factors of the diagonal are kept: a block beside it is written out where it is
// eliminated, in memory that stays in the cache, and solve() goes back to its terms.
class BlockTridiagonal {
 public:
  using Square = std::array<std::array<double, 3>, 3>;
  // A block beside the diagonal: a multiple of the unit matrix, one of x x^T, and squares that may lie upon each other. Rows belong
  // to one block, columns to the block after it.
  struct Coupling {
    struct Term {
      std::size_t row, column;  // where the square begins, multiples of 3
      Square square;
    };
    double unit = 0.0, factor = 0.0;
    const double* x = nullptr;  // `dimension` numbers; must outlive the factor, null without them
    std::vector<Term> terms;
  };
  // Makes a matrix block by block, each when elimination comes to it, on any thread. diagonal() adds to a block that is zero,
  // coupling() overwrites one.
  struct Source {
    std::function<void(std::size_t)> diagonal;
    std::function<void(std::size_t, Coupling&)> coupling;
  };

  // At least one block, and 3, 6, 9 ... numbers in each.
  BlockTridiagonal(const kernels::KernelTable& kernels, std::size_t blocks, std::size_t dimension, int threads);

  std::size_t blocks() const { return diagonal_.size(); }
  std::size_t dimension() const { return dimension_; }

  // For a Source. Adds x to an element of a block of the diagonal; those below the diagonal, row > column, are ignored.
  void add(std::size_t block, std::size_t row, std::size_t column, double x) {
    diagonal_[block][kernels::panel_offset(rows_, row, column)] += x;
  }
  // The same for a square that begins there, at multiples of 3.
  void add(std::size_t block, std::size_t row, std::size_t column, const Square& x) {
    add_square(diagonal_[block].data() + kernels::panel_offset(rows_, row, column), x);
  }
  // Adds factor x x^T, of `dimension` numbers x.
  void add_product(std::size_t block, double factor, const double* x);

  // Makes the matrix and overwrites it by its factor. Returns false if it is not positive definite.
  bool factor(const Source& source);
  // Overwrites `blocks` arrays of `dimension` numbers by the solution. Only after factor().
  void solve(std::vector<AlignedArray>& x) const;

 private:
  // The blocks from one end to the one before the middle, in the order of elimination.
  struct Side {
    std::size_t which, steps;
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

  static void add_square(double* to, const Square& x) {
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) to[a * kernels::panel_width + b] += x[a][b];
  }
  void make_diagonal(const Source& source, std::size_t block);
  void write_out(const Side& side, std::size_t step);
  void write_product(const Coupling& coupling, AlignedArray& out) const;
  bool factor_block(const Side& side, std::size_t step);
  void solve_panel(const Side& side, std::size_t step, std::size_t panel);
  void subtract_panel(const Side& side, std::size_t step, std::size_t panel);
  bool eliminate(const Side& side, const Source& source);
  bool eliminate_together(const Source& source);
  AlignedArray times(const Side& side, std::size_t step, const AlignedArray& x, bool transposed) const;
  void forward(const Side& side, std::vector<AlignedArray>& x, AlignedArray& middle) const;
  void backward(const Side& side, std::vector<AlignedArray>& x) const;

  const kernels::KernelTable* kernels_;
  std::size_t dimension_, rows_, panels_, middle_;
  int threads_;
  std::vector<AlignedArray> diagonal_;   // by block
  std::vector<Coupling> couplings_;      // of a block and the one after it
  std::array<AlignedArray, 2> written_;  // the block that a side eliminates, transposed on the second one
};

}  // namespace lanescape
