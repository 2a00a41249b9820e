#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/parallel.hpp"
#include "kernel_table.hpp"
#include "views/layout.hpp"

namespace lanescape {

// The reaches of a list with a skin.
inline std::vector<double> with_skin(std::vector<double> cutoffs, double skin) {
  for (double& cutoff : cutoffs) cutoff += skin;
  return cutoffs;
}

// The first slot of a part for HalfSkin::is_due(), a multiple of the kernels' padding.
inline std::size_t first_slot(std::size_t slots, int part, int parts) {
  return part_begin(slots / kernels::slot_padding, part, parts) * kernels::slot_padding;
}

// Decides when a list with a skin must be rebuilt: once a particle is half the skin away from where it was at the last rebuild.
// Until then two particles have approached each other by less than the skin, so no pair within the cutoff is missed.
class HalfSkin {
 public:
  HalfSkin(double skin, const kernels::KernelTable& table) : skin_(skin), table_(&table) { allow(skin); }

  double skin() const { return skin_; }
  // Two particles may approach each other by this from now on, where a box that changed uses up some of the skin.
  void allow(double approach) { allowed_ = 0.499 * approach; }  // a little less than half: displacements are rounded too
  // Before rebuilt_at() and after forget() the next rebuild is due.
  bool is_known() const { return known_; }
  void forget() { known_ = false; }
  // The positions of the last rebuild; nothing before the first.
  const AlignedArray& reference() const { return known_ ? reference_ : nowhere_; }
  AlignedArray& reference() { return known_ ? reference_ : nowhere_; }
  void rebuilt_at(const AlignedArray& positions, int threads = 1) {
    reference_.resize(positions.size());
    for_each_part(threads, [&](int part) {
      const std::size_t begin = part_begin(positions.size(), part, threads), end = part_begin(positions.size(), part + 1, threads);
      std::copy(positions.data() + begin, positions.data() + end, reference_.data() + begin);
    });
    known_ = true;
    allow(skin_);
  }

  // Whether a particle in slots [begin, end), multiples of slot_padding, has moved too far; also true for positions that are not
  // numbers, and before the first rebuild.
  bool is_due(const AlignedArray& positions, std::size_t begin, std::size_t end) const {
    if (!known_) return true;
    return !(table_->largest_displacement_squared(reference_.data(), positions.data(), positions.size() / 3, begin, end) <=
             allowed_ * allowed_);
  }
  bool is_due(const AlignedArray& positions) const { return is_due(positions, 0, positions.size() / 3); }

 private:
  double skin_, allowed_ = 0.0;  // allowed_: displacement of one particle
  const kernels::KernelTable* table_;
  bool known_ = false;
  AlignedArray reference_, nowhere_;  // memory of the first is kept
};

}  // namespace lanescape
