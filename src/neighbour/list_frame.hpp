#pragma once

#include <cstddef>

#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"
#include "kernel_table.hpp"
#include "neighbour/half_skin.hpp"

namespace lanescape {

// Where a neighbour list was made, seen from the present box and positions; decides how long the list lasts.
//
// A particle that reappears shifted by whole edges has not moved: its boxes are counted and taken out of its displacement. Along an
// open axis it has moved, and no list outlasts an axis that opens or closes.
//
// A box that changes carries the places where the list was made along, r -> r L'/L. With l and m the least and the greatest of the
// three L'/L, a pair that was not listed was at least cutoff + skin apart. It is now at least l (cutoff + skin) less the
// displacements of both from their carried places, so what is left of the skin is l (cutoff + skin) - cutoff, for the longest
// cutoff. Half of that is each particle's. Growth counts in the same way, so that listed pairs stay as near as in a box that never
// changed.
class ListFrame {
 public:
  ListFrame(const Box& box, double skin, double longest_cutoff, const kernels::KernelTable& table)
      : box_(box), longest_cutoff_(longest_cutoff), half_skin_(skin, table) {}

  // Before made_at() and after forget() there is no list.
  bool is_empty() const { return !half_skin_.is_known(); }
  void forget();
  void made_at(const AlignedArray& positions, int threads);
  const Box& box() const { return box_; }
  // Whether particles in slots [begin, end), multiples of slot_padding, have moved too far.
  bool is_due(const AlignedArray& positions, std::size_t begin, std::size_t end) const {
    return half_skin_.is_due(positions, begin, end);
  }
  // Whether particles have been shifted by boxes since the last count, and counts them.
  bool any_boxes(const AlignedArray& positions) const;
  void count_boxes(const AlignedArray& positions);
  // Boxes by which each coordinate has been shifted since the list was made.
  const AlignedArray& boxes() const { return boxes_; }
  // Takes another box; false if the list does not outlast it. The list is then forgotten.
  bool stretch_to(const Box& box);

  // Archives all that the list and its future depend on. Reading makes the list again where it was made, with the list's own
  // set_box(box), rebuild(positions) and shift_back(boxes since), in this order, and returns to the present box.
  template <class SetBox, class Rebuild, class ShiftBack>
  void exchange(Archive& archive, std::size_t dimension, SetBox set_box, Rebuild rebuild, ShiftBack shift_back) {
    AlignedArray state = this->state();
    archive.field("list_made_at", state);
    if (!archive.reading()) return;
    const Box present = box_;
    const Past past = this->past(state, dimension);
    forget();
    if (past.made_at.empty()) return;
    set_box(past.box);
    rebuild(past.made_at);
    take_boxes(past.boxes);
    if (!past.boxes.empty()) shift_back(past.boxes);
    set_box(present);
  }

  std::size_t memory() const;  // [bytes]

 private:
  // Made at, or made at, box then and boxes since.
  AlignedArray state() const;
  struct Past {
    AlignedArray made_at;
    Box box;
    AlignedArray boxes;  // empty: none
  };
  Past past(const AlignedArray& state, std::size_t dimension) const;
  void take_boxes(const AlignedArray& boxes);  // those of a past
  void keep_made_at();
  double carried(std::size_t k) const;
  void carry_all();

  Box box_, box_then_ = box_;
  double longest_cutoff_;
  HalfSkin half_skin_;    // its reference: where the list was made, carried to the present box and boxes
  AlignedArray made_at_;  // empty while that is the reference itself
  AlignedArray boxes_;    // empty while there are none
};

}  // namespace lanescape
