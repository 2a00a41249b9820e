#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "interaction/state/site_states.hpp"

namespace lanescape {

// Bonded angles i-j-k whose stiffness and rest angle follow the state of the site in the middle:
// sum over angles of sum_a p_ja k_a (theta - theta_a)^2 / 2.
class BondedAngles final : public StatePotential {
 public:
  struct Angle {
    std::size_t first, middle, last;  // particles, user's order
  };
  struct Spring {
    double stiffness, rest;  // [epsilon], [rad]
  };
  BondedAngles(std::vector<Angle> angles, std::vector<Spring> of_state)
      : angles_(std::move(angles)), springs_(std::move(of_state)) {}

  double factors() const override { return 1.0; }
  void add(Sites& sites, StateSums& sums) override;

 private:
  std::vector<Angle> angles_;
  std::vector<Spring> springs_;
};

}  // namespace lanescape
