#pragma once

#include <cstddef>
#include <vector>

#include "interaction/state/site_states.hpp"
#include "interaction/state/state_pairs.hpp"

namespace lanescape {

// Cubic splines in r through values at equal distances, the last of them 0 at the cutoff, where the slope is 0 too. Below the
// first value the potential continues as a straight line.
class TabulatedStates final : public StatePotential {
 public:
  struct Table {
    double first = 0.0, spacing = 1.0;  // distances of the values [sigma]
    std::vector<double> values;         // [epsilon]; none: these states do not interact this way
  };
  // As StatePairs orders them; those of one pair of species have the same distances.
  TabulatedStates(StatePairs order, const std::vector<Table>& tables);

  std::vector<double> reaches() const override { return cutoffs_; }
  void add(Sites& sites, StateSums& sums) override;

 private:
  void join(std::size_t species_pair, const std::vector<Table>& tables);

  StatePairs order_;
  std::vector<double> cutoffs_;
  std::vector<AlignedArray> records_;  // of each species pair
  std::vector<kernels::StateTable> tables_;
};

}  // namespace lanescape
