#pragma once

#include <vector>

#include "interaction/state/site_states.hpp"
#include "interaction/state/state_pairs.hpp"

namespace lanescape {

// 4 epsilon ((sigma/r)^12 - (sigma/r)^6), less its value at the cutoff. All states of a pair of species have the same cutoff.
class LennardJonesStates final : public StatePotential {
 public:
  struct Pair {
    double epsilon = 0.0, sigma = 1.0;  // epsilon 0: these states do not interact this way
  };
  // `pairs` as StatePairs orders them; `cutoffs`: species x species [sigma].
  LennardJonesStates(StatePairs order, const std::vector<Pair>& pairs, std::vector<double> cutoffs);

  std::vector<double> reaches() const override { return cutoffs_; }
  void add(Sites& sites, StateSums& sums) override;

 private:
  StatePairs order_;
  std::vector<double> cutoffs_, cutoffs_squared_;
  std::vector<kernels::StateLjPair> pairs_;
};

}  // namespace lanescape
