#include "path/shortening/block_tridiagonal.hpp"

#include <algorithm>
#include <array>

#include "core/padded.hpp"
#include "core/parallel.hpp"

namespace lanescape {

BlockTridiagonal::BlockTridiagonal(const kernels::KernelTable& kernels, std::size_t blocks, std::size_t dimension, int threads)
    : kernels_(&kernels),
      dimension_(dimension),
      rows_(padded(dimension)),
      panels_(kernels::panel_count(rows_)),
      middle_(blocks / 2),
      threads_(threads),
      diagonal_(blocks),
      coupling_(blocks - 1) {
  set_zero();
}

void BlockTridiagonal::set_zero() {
  const std::size_t size = panels_ * kernels::panel_width * rows_;
  for_each_block(threads_, blocks(), [&](std::size_t k) {
    diagonal_[k].assign(size, 0.0);
    for (std::size_t i = dimension_; i < rows_; ++i) add(k, i, i, 1.0);
    if (k < coupling_.size()) coupling_[k].assign(size, 0.0);
  });
}

void BlockTridiagonal::add_square(AlignedArray& block, double factor, const double* x) const {
  for (std::size_t panel = 0; panel < panels_; ++panel) {
    const std::size_t first = panel * kernels::panel_width, width = std::min(kernels::panel_width, dimension_ - first);
    for (std::size_t row = 0; row < dimension_; ++row) {
      double* const to = block.data() + kernels::panel_offset(rows_, row, first);
      const double scaled = factor * x[row];
      for (std::size_t column = 0; column < width; ++column) to[column] += scaled * x[first + column];
    }
  }
}

BlockTridiagonal::Side BlockTridiagonal::side(std::size_t which) const {
  const std::size_t last = blocks() - 1;
  return which == 0 ? Side{middle_, true, last} : Side{last - middle_, false, last};
}

// body(which), on a thread each if there are two.
template <class Body>
void BlockTridiagonal::for_each_side(const Body& body) const {
  for_each_block(threads_, 2, body);
}

// body(panel), on all threads.
template <class Body>
void BlockTridiagonal::for_each_panel(const Body& body) const {
  for_each_block(threads_, panels_, body);
}

// D = U^T U, W = U^-T E, and the next D loses W^T W.
bool BlockTridiagonal::factor_block(const Side& side, std::size_t step) {
  return kernels_->panel_cholesky(diagonal_[side.block(step)].data(), rows_);
}

void BlockTridiagonal::solve_panel(const Side& side, std::size_t step, std::size_t panel) {
  double* coupling = coupling_[side.coupling(step)].data();
  kernels_->panel_solve_transposed(diagonal_[side.block(step)].data(), coupling + panel * kernels::panel_width * rows_, rows_);
}

void BlockTridiagonal::subtract_panel(const Side& side, std::size_t step, std::size_t panel) {
  kernels_->panel_subtract_gram(diagonal_[side.next(step)].data(), coupling_[side.coupling(step)].data(), rows_, panel);
}

bool BlockTridiagonal::factor() {
  if (threads_ > 2) {
    if (!eliminate_together()) return false;
  } else {
    std::array<bool, 2> positive;
    for_each_side([&](std::size_t which) { positive[which] = eliminate(side(which)); });
    if (!positive[0] || !positive[1]) return false;
  }
  for_each_panel([&](std::size_t panel) {
    for (const Side& s : {side(0), side(1)})
      if (s.steps > 0) subtract_panel(s, s.steps - 1, panel);
  });
  return kernels_->panel_cholesky(diagonal_[middle_].data(), rows_);
}

// On one thread, without waiting for the other side. The middle waits for both.
bool BlockTridiagonal::eliminate(const Side& side) {
  for (std::size_t step = 0; step < side.steps; ++step) {
    if (!factor_block(side, step)) return false;
    for (std::size_t panel = 0; panel < panels_; ++panel) solve_panel(side, step, panel);
    if (step + 1 == side.steps) break;
    for (std::size_t panel = 0; panel < panels_; ++panel) subtract_panel(side, step, panel);
  }
  return true;
}

// Both sides step by step, on all threads.
bool BlockTridiagonal::eliminate_together() {
  const std::array<Side, 2> sides{side(0), side(1)};
  for (std::size_t step = 0; step < sides[0].steps; ++step) {  // the other side has as many steps or one fewer
    std::array<bool, 2> positive;
    for_each_side([&](std::size_t which) { positive[which] = step >= sides[which].steps || factor_block(sides[which], step); });
    if (!positive[0] || !positive[1]) return false;
    for_each_panel([&](std::size_t panel) {
      for (const Side& s : sides)
        if (step < s.steps) solve_panel(s, step, panel);
    });
    for_each_panel([&](std::size_t panel) {
      for (const Side& s : sides)
        if (step + 1 < s.steps) subtract_panel(s, step, panel);
    });
  }
  return true;
}

void BlockTridiagonal::solve(std::vector<AlignedArray>& x) const {
  std::vector<AlignedArray> work(blocks());
  for (std::size_t k = 0; k < blocks(); ++k) {
    work[k].assign(panels_ * kernels::panel_width, 0.0);
    std::copy_n(x[k].begin(), dimension_, work[k].begin());
  }
  for_each_side([&](std::size_t which) { forward(side(which), work); });
  solve_middle(work);
  for_each_side([&](std::size_t which) { backward(side(which), work); });
  for (std::size_t k = 0; k < blocks(); ++k) std::copy_n(work[k].begin(), dimension_, x[k].begin());
}

void BlockTridiagonal::forward(const Side& side, std::vector<AlignedArray>& x) const {
  for (std::size_t step = 0; step < side.steps; ++step) {
    const std::size_t k = side.block(step), next = side.next(step);
    kernels_->panel_forward(diagonal_[k].data(), x[k].data(), rows_);
    if (next != middle_)
      kernels_->panel_subtract_transposed_product(x[next].data(), coupling_[side.coupling(step)].data(), x[k].data(), rows_);
  }
}

void BlockTridiagonal::solve_middle(std::vector<AlignedArray>& x) const {
  double* middle = x[middle_].data();
  for (const Side& s : {side(0), side(1)})
    if (s.steps > 0)
      kernels_->panel_subtract_transposed_product(middle, coupling_[s.coupling(s.steps - 1)].data(), x[s.block(s.steps - 1)].data(),
                                                  rows_);
  kernels_->panel_forward(diagonal_[middle_].data(), middle, rows_);
  kernels_->panel_backward(diagonal_[middle_].data(), middle, rows_);
}

void BlockTridiagonal::backward(const Side& side, std::vector<AlignedArray>& x) const {
  for (std::size_t step = side.steps; step-- > 0;) {
    const std::size_t k = side.block(step);
    kernels_->panel_subtract_product(x[k].data(), coupling_[side.coupling(step)].data(), x[side.next(step)].data(), rows_);
    kernels_->panel_backward(diagonal_[k].data(), x[k].data(), rows_);
  }
}

}  // namespace lanescape
