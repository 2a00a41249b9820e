#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "configuration/lattice.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "verification/cases.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

const kernels::KernelTable& best_table() { return kernel_table(available_isas().back()); }

// Those of particles in the user's order, and the energy of the same interaction.
struct Energies {
  std::vector<double> each;
  double sum, energy;
};

Energies evaluate(const PairModel& model, const Configuration& configuration, const PairSearchOptions& options = {}) {
  const ParticleLayout layout = ParticleLayout::in_users_order(configuration, model.species.size());
  PairInteraction interaction(model, configuration.box, layout, best_table(), options);
  const AlignedArray positions = layout.to_slots(configuration.positions);
  AlignedArray in_slots(layout.slots(), -1.0);
  interaction.energies(positions, in_slots);
  Energies result{{}, std::accumulate(in_slots.begin(), in_slots.end(), 0.0), interaction.energy(positions)};
  for (std::size_t i = 0; i < layout.size(); ++i) result.each.push_back(in_slots[layout.slot_of(i)]);
  return result;
}

void expect_reference(const PairCase& one, const PairSearchOptions& options, double tolerance) {
  const auto expected = evaluate_reference(one.model, one.configuration);
  const Energies result = evaluate(one.model, one.configuration, options);
  EXPECT_NEAR(result.sum, result.energy, 1e-13 * expected.magnitude) << one.name;
  ASSERT_EQ(result.each.size(), expected.energies.size());
  for (std::size_t i = 0; i < result.each.size(); ++i)
    EXPECT_NEAR(result.each[i], expected.energies[i], tolerance * expected.energies_magnitude[i]) << one.name << ", particle " << i;
}

// Over lists and over all pairs, every image rule and truncation, own images, boxes below a cutoff.
TEST(ParticleEnergies, AreTheReferences) {
  for (const PairCase& one : pair_cases())
    if (one.configuration.size() <= 300) expect_reference(one, {}, 1e-12);
}

TEST(ParticleEnergies, OfEveryFormAreTheReferences) {
  for (const PairForm& form : pair_forms())
    for (const PairCase& one : form_cases(form)) expect_reference(one, {}, 1e-11);
}

TEST(ParticleEnergies, InMixedPrecisionAddUpToTheEnergyInMixedPrecision) {
  const PairModel model = kob_andersen();
  expect_reference({"mixed", model, fcc_start(model, 500, 1.2, 1)}, {.precision = Precision::mixed}, 1e-5);
}

TEST(ParticleEnergies, AddUpToTheEnergyInOtherUnitsOfLength) {
  PairModel model = lennard_jones();
  Configuration configuration = fcc_start(model, 108, 0.8, 1);
  const Energies small = evaluate(model, configuration);
  model = model.in_unit(1.0 / 1024.0);
  for (double& length : configuration.box.length) length *= 1024.0;
  for (double& x : configuration.positions) x *= 1024.0;
  EXPECT_EQ(evaluate(model, configuration).each, small.each);
}

TEST(ParticleEnergies, LeaveTheOtherResultsAsTheyAre) {
  const PairModel model = kob_andersen();
  const Configuration configuration = fcc_start(model, 108, 1.2, 1);
  const ParticleLayout layout = ParticleLayout::in_users_order(configuration, 2);
  PairInteraction interaction(model, configuration.box, layout, best_table());
  const AlignedArray positions = layout.to_slots(configuration.positions);
  AlignedArray first(layout.slots()), second(layout.slots());
  const double before = interaction.energy(positions);
  interaction.energies(positions, first);
  EXPECT_EQ(interaction.energy(positions), before);
  interaction.energies(positions, second);
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace lanescape
