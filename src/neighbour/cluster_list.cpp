#include "neighbour/cluster_list.hpp"

#include <algorithm>
#include <atomic>

namespace lanescape {
namespace {

using kernels::cluster_size;
using kernels::cluster_width;

// Of the larger skin.
constexpr double inner_part = 0.28;

}  // namespace

ClusterList::ClusterList(const Box& box, const ParticleLayout& layout, const std::vector<double>& cutoffs, double skin,
                         const kernels::KernelTable& table, int threads)
    : slots_(layout.slots()),
      threads_(threads),
      pruned_(inner_part * skin, table),
      frame_(box, skin, *std::max_element(cutoffs.begin(), cutoffs.end()), table),
      columns_(box, layout, with_skin(cutoffs, skin), threads),
      blocks_(cutoffs, skin, inner_part * skin, table),
      sums_(static_cast<std::size_t>(threads)) {}

bool ClusterList::must_prune(const AlignedArray& positions, const SlotWork& move) {
  // Clusters take particles of any slots: all have to be where they belong.
  if (move) for_all_slots(threads_, slots_, move);
  std::atomic<bool> must = false;
  for_each_part(threads_, [&](int part) {
    if (pruned_.is_due(positions, first_slot(slots_, part, threads_), first_slot(slots_, part + 1, threads_))) must = true;
    columns_.refresh(positions, part);
  });
  return must;
}

bool ClusterList::is_due(const AlignedArray& positions) const { return frame_.is_due(positions, 0, slots_); }

void ClusterList::update(const AlignedArray& positions, const SlotWork& move) {
  if (frame_.is_empty()) {
    if (move) for_all_slots(threads_, slots_, move);
    return rebuild(positions);
  }
  if (!must_prune(positions, move)) return;
  if (is_due(positions)) {
    if (!frame_.any_boxes(positions)) return rebuild(positions);
    frame_.count_boxes(positions);
    columns_.shift_back(frame_.boxes());
    for_each_part(threads_, [&](int part) { columns_.refresh(positions, part); });
    if (is_due(positions)) return rebuild(positions);
  }
  pruned_.rebuilt_at(positions, threads_);
  prune_ = true;
}

void ClusterList::rebuild(const AlignedArray& positions) {
  ++rebuilds_;
  frame_.forget();
  columns_.sort(positions);
  for_each_part(threads_, [&](int part) { columns_.refresh(positions, part); });
  blocks_.make(columns_, threads_);
  frame_.made_at(positions, threads_);
  pruned_.rebuilt_at(positions, threads_);
  prune_ = true;
}

void ClusterList::set_box(const Box& box) {
  if (box == frame_.box()) return;
  const bool lasts = frame_.stretch_to(box);
  columns_.set_box(box);
  if (lasts) columns_.shift_back(frame_.boxes());
  pruned_.forget();
}

void ClusterList::put_gradients(double unit, AlignedArray& gradient) {
  for_each_part(threads_, [&](int part) {
    std::vector<double>& sums = sums_[static_cast<std::size_t>(part)];
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
  return columns_.memory() + blocks_.memory() + frame_.memory() + pruned_.reference().capacity() * sizeof(double);
}

void ClusterList::exchange(Archive& archive) {
  frame_.exchange(
      archive, 3 * slots_, [&](const Box& box) { set_box(box); }, [&](const AlignedArray& positions) { rebuild(positions); },
      [&](const AlignedArray& boxes) { columns_.shift_back(boxes); });
  if (archive.reading()) pruned_.forget();
}

}  // namespace lanescape
