#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "core/archive.hpp"

namespace lanescape {

// A time series of bounded size: rows every `stride` steps; when all `capacity` rows are used, every second one is dropped and the
// stride doubles. A run of 10^9 steps needs no more memory than one of 10^4.
class DecimatedTrace {
 public:
  DecimatedTrace(std::size_t columns, std::size_t capacity) : columns_(columns), capacity_(capacity) {}

  bool wants(std::uint64_t step) const { return step % stride_ == 0; }
  // A row for a step that wants() accepted, from step 1 on, or the last one of all.
  void add(std::initializer_list<double> row) {
    values_.insert(values_.end(), row);
    if (rows() < capacity_) return;
    // The even ones of rows 1, 2, 3, ... stay: multiples of the new stride.
    std::size_t kept = 0;
    for (std::size_t r = 1; r < rows(); r += 2, ++kept)
      for (std::size_t c = 0; c < columns_; ++c) values_[kept * columns_ + c] = values_[r * columns_ + c];
    values_.resize(kept * columns_);
    stride_ *= 2;
  }

  std::size_t rows() const { return values_.size() / columns_; }
  std::size_t columns() const { return columns_; }
  double at(std::size_t row, std::size_t column) const { return values_[row * columns_ + column]; }

  void exchange(Archive& archive) {
    archive.field("trace", values_);
    archive.field("trace_stride", stride_);
  }

 private:
  std::size_t columns_, capacity_;
  std::uint64_t stride_ = 1;
  std::vector<double> values_;
};

}  // namespace lanescape
