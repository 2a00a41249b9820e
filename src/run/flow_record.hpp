#pragma once

#include <vector>

#include "core/archive.hpp"
#include "flow/open_slab.hpp"

namespace lanescape {

struct FlowResult;

// The rows and insertions of a flow, as numbers for checkpoints.
class FlowRecord {
 public:
  // Those of the slab's last interval between calls of its outside, which ended at `time`.
  void add_insertions(const OpenSlab& slab, double time);
  // Closes a row: takes the means since the last one.
  void add_row(OpenSlab& slab, const Outside& outside, double time);
  void put_into(FlowResult& result) const;
  void exchange(Archive& archive);

 private:
  std::vector<double> x_;           // of the slices
  std::vector<double> rows_;        // numbers per row, then per slice
  std::vector<double> outside_;     // numbers per row that begins with their count
  std::vector<double> insertions_;  // face and the numbers of each
};

// Means of density, velocity and temperature over the slices from `low` to `high`, from rows after `from`.
void put_means(FlowResult& result, double from, double low, double high);

}  // namespace lanescape
