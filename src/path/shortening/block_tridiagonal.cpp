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
      couplings_(blocks - 1) {
  const std::size_t size = panels_ * kernels::panel_width * rows_;
  for (AlignedArray& block : diagonal_) block.assign(size, 0.0);
  for (AlignedArray& block : written_) block.assign(size, 0.0);
}

// Zero above the diagonal only, to the end of each panel.
void BlockTridiagonal::make_diagonal(const Source& source, std::size_t block) {
  for (std::size_t panel = 0; panel < panels_; ++panel) {
    const std::size_t depth = std::min(rows_, (panel + 1) * kernels::panel_width);
    std::fill_n(diagonal_[block].data() + panel * kernels::panel_width * rows_, depth * kernels::panel_width, 0.0);
  }
  for (std::size_t i = dimension_; i < rows_; ++i) add(block, i, i, 1.0);
  source.diagonal(block);
}

void BlockTridiagonal::add_product(std::size_t block, double factor, const double* x) {
  for (std::size_t first = 0; first < dimension_; first += kernels::panel_width) {
    const std::size_t width = std::min(kernels::panel_width, dimension_ - first);
    double* to = diagonal_[block].data() + kernels::panel_offset(rows_, 0, first);
    for (std::size_t row = 0; row < first + width; ++row, to += kernels::panel_width) {
      const double scaled = factor * x[row];
      for (std::size_t column = 0; column < width; ++column) to[column] += scaled * x[first + column];
    }
  }
}

// Zero where there is no product.
void BlockTridiagonal::write_product(const Coupling& coupling, AlignedArray& out) const {
  if (!coupling.x) {
    std::fill(out.begin(), out.end(), 0.0);
    return;
  }
  for (std::size_t first = 0; first < dimension_; first += kernels::panel_width) {
    const std::size_t width = std::min(kernels::panel_width, dimension_ - first);
    double* to = out.data() + kernels::panel_offset(rows_, 0, first);
    for (std::size_t row = 0; row < dimension_; ++row, to += kernels::panel_width) {
      const double scaled = coupling.factor * coupling.x[row];
      for (std::size_t column = 0; column < width; ++column) to[column] = scaled * coupling.x[first + column];
      std::fill(to + width, to + kernels::panel_width, 0.0);
    }
    std::fill(to, to + (rows_ - dimension_) * kernels::panel_width, 0.0);
  }
}

void BlockTridiagonal::write_out(const Side& side, std::size_t step) {
  const Coupling& coupling = couplings_[side.coupling(step)];
  AlignedArray& out = written_[side.which];
  write_product(coupling, out);
  for (std::size_t i = 0; i < dimension_; ++i) out[kernels::panel_offset(rows_, i, i)] += coupling.unit;
  for (const Coupling::Term& term : coupling.terms) {
    if (side.upwards) {
      add_square(out.data() + kernels::panel_offset(rows_, term.row, term.column), term.square);
      continue;
    }
    Square turned;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) turned[b][a] = term.square[a][b];
    add_square(out.data() + kernels::panel_offset(rows_, term.column, term.row), turned);
  }
}

BlockTridiagonal::Side BlockTridiagonal::side(std::size_t which) const {
  const std::size_t last = blocks() - 1;
  return which == 0 ? Side{0, middle_, true, last} : Side{1, last - middle_, false, last};
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
  kernels_->panel_solve_transposed(diagonal_[side.block(step)].data(),
                                   written_[side.which].data() + panel * kernels::panel_width * rows_, rows_);
}

void BlockTridiagonal::subtract_panel(const Side& side, std::size_t step, std::size_t panel) {
  kernels_->panel_subtract_gram(diagonal_[side.next(step)].data(), written_[side.which].data(), rows_, panel);
}

bool BlockTridiagonal::factor(const Source& source) {
  if (threads_ > 2) {
    if (!eliminate_together(source)) return false;
  } else {
    std::array<bool, 2> positive;
    for_each_side([&](std::size_t which) { positive[which] = eliminate(side(which), source); });
    if (!positive[0] || !positive[1]) return false;
    make_diagonal(source, middle_);
  }
  for_each_panel([&](std::size_t panel) {
    for (const Side& s : {side(0), side(1)})
      if (s.steps > 0) subtract_panel(s, s.steps - 1, panel);
  });
  return kernels_->panel_cholesky(diagonal_[middle_].data(), rows_);
}

