#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "interaction/state/cubic_spline.hpp"
#include "interaction/state/site_states.hpp"

namespace lanescape {

// Parameters for each state of each species with each of each other. u_ab of species (s, t) must be u_ba of (t, s).
struct StatePairs {
  std::size_t species, states;
  std::size_t size() const { return species * species * states * states; }
  std::size_t at(std::size_t s, std::size_t a, std::size_t t, std::size_t b) const {
    return ((s * species + t) * states + a) * states + b;
  }
};

// 4 epsilon ((sigma/r)^12 - (sigma/r)^6), less its value at the cutoff, which is the same for all states of a pair of species.
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

// Cubic splines in r through values at equal distances, the last of them 0 at the cutoff, where the slope is 0 too. Nearer than the
// first the potential goes on along a straight line.
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

// Any function of distance and states, evaluated as it is: for trying out what is then worth a table. One thread.
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

  void add(Sites& sites, StateSums& sums) override;

 private:
  std::vector<Angle> angles_;
  std::vector<Spring> springs_;
};

}  // namespace lanescape
