#include "neighbour/list_frame.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {
namespace {

// Further away a new list is made, which knows how far away particles may be.
constexpr double most_boxes = 1e6;

}  // namespace

void ListFrame::forget() {
  half_skin_.forget();
  made_at_.clear();
  boxes_.clear();
  box_then_ = box_;
}

void ListFrame::made_at(const AlignedArray& positions, int threads) {
  forget();
  half_skin_.rebuilt_at(positions, threads);
}

double ListFrame::carried(std::size_t k) const {
  const std::size_t axis = k / (made_at_.size() / 3);
  const double place = made_at_[k] * (box_.length[axis] / box_then_.length[axis]);
  return boxes_.empty() ? place : place + boxes_[k] * box_.length[axis];
}

void ListFrame::carry_all() {
  for (std::size_t k = 0; k < made_at_.size(); ++k) half_skin_.reference()[k] = carried(k);
}

void ListFrame::keep_made_at() {
  if (made_at_.empty()) made_at_ = half_skin_.reference();
}

bool ListFrame::any_boxes(const AlignedArray& positions) const {
  const AlignedArray& reference = half_skin_.reference();
  const std::size_t slots = reference.size() / 3;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!box_.periodic[axis]) continue;
    for (std::size_t k = axis * slots; k < (axis + 1) * slots; ++k)
      if (std::fabs(positions[k] - reference[k]) > 0.5 * box_.length[axis]) return true;
  }
  return false;
}

void ListFrame::count_boxes(const AlignedArray& positions) {
  keep_made_at();
  if (boxes_.empty()) boxes_.resize(made_at_.size(), 0.0);
  AlignedArray& reference = half_skin_.reference();
  const std::size_t slots = reference.size() / 3;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!box_.periodic[axis]) continue;
    for (std::size_t k = axis * slots; k < (axis + 1) * slots; ++k) {
      const double moved = positions[k] - reference[k];
      if (!(std::fabs(moved) > 0.5 * box_.length[axis])) continue;
      const double boxes = boxes_[k] + std::nearbyint(moved / box_.length[axis]);
      if (!(std::fabs(boxes) <= most_boxes)) continue;  // nor for what is not a number: the particle has moved too far
      boxes_[k] = boxes;
      reference[k] = carried(k);
    }
  }
}

bool ListFrame::stretch_to(const Box& box) {
  const bool same_axes = box.periodic == box_.periodic;
  box_ = box;
  if (!same_axes) forget();
  if (is_empty()) return false;
  double least = 1.0, greatest = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double stretch = box.length[axis] / box_then_.length[axis];
    least = std::min(least, stretch);
    greatest = std::max(greatest, stretch);
  }
  const double skin = half_skin_.skin(), reach = longest_cutoff_ + skin;
  const double left = skin - std::max(1.0 - least, greatest - 1.0) * reach;
  if (!(left > 0.0)) {
    forget();
    return false;
  }
  keep_made_at();
  carry_all();
  half_skin_.allow(left);
  return true;
}

AlignedArray ListFrame::state() const {
  if (made_at_.empty()) return half_skin_.reference();
  AlignedArray state = made_at_;
  state.insert(state.end(), box_then_.length.begin(), box_then_.length.end());
  state.insert(state.end(), boxes_.begin(), boxes_.end());
  return state;
}

ListFrame::Past ListFrame::past(const AlignedArray& state, std::size_t dimension) const {
  const auto at = [&](std::size_t k) { return state.begin() + static_cast<std::ptrdiff_t>(k); };
  Past past{AlignedArray(state.begin(), at(std::min(dimension, state.size()))), box_, {}};
  if (state.size() <= dimension) return past;
  std::copy(at(dimension), at(dimension + 3), past.box.length.begin());
  past.boxes.assign(at(dimension + 3), state.end());
  return past;
}

void ListFrame::take_boxes(const AlignedArray& boxes) {
  if (boxes.empty()) return;
  keep_made_at();
  boxes_ = boxes;
  carry_all();
}

std::size_t ListFrame::memory() const {
  return (half_skin_.reference().capacity() + made_at_.capacity() + boxes_.capacity()) * sizeof(double);
}

}  // namespace lanescape
