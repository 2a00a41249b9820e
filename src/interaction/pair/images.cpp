#include "interaction/pair/images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"

namespace lanescape {

using kernels::ImageSearch;

double image_shells(double length, double cutoff) { return std::ceil(cutoff / length - 0.5); }

ImageSearch image_search(const Box& box, double cutoff, ImageRule rule) {
  if (rule == ImageRule::minimum || 2.0 * cutoff <= box.shortest()) return ImageSearch::nearest;
  double least_edge_diagonal = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 3; ++a) {
    const double la = box.length[static_cast<std::size_t>(a)], lb = box.length[static_cast<std::size_t>((a + 1) % 3)];
    least_edge_diagonal = std::min(least_edge_diagonal, la * la + lb * lb);
  }
  const bool one_more_at_most = cutoff <= box.shortest() && 4.0 * cutoff * cutoff <= least_edge_diagonal;
  return one_more_at_most ? ImageSearch::two_nearest : ImageSearch::lattice;
}

void check_reach(const Box& box, double cutoff) {
  check_edges(box.length);
  if (image_shells(box.shortest(), cutoff) > max_image_shells)
    throw_bad_input(
        fmt::format("cutoff {} reaches over more than {} images of the box, whose shortest edge is {}: at most {} is allowed",
                    cutoff, max_image_shells, box.shortest(), (max_image_shells + 0.5) * box.shortest()));
}

void check_cutoff(const PairModel& model, const Box& box, double scale) {
  check_reach(box, model.images == ImageRule::minimum ? 0.0 : scale * model.largest_cutoff());
  if (model.truncation == Truncation::tail) check_periodic(box, "long-range corrections (truncation tail)");
}

}  // namespace lanescape
