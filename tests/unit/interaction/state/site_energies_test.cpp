#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

#include "dispatch/isa.hpp"
#include "interaction/state/bonded_angles.hpp"
#include "interaction/state/local_density.hpp"
#include "interaction/state/state_mixture.hpp"
#include "verification/state_mixture_cases.hpp"

namespace lanescape {
namespace {

using Filter = StateMixtureVariant::Filter;
using Potentials = StateMixtureVariant::Potentials;

const kernels::KernelTable& table() { return kernel_table(available_isas().back()); }

// Half of each pair of site i by the formula, at probabilities from an evaluation.
double half_of_pairs(const StateMixtureModel& model, const Configuration& c, std::size_t i, const std::vector<double>& p) {
  const std::size_t states = model.most_states();
  double energy = 0.0;
  for (std::size_t j = 0; j < c.size(); ++j)
    for (int image = 0; image < 125; ++image) {
      const std::array<int, 3> cell{image / 25 - 2, image / 5 % 5 - 2, image % 5 - 2};
      double r2 = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double d = c.box.nearest_image(k, c.positions[3 * i + k] - c.positions[3 * j + k]) + cell[k] * c.box.length[k];
        r2 += d * d;
      }
      if (r2 == 0.0 || r2 >= model.cutoff * model.cutoff) continue;
      const auto s = static_cast<std::size_t>(c.species[i]), t = static_cast<std::size_t>(c.species[j]);
      for (std::size_t a = 0; a < model.states_of(s); ++a)
        for (std::size_t b = 0; b < model.states_of(t); ++b) {
          const auto lj = std::get<StateMixtureModel::LennardJones>(model.potentials[model.potential_at(s, a, t, b)]);
          const auto u = [&lj = lj](double squared) {
            const double s6 = std::pow(lj.sigma * lj.sigma / squared, 3);
            return 4.0 * lj.epsilon * s6 * (s6 - 1.0);
          };
          energy += 0.5 * p[i * states + a] * p[j * states + b] * (u(r2) - u(model.cutoff * model.cutoff));
        }
    }
  return energy;
}

TEST(SiteEnergies, ShareTheEnergyOfAMixture) {
  for (const StateMixtureVariant& variant : {StateMixtureVariant{2, 3, Filter::every, Potentials::lennard_jones, 0.4},
                                             StateMixtureVariant{1, 2, Filter::every, Potentials::lennard_jones, 0.0, true},
                                             StateMixtureVariant{1, 1, Filter::every, Potentials::lennard_jones, 0.3}}) {
    const StateMixtureModel model = state_mixture_model(variant);
    const Configuration fluid = state_mixture_fluid(27, variant.species);  // the box is hardly wider than a cutoff
    const ParticleLayout layout(fluid.species, variant.species);
    StateMixture interaction(model, fluid.box, layout, table(), {});
    AlignedArray energies(layout.slots(), -1.0);
    const double energy = interaction.energy(layout.to_slots(fluid.positions));
    interaction.energies(layout.to_slots(fluid.positions), energies);
    const double sum = std::accumulate(energies.begin(), energies.end(), 0.0);
    EXPECT_NEAR(sum, energy, 1e-12 * std::fabs(energy)) << describe(variant);
    std::vector<double> p;
    for (std::size_t i = 0; i < fluid.size(); ++i)
      for (const double of_state : interaction.states().of(layout.slot_of(i))) p.push_back(of_state);
    for (std::size_t i = 0; i < fluid.size(); ++i) {
      double expected = half_of_pairs(model, fluid, i, p);
      const auto s = static_cast<std::size_t>(fluid.species[i]);
      for (std::size_t a = 0; a < model.states_of(s); ++a) {
        const double of_state = p[i * variant.states + a];
        expected += model.states[s].mu[a] * of_state;
        if (of_state > 0.0) expected += variant.entropy_temperature * of_state * std::log(of_state);
      }
      EXPECT_NEAR(energies[layout.slot_of(i)], expected, 1e-11) << describe(variant) << ", site " << i;
    }
  }
}

TEST(SiteEnergies, GiveAnAngleToTheSiteInItsMiddle) {
  const Configuration three{{{20.0, 20.0, 20.0}}, {0, 0, 0}, {1.0, 1.0, 1.0, 2.0, 1.0, 1.0, 2.0, 2.0, 1.0}};
  StateMixtureParts parts;
  parts.response = std::make_unique<FixedProbabilities>(std::vector<std::vector<double>>{{0.25, 0.75}});
  parts.potentials.push_back(std::make_unique<BondedAngles>(std::vector<BondedAngles::Angle>{{0, 1, 2}},
                                                            std::vector<BondedAngles::Spring>{{8.0, 1.5}, {4.0, 1.0}}));
  const ParticleLayout layout(three.species, 1);
  StateMixture interaction(std::move(parts), three.box, layout, table(), {});
  AlignedArray energies(layout.slots());
  interaction.energies(layout.to_slots(three.positions), energies);
  EXPECT_EQ(energies[0], 0.0);
  EXPECT_GT(energies[1], 0.1);
  EXPECT_NEAR(energies[1], interaction.energy(layout.to_slots(three.positions)), 1e-14);
  EXPECT_EQ(energies[2], 0.0);
}

}  // namespace
}  // namespace lanescape
