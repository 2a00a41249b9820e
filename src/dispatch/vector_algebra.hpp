#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/parallel.hpp"
#include "core/slot_work.hpp"
#include "kernel_table.hpp"

namespace lanescape {

// Algebra on whole coordinate arrays (ParticleLayout order) in a fixed order of summation: the kernels' vector operations for
// the stages that are not allowed to see the kernel table. All arrays have the same length. Long arrays are shared among threads,
// in blocks that do not depend on their number, so that the bits do not either.
class VectorAlgebra {
 public:
  explicit VectorAlgebra(const kernels::KernelTable& table, int threads = 1) : table_(&table), threads_(threads) {}

  double dot(const AlignedArray& a, const AlignedArray& b) const { return dot(a, b, 0, a.size()); }
  double norm(const AlignedArray& a) const { return std::sqrt(dot(a, a)); }
  double distance(const AlignedArray& a, const AlignedArray& b) const {
    return std::sqrt(sum_of_blocks(0, a.size(), [&](std::size_t begin, std::size_t length) {
      return table_->distance_squared(a.data() + begin, b.data() + begin, length);
    }));
  }
  // out = a - b
  void difference(AlignedArray& out, const AlignedArray& a, const AlignedArray& b) const {
    for_each_block(0, out.size(), [&](std::size_t, std::size_t begin, std::size_t length) {
      table_->difference(out.data() + begin, a.data() + begin, b.data() + begin, length);
    });
  }
  // out = x + a u
  void axpy(AlignedArray& out, const AlignedArray& x, double a, const AlignedArray& u) const {
    for_each_block(0, out.size(), [&](std::size_t, std::size_t begin, std::size_t length) {
      table_->axpy(out.data() + begin, x.data() + begin, a, u.data() + begin, length);
    });
  }
  // out = x + a u + b v
  void combine(AlignedArray& out, const AlignedArray& x, double a, const AlignedArray& u, double b, const AlignedArray& v) const {
    for_each_block(0, out.size(), [&](std::size_t, std::size_t begin, std::size_t length) {
      table_->combine(out.data() + begin, x.data() + begin, a, u.data() + begin, b, v.data() + begin, length);
    });
  }
  // The same on elements [begin, begin + length) only, whole vectors of them: out += a u, and the dot product.
  void add_scaled(AlignedArray& out, double a, const AlignedArray& u, std::size_t begin, std::size_t length) const {
    for_each_block(begin, length, [&](std::size_t, std::size_t first, std::size_t count) {
      table_->axpy(out.data() + first, out.data() + first, a, u.data() + first, count);
    });
  }
  double dot(const AlignedArray& a, const AlignedArray& b, std::size_t begin, std::size_t length) const {
    return sum_of_blocks(begin, length, [&](std::size_t first, std::size_t count) {
      return table_->dot(a.data() + first, b.data() + first, count);
    });
  }
  // Does the work in all slots, on as many threads as pay.
  void for_all_slots(std::size_t slots, const SlotWork& work) const { lanescape::for_all_slots(threads_, slots, work); }
  // Sums over particles of |to - from|^2 and |to - from|^4.
  kernels::DisplacementMoments displacement_moments(const AlignedArray& from, const AlignedArray& to) const {
    return table_->displacement_moments(from.data(), to.data(), from.size() / 3);
  }
  // Adds |to_j - from_j| to lengths[j], one per slot.
  void add_particle_lengths(AlignedArray& lengths, const AlignedArray& from, const AlignedArray& to) const {
    table_->add_particle_lengths(lengths.data(), from.data(), to.data(), lengths.size());
  }

 private:
  // A multiple of slot_padding; a hundred kilobytes, beside which the start of a thread's work is nothing.
  static constexpr std::size_t block_length = 16'384;

  // body(number of the block, its begin, its length)
  template <class Body>
  void for_each_block(std::size_t begin, std::size_t length, Body body) const {
    if (length <= block_length) return body(std::size_t{0}, begin, length);
    const std::size_t blocks = (length + block_length - 1) / block_length;
    const int parts = std::min(threads_, static_cast<int>(blocks));
    for_each_part(parts, [&](int part) {
      for (std::size_t b = part_begin(blocks, part, parts); b < part_begin(blocks, part + 1, parts); ++b)
        body(b, begin + b * block_length, std::min(block_length, length - b * block_length));
    });
  }
  // Blocks are added in order, whoever summed them.
  template <class Sum>
  double sum_of_blocks(std::size_t begin, std::size_t length, Sum sum) const {
    if (length <= block_length) return sum(begin, length);
    std::vector<double> sums((length + block_length - 1) / block_length);
    for_each_block(begin, length, [&](std::size_t b, std::size_t first, std::size_t count) { sums[b] = sum(first, count); });
    double total = 0.0;
    for (const double s : sums) total += s;
    return total;
  }

  const kernels::KernelTable* table_;
  int threads_;
};

}  // namespace lanescape
