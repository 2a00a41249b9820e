#include "neighbour/cluster_list.hpp"

#include <algorithm>
#include <limits>

namespace lanescape {
namespace {

using kernels::cluster_size;
using kernels::cluster_width;

// Displacements are rounded, and so are the reaches of lists.
constexpr double half_of_a_skin = 0.499;
// Of the larger skin.
constexpr double inner_part = 0.28;

}  // namespace

ClusterList::ClusterList(const Box& box, const ParticleLayout& layout, const std::vector<double>& cutoffs, double skin,
                         const kernels::KernelTable& table, int threads)
    : table_(&table),
      slots_(layout.slots()),
      threads_(threads),
      allowed_(half_of_a_skin * inner_part * skin),
      frame_(box, skin, *std::max_element(cutoffs.begin(), cutoffs.end()), table),
      columns_(box, layout, with_skin(cutoffs, skin), threads),
      blocks_(cutoffs, skin, inner_part * skin, table) {}

double ClusterList::displacement_squared(const AlignedArray& positions) {
  std::vector<double> longest(static_cast<std::size_t>(threads_));
  for_each_part(threads_, [&](int part) {
    longest[static_cast<std::size_t>(part)] =
        pruned_at_.empty()
            ? std::numeric_limits<double>::infinity()
            : table_->largest_displacement_squared(pruned_at_.data(), positions.data(), slots_, first_slot(slots_, part, threads_),
                                                   first_slot(slots_, part + 1, threads_));
    columns_.refresh(positions, part);
  });
  return *std::max_element(longest.begin(), longest.end());
}

bool ClusterList::is_due(const AlignedArray& positions) const { return frame_.is_due(positions, 0, slots_); }

void ClusterList::update(const AlignedArray& positions) {
  if (frame_.is_empty()) return rebuild(positions);
  if (displacement_squared(positions) <= allowed_ * allowed_) return;
  if (is_due(positions)) {
    if (!frame_.any_boxes(positions)) return rebuild(positions);
    frame_.count_boxes(positions);
    columns_.shift_back(frame_.boxes());
    for_each_part(threads_, [&](int part) { columns_.refresh(positions, part); });
    if (is_due(positions)) return rebuild(positions);
  }
  pruned_at_ = positions;
  prune_ = true;
}

void ClusterList::rebuild(const AlignedArray& positions) {
  ++rebuilds_;
  frame_.forget();
  columns_.sort(positions);
  for_each_part(threads_, [&](int part) { columns_.refresh(positions, part); });
  blocks_.make(columns_, threads_);
  frame_.made_at(positions, threads_);
  pruned_at_ = positions;
  prune_ = true;
}

void ClusterList::set_box(const Box& box) {
  if (box == frame_.box()) return;
  const bool lasts = frame_.stretch_to(box);
  columns_.set_box(box);
  if (lasts) columns_.shift_back(frame_.boxes());
  pruned_at_.clear();
}

void ClusterList::put_gradients(double unit, AlignedArray& gradient) const {
  for_each_part(threads_, [&](int part) {
    std::vector<double> sums;
    const std::size_t columns = columns_.columns();
    for (std::size_t column = part_begin(columns, part, threads_); column < part_begin(columns, part + 1, threads_); ++column) {
      const std::size_t first = columns_.first_cluster(column), end = columns_.first_cluster(column + 1);
      sums.assign(cluster_width * (end - first), 0.0);
      blocks_.sum_gradients(column, first, sums.data());
      for (std::size_t cluster = first; cluster < end; ++cluster) {
        const double* sum = sums.data() + cluster_width * (cluster - first);
        for (std::size_t place = 0; place < columns_.filled(cluster); ++place)
          for (std::size_t axis = 0; axis < 3; ++axis)
            gradient[axis * slots_ + columns_.slot(cluster, place)] = unit * sum[cluster_size * axis + place];
      }
    }
  });
}

std::size_t ClusterList::memory() const {
  return columns_.memory() + blocks_.memory() + frame_.memory() + pruned_at_.capacity() * sizeof(double);
}

void ClusterList::exchange(Archive& archive) {
  AlignedArray state = frame_.state();
  archive.field("list_made_at", state);
  if (!archive.reading()) return;
  const Box present = frame_.box();
  const ListFrame::Past past = frame_.past(state, 3 * slots_);
  frame_.forget();
  if (past.made_at.empty()) return;
  set_box(past.box);
  rebuild(past.made_at);
  frame_.take_boxes(past.boxes);
  if (!past.boxes.empty()) columns_.shift_back(past.boxes);
  set_box(present);
  pruned_at_.clear();
}

}  // namespace lanescape