// On one thread, without waiting for the other side. The middle waits for both.
bool BlockTridiagonal::eliminate(const Side& side, const Source& source) {
  for (std::size_t step = 0; step < side.steps; ++step) {
    if (step == 0) make_diagonal(source, side.block(step));
    if (!factor_block(side, step)) return false;
    source.coupling(side.coupling(step), couplings_[side.coupling(step)]);
    write_out(side, step);
    for (std::size_t panel = 0; panel < panels_; ++panel) solve_panel(side, step, panel);
    if (step + 1 == side.steps) break;
    make_diagonal(source, side.next(step));
    for (std::size_t panel = 0; panel < panels_; ++panel) subtract_panel(side, step, panel);
  }
  return true;
}

// Both sides step by step, on all threads.
bool BlockTridiagonal::eliminate_together(const Source& source) {
  for_each_block(threads_, blocks(), [&](std::size_t k) {
    make_diagonal(source, k);
    if (k < couplings_.size()) source.coupling(k, couplings_[k]);
  });
  const std::array<Side, 2> sides{side(0), side(1)};
  for (std::size_t step = 0; step < sides[0].steps; ++step) {  // the other side has as many steps or one fewer
    std::array<bool, 2> positive{true, true};
    for_each_side([&](std::size_t which) {
      if (step >= sides[which].steps) return;
      positive[which] = factor_block(sides[which], step);
      write_out(sides[which], step);
    });
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
  std::array<AlignedArray, 2> middle;
  for_each_side([&](std::size_t which) { forward(side(which), x, middle[which]); });
  AlignedArray work(panels_ * kernels::panel_width, 0.0);
  for (std::size_t q = 0; q < dimension_; ++q) {
    work[q] = x[middle_][q];
    for (const AlignedArray& part : middle)
      if (!part.empty()) work[q] -= part[q];
  }
  kernels_->panel_forward(diagonal_[middle_].data(), work.data(), rows_);
  kernels_->panel_backward(diagonal_[middle_].data(), work.data(), rows_);
  std::copy_n(work.begin(), dimension_, x[middle_].begin());
  for_each_side([&](std::size_t which) { backward(side(which), x); });
}

// The block beside the diagonal that this step eliminates, or its transpose, times x.
AlignedArray BlockTridiagonal::times(const Side& side, std::size_t step, const AlignedArray& x, bool transposed) const {
  const Coupling& coupling = couplings_[side.coupling(step)];
  AlignedArray out(panels_ * kernels::panel_width, 0.0);
  double along = 0.0;
  if (coupling.x)
    for (std::size_t q = 0; q < dimension_; ++q) along += coupling.x[q] * x[q];
  along *= coupling.factor;
  for (std::size_t q = 0; q < dimension_; ++q) out[q] = coupling.unit * x[q] + (coupling.x ? along * coupling.x[q] : 0.0);
  for (const Coupling::Term& term : coupling.terms)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) {
        if (transposed)
          out[term.column + b] += term.square[a][b] * x[term.row + a];
        else
          out[term.row + a] += term.square[a][b] * x[term.column + b];
      }
  return out;
}

// Blocks become D^-1 times what is left of them; `middle` what the one in the middle loses.
void BlockTridiagonal::forward(const Side& side, std::vector<AlignedArray>& x, AlignedArray& middle) const {
  AlignedArray work(panels_ * kernels::panel_width, 0.0);
  for (std::size_t step = 0; step < side.steps; ++step) {
    const std::size_t k = side.block(step);
    for (std::size_t q = 0; q < dimension_; ++q) work[q] = x[k][q] - (step == 0 ? 0.0 : middle[q]);
    kernels_->panel_forward(diagonal_[k].data(), work.data(), rows_);
    kernels_->panel_backward(diagonal_[k].data(), work.data(), rows_);
    std::copy_n(work.begin(), dimension_, x[k].begin());
    middle = times(side, step, work, side.upwards);
  }
}

void BlockTridiagonal::backward(const Side& side, std::vector<AlignedArray>& x) const {
  for (std::size_t step = side.steps; step-- > 0;) {
    const std::size_t k = side.block(step);
    AlignedArray work = times(side, step, x[side.next(step)], !side.upwards);
    kernels_->panel_forward(diagonal_[k].data(), work.data(), rows_);
    kernels_->panel_backward(diagonal_[k].data(), work.data(), rows_);
    for (std::size_t q = 0; q < dimension_; ++q) x[k][q] -= work[q];
  }
}

}  // namespace lanescape
