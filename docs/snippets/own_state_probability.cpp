// A user's own state probability: the probability of a site's first state depends on the order of its surroundings, here on the
// number of neighbours in a shell from 1.2 to 1.6 sigma. It works with any potential, without changes to the potential.

#include <cmath>
#include <memory>

#include "interaction/state/state_potentials.hpp"
#include "state_check.hpp"

namespace {

using namespace lanescape;

// The order parameter: one number per site, and how a derivative with respect to it becomes a gradient.
class ShellNumber final : public OrderParameter {
 public:
  std::vector<double> reaches() const override { return {reach}; }  // one species

  void evaluate(Sites& sites, AlignedArray& values) override {
    std::fill(values.begin(), values.end(), 0.0);
    sites.for_each_pair(
        [&](std::size_t i, std::size_t, const std::array<double, 3>& d) { values[i] += bell(std::hypot(d[0], d[1], d[2])).value; });
  }

  void add_gradient(Sites& sites, const AlignedArray& multipliers, StateSums& sums) override {
    const std::size_t slots = sites.layout().slots();
    sites.for_each_pair([&](std::size_t i, std::size_t j, const std::array<double, 3>& d) {
      const double r = std::hypot(d[0], d[1], d[2]);
      // Moving site i relative to j changes the sums of both.
      const double slope = (multipliers[i] + multipliers[j]) * bell(r).slope;
      for (std::size_t axis = 0; axis < 3; ++axis) sums.gradient[axis * slots + i] += slope / r * d[axis];
      sums.add_virial(-slope / r, d, 0.5);  // each pair is visited twice
    });
  }

 private:
  static constexpr double middle = 1.4, half_width = 0.2, reach = middle + half_width;
  struct Bell {
    double value, slope;
  };
  // (1 - x^2)^3 within the shell: smooth at its ends.
  static Bell bell(double r) {
    const double x = (r - middle) / half_width, inside = 1.0 - x * x;
    if (inside <= 0.0) return {0.0, 0.0};
    return {inside * inside * inside, -6.0 * x * inside * inside / half_width};
  }
};

// The response: the probabilities are a logistic function of the order parameter.
class Logistic final : public StateResponse {
 public:
  std::size_t states() const override { return 2; }
  void evaluate(std::size_t, double value, std::span<StateProbability> states) const override {
    const double x = value - 2.0, p = 1.0 / (1.0 + std::exp(-x)), q = 1.0 / (1.0 + std::exp(x)), slope = p * q;
    states[0] = {p, slope, -std::log1p(std::exp(-x))};
    states[1] = {q, -slope, -std::log1p(std::exp(x))};
  }
};

StateMixtureParts parts() {
  StateMixtureParts parts;
  parts.order_parameter = std::make_unique<ShellNumber>();
  parts.response = std::make_unique<Logistic>();
  // Tables of the library, unchanged.
  parts.potentials =
      make_parts(state_mixture_model({1, 2, StateMixtureVariant::Filter::every, StateMixtureVariant::Potentials::tables}))
          .potentials;
  parts.one_body = {{0.0, 0.4}, 0.8};
  return parts;
}

}  // namespace

int main() {
  Configuration fluid = state_mixture_fluid(64, 1);
  fluid.wrap();
  const auto right = snippets::check_forces(parts, fluid, 1);
  // At the knots of the tables the third derivative jumps, which limits the accuracy of differences.
  return right.worst_force < 1e-6 && right.virial < 1e-6 ? 0 : 1;
}
