// Random models and configurations on every instruction set against the scalar reference: 10,000, or as many as 20 seconds allow;
// without that limit by
//   LANESCAPE_RANDOM_CONFIGURATIONS=100000 parity_random_configurations_test
// A failure names the number from which the configuration follows.

#include "random_configurations.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <optional>

#include "configuration/particle_layout.hpp"
#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "verification/check.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

struct Tolerances {
  double energy, virial, gradient;
};

// What the rounding of coordinates adds: four roundings of 2^-53 of the largest coordinate or edge, relative to the least distance
// of 0.7 units, and amplified thirteen times by r^-13. In mixed precision with individual diameters a virial of few pairs is as far
// off as their forces.
Tolerances tolerances(const testing::RandomConfiguration& made) {
  double largest = made.box_in_units;
  for (const double x : made.configuration.positions) largest = std::max(largest, std::abs(x) / made.unit);
  const double rounding = 4.0 * 13.0 * 0x1p-53 * largest / 0.7;
  if (made.options.precision == Precision::double_precision)
    return {tolerance::pair_sums + rounding, tolerance::pair_sums + rounding, tolerance::pair_gradient + rounding};
  if (made.model.form->has_diameters)
    return {tolerance::mixed_sums + rounding, tolerance::mixed_diameters_gradient + rounding,
            tolerance::mixed_diameters_gradient + rounding};
  return {tolerance::mixed_sums + rounding, tolerance::mixed_sums + rounding, tolerance::mixed_gradient + rounding};
}

PairModel with_cutoff(PairModel model, double factor) {
  model.cutoff *= factor;
  return model;
}

// Whether rounding decides if a pair counts: at the cutoff, or as far from its image as from itself.
bool depends_on_rounding(const testing::RandomConfiguration& made) {
  const double width =
      std::max(made.options.precision == Precision::mixed ? tolerance::mixed_cutoff : 1e-14, 1e-15 * made.box_in_units);
  if (made.model.images == ImageRule::minimum)
    for (std::size_t i = 0; i < made.configuration.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (!made.configuration.box.periodic[axis]) continue;
          const double length = made.configuration.box.length[axis];
          const double d = made.configuration.positions[3 * i + axis] - made.configuration.positions[3 * j + axis];
          if (std::abs(std::abs(std::remainder(d, length)) - 0.5 * length) < 1e-9 * length) return true;
        }
  if (std::isfinite(made.model.form->range)) return false;  // these end with value and slope zero
  PairModel plain = made.model;
  plain.truncation = Truncation::plain;
  const double nearer = evaluate_reference(with_cutoff(plain, 1.0 - width), made.configuration).energy;
  const double further = evaluate_reference(with_cutoff(plain, 1.0 + width), made.configuration).energy;
  return nearer != further;
}

enum class Outcome { right, refused, undecided };

Outcome check(std::uint64_t number, Isa isa, const testing::RandomConfiguration& made, const reference::Evaluation& expected) {
  const ParticleLayout layout = ParticleLayout::in_space_order(made.configuration, made.model.species.size());
  AlignedArray gradient(layout.dimension());
  PairInteraction::Evaluation sums;
  double energy = 0.0;
  try {
    PairInteraction interaction(made.model, made.configuration.box, layout, kernel_table(isa), made.options);
    const AlignedArray positions = layout.to_slots(made.configuration.positions);
    energy = interaction.energy(positions);
    sums = interaction.energy_and_gradient(positions, gradient);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return Outcome::refused;
  }
  const Tolerances allowed = tolerances(made);
  double worst = 0.0;
  const std::vector<double> users = layout.to_user(gradient);
  for (std::size_t i = 0; i < made.configuration.size(); ++i) {
    const auto scale = *std::max_element(&expected.gradient_magnitude[3 * i], &expected.gradient_magnitude[3 * i] + 3);
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) worst = std::max(worst, relative(users[k], expected.gradient[k], scale));
  }
  const double of_energy = relative(energy, expected.energy, expected.magnitude);
  const double of_virial = relative(sums.virial, expected.virial, expected.virial_magnitude);
  const bool right =
      of_energy <= allowed.energy && of_virial <= allowed.virial && worst <= allowed.gradient && energy == sums.energy;
  EXPECT_TRUE(right) << fmt::format(
      "configuration {} on {}: {} {} {} {} N={} box {} {} {}, {} open axes, unit {} precision {} search {}: energy {} (expected "
      "{}), deviations "
      "{} {} {}, allowed {} {} {}",
      number, to_string(isa), made.model.form->word, made.model.species.size(), to_string(made.model.images),
      to_string(made.model.truncation), made.configuration.size(), made.configuration.box.length[0] / made.unit,
      made.configuration.box.length[1] / made.unit, made.configuration.box.length[2] / made.unit,
      std::ranges::count(made.configuration.box.periodic, false), made.unit, to_string(made.options.precision),
      static_cast<int>(made.options.search), energy, expected.energy, of_energy, of_virial, worst, allowed.energy, allowed.virial,
      allowed.gradient);
  return Outcome::right;
}

TEST(RandomConfigurations, AgreeWithTheReferenceOrAreRefused) {
  const char* wanted = std::getenv("LANESCAPE_RANDOM_CONFIGURATIONS");
  const std::uint64_t count = wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : 10000;
  const Stopwatch watch;
  constexpr double most_seconds = 20.0;  // unless a number is asked for
  std::uint64_t number = 0;
  std::array<std::size_t, 3> outcomes{};
  for (; number < count && (wanted != nullptr || watch.seconds() < most_seconds); ++number) {
    const testing::RandomConfiguration made = testing::RandomConfigurations(number).make();
    const reference::Evaluation expected = evaluate_reference(made.model, made.configuration);
    const bool undecided = depends_on_rounding(made);
    for (const Isa isa : available_isas())
      ++outcomes[static_cast<std::size_t>(undecided ? Outcome::undecided : check(number, isa, made, expected))];
    if (::testing::Test::HasFailure() && wanted == nullptr) break;
  }
  std::cout << fmt::format("configurations 0 to {}: {} right, {} refused, {} decided by rounding\n", number - 1, outcomes[0],
                           outcomes[1], outcomes[2]);
  EXPECT_GE(number, 20U);
  EXPECT_GT(outcomes[0], 3 * (outcomes[1] + outcomes[2]));
}

}  // namespace
}  // namespace lanescape
