// A user's own state-dependent potential: Gaussian cores whose height depends on the two states. It computes energy, gradient and
// virial at fixed probabilities, and dU/dp. It does not depend on how the probabilities are computed: any method works, here the
// library's local densities.

#include <cmath>
#include <memory>

#include "state_check.hpp"

namespace {

using namespace lanescape;

class GaussianCores final : public StatePotential {
 public:
  explicit GaussianCores(std::vector<double> heights) : heights_(std::move(heights)) {}  // of each state [epsilon]

  std::vector<double> reaches() const override { return {reach}; }  // one species

  void add(Sites& sites, StateSums& sums) override {
    const std::size_t states = sites.states(), slots = sites.layout().slots();
    sites.for_each_pair([&](std::size_t i, std::size_t j, const std::array<double, 3>& d) {
      const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      if (r2 >= reach * reach) return;
      const double core = std::exp(-r2), energy = core - std::exp(-reach * reach);
      const auto p_i = sites.site_states().of(i), p_j = sites.site_states().of(j);
      double weight = 0.0;
      for (std::size_t a = 0; a < states; ++a)
        for (std::size_t b = 0; b < states; ++b) {
          const double height = std::sqrt(heights_[a] * heights_[b]);
          weight += p_i[a] * p_j[b] * height;
          sums.slopes[i * states + a] += p_j[b] * height * energy;  // dU/dp_ia, in full: i gets it from each of its pairs
        }
      sums.energy += 0.5 * weight * energy;  // every pair is visited from both ends
      for (std::size_t axis = 0; axis < 3; ++axis) sums.gradient[axis * slots + i] -= 2.0 * weight * core * d[axis];
      sums.add_virial(2.0 * weight * core, d, 0.5);
    });
  }

 private:
  static constexpr double reach = 4.5;  // where the slope is negligible
  std::vector<double> heights_;
};

// The library's densities with three states, and this potential alone.
StateMixtureParts parts() {
  StateMixtureParts parts = make_parts(state_mixture_model({1, 3}));
  parts.potentials.clear();
  parts.potentials.push_back(std::make_unique<GaussianCores>(std::vector<double>{4.0, 2.5, 1.0}));
  return parts;
}

}  // namespace

int main() {
  Configuration fluid = state_mixture_fluid(64, 1);
  fluid.wrap();
  const auto right = snippets::check_forces(parts, fluid, 1);
  return right.worst_force < 1e-6 && right.virial < 1e-6 ? 0 : 1;
}
