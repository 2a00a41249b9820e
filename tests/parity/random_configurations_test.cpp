// Random models and configurations on every instruction set against the scalar reference (support/random_run.hpp: how many). A
// failure names the number from which the configuration follows.

#include "random_configurations.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "configuration/particle_layout.hpp"
#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "pair_comparison.hpp"
#include "random_run.hpp"

namespace lanescape {
namespace {

using testing::Comparable;
using testing::Outcome;

// The numbers of the library, and whether energies with and without forces have the same bits.
std::pair<testing::PairNumbersFound, bool> evaluate(const testing::RandomConfiguration& made, Isa isa) {
  const ParticleLayout layout = ParticleLayout::in_space_order(made.configuration, made.model.species.size());
  PairInteraction interaction(made.model, made.configuration.box, layout, kernel_table(isa), made.options);
  const AlignedArray positions = layout.to_slots(made.configuration.positions);
  AlignedArray gradient(layout.dimension()), unused(layout.dimension());
  const double energy = interaction.energy(positions);
  const auto sums = interaction.energy_and_gradient(positions, gradient);
  const auto tensor = interaction.energy_and_stress(positions, unused).virial_tensor;
  return {{energy, sums.virial, layout.to_user(gradient), {tensor.begin(), tensor.end()}}, same_bits(energy, sums.energy)};
}

Outcome check(std::uint64_t number, Isa isa, const testing::RandomConfiguration& made, const reference::Evaluation& expected,
              Comparable what) {
  try {
    const auto [found, bits] = evaluate(made, isa);
    if (what == Comparable::nothing) return Outcome::undecided;
    const auto worst = testing::deviations(found, expected), allowed = testing::tolerances(made);
    if (bits && testing::within(worst, allowed, what)) return what == Comparable::all ? Outcome::right : Outcome::undecided;
    ADD_FAILURE() << fmt::format("configuration {} on {}: {}: energy {} (expected {}){}, {}", number, to_string(isa),
                                 testing::describe(made), found.energy, expected.energy, bits ? "" : ", another with forces",
                                 testing::describe(worst, allowed));
    return Outcome::wrong;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input) << "configuration " << number << ": " << error.what();
    return Outcome::refused;
  }
}

TEST(RandomConfigurations, AgreeWithTheReferenceOrAreRefused) {
  testing::RandomRun(6.5).for_each("configurations", [](std::uint64_t number, auto add) {
    const testing::RandomConfiguration made = testing::RandomConfigurations(number).make();
    const testing::DecidedByRounding rounding(made);
    const reference::Evaluation expected = testing::expected_of(made, rounding);
    const Comparable what = rounding.comparable(made.model);
    for (const Isa isa : available_isas()) add(check(number, isa, made, expected, what));
  });
}

}  // namespace
}  // namespace lanescape
