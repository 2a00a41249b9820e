#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "interaction/state/site_states.hpp"

namespace lanescape {

// Any function of distance and states, called for each pair: to try out a potential before it is tabulated. It runs on one thread.
class PairFunctionStates final : public StatePotential {
 public:
  struct Value {
    double energy, slope;  // u(r), u'(r)
  };
  // u(s, a, t, b, r), the same with (s, a) and (t, b) exchanged.
  using Function = std::function<Value(std::size_t s, std::size_t a, std::size_t t, std::size_t b, double r)>;
  PairFunctionStates(std::size_t species, double cutoff, Function u);

  std::vector<double> reaches() const override { return std::vector<double>(species_ * species_, cutoff_); }
  void add(Sites& sites, StateSums& sums) override;

 private:
  std::size_t species_;
  double cutoff_;
  Function u_;
};

}  // namespace lanescape
