#pragma once

#include <functional>
#include <vector>

#include "interaction/state/cubic_spline.hpp"
#include "interaction/state/site_states.hpp"

namespace lanescape {

// The switching function w(r), the weight of a neighbour at a distance: any smooth function with zero value and slope at the
// cutoff. A cubic spline in r^2 represents it; forces use the exact derivative of the spline.
class SwitchingFunction {
 public:
  SwitchingFunction(const std::function<double(double r)>& w, double cutoff, std::size_t intervals = default_intervals);
  // (1 - tanh((r - threshold) / width)) / 2, taken to zero between 0.8 cutoff and cutoff by a polynomial with two continuous
  // derivatives. The spline is within 1e-9 of it for a width of 0.1 and a cutoff of 2.5 or less.
  static SwitchingFunction tapered_tanh(double threshold, double width, double cutoff);

  double cutoff() const { return cutoff_; }
  double value(double r) const { return r < cutoff_ ? spline_.value(r * r) : 0.0; }
  double slope(double r) const { return r < cutoff_ ? 2.0 * r * spline_.slope(r * r) : 0.0; }
  kernels::SwitchingSpline view() const;

  static constexpr std::size_t default_intervals = 1024;

 private:
  double cutoff_;
  UniformSpline spline_;
  AlignedArray records_;
};

// rho_i = sum_j c(s_i, s_j) w_{s_i}(r_ij).
class LocalDensity final : public OrderParameter {
 public:
  // One switching function per species, or one for all; `filter`: c, species x species, of the first with the second.
  LocalDensity(std::vector<SwitchingFunction> switching, std::vector<double> filter);

  std::vector<double> reaches() const override;
  void evaluate(Sites& sites, AlignedArray& values) override;
  void add_gradient(Sites& sites, const AlignedArray& multipliers, StateSums& sums) override;

 private:
  const SwitchingFunction& of(std::size_t species) const { return switching_.size() == 1 ? switching_[0] : switching_[species]; }

  std::vector<SwitchingFunction> switching_;
  std::size_t species_;
  std::vector<double> filter_, filter_back_;  // c(s, t), and its transpose c(t, s)
};

// A cascade of tanh for each species: state 0 above the first threshold of the order parameter, else state 1 above the second, ...,
// else the last; with one threshold p_0 = (1 + tanh((x - threshold) / width)) / 2, the default form, of [UCG]. In a species with
// fewer states than others the missing ones have probability zero.
class TanhCascade final : public StateResponse {
 public:
  struct Step {
    double threshold, width;
  };
  explicit TanhCascade(std::vector<std::vector<Step>> of_species);

  std::size_t states() const override { return states_; }
  void evaluate(std::size_t species, double value, std::span<StateProbability> states) const override;

 private:
  std::vector<std::vector<Step>> steps_;
  std::size_t states_;
};

// Constant probabilities.
class FixedProbabilities final : public StateResponse {
 public:
  explicit FixedProbabilities(std::vector<std::vector<double>> of_species) : p_(std::move(of_species)) {}

  std::size_t states() const override { return p_.front().size(); }
  void evaluate(std::size_t species, double value, std::span<StateProbability> states) const override;

 private:
  std::vector<std::vector<double>> p_;
};

}  // namespace lanescape
