// Random sites in states on every instruction set against the scalar reference (support/random_run.hpp: how many). A failure names
// the number from which a system follows.

#include "random_state_mixtures.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "configuration/particle_layout.hpp"
#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "interaction/state/state_mixture.hpp"
#include "random_run.hpp"
#include "state_comparison.hpp"

namespace lanescape {
namespace {

using testing::Outcome;

// What the reference says, what rounding scales with, and what rounding of coordinates does to a separation [sigma].
struct Expected {
  reference::StateEvaluation value, magnitude;
  double rounding, forces, reach;
  bool at_cutoff;

  explicit Expected(const testing::RandomStateMixture& made)
      : value(evaluate_reference(made.model, made.configuration)),
        magnitude(testing::StateMagnitudes(made.model)(made.configuration)),
        rounding(4.0 * 0x1p-53 * testing::largest_coordinate(made.configuration)),
        forces(0.0),
        reach(0.0),
        at_cutoff(testing::has_site_at_cutoff(made, rounding)) {
    for (const double force : magnitude.gradient_magnitude) forces += force;
    for (std::size_t k = 0; k < made.model.filter.size(); ++k)
      reach = std::max(reach, made.model.reach(k / made.model.species.size(), k % made.model.species.size()));
  }
};

struct Deviations {
  double energy, virial, gradient;
};

// Slopes of saturated probabilities are subnormal or zero, and so are forces and virials that follow from them alone.
constexpr double underflow = 1e-280;

// In units of what is allowed. Rounding of separations changes an energy by at most the forces times it, and a force relative to
// the least distance of 0.75 units, amplified thirteen times by r^-13. Virials are relative to forces at the longest distance.
Deviations deviations(const testing::RandomStateMixture& made, const Expected& expected, const StateMixture::Evaluation& found,
                      const std::vector<double>& gradient) {
  const double relative_rounding = 13.0 * expected.rounding / (0.75 * made.unit);
  const double of_energy = tolerance::state_sums * expected.magnitude.magnitude + expected.rounding * expected.forces;
  const double of_virial = (tolerance::state_sums + relative_rounding) * 0.5 * expected.forces * expected.reach + underflow;
  Deviations worst{relative(found.energy, expected.value.energy, of_energy),
                   relative(found.virial, expected.value.virial, of_virial), 0.0};
  for (std::size_t k = 0; k < gradient.size(); ++k) {
    const double allowed =
        (tolerance::state_gradient + relative_rounding) * expected.magnitude.gradient_magnitude[k / 3] + underflow;
    worst.gradient = std::max(worst.gradient, relative(gradient[k], expected.value.gradient[k], allowed));
  }
  for (std::size_t k = 0; k < 6; ++k)
    worst.virial = std::max(worst.virial, relative(found.virial_tensor[k], expected.value.virial_tensor[k], of_virial));
  return worst;
}

std::string describe(const testing::RandomStateMixture& made) {
  const Configuration& c = made.configuration;
  return fmt::format("{} species, up to {} states, N={}, box {} {} {} units, largest coordinate {} units, {}",
                     made.model.species.size(), made.model.most_states(), c.size(), c.box.length[0] / made.unit,
                     c.box.length[1] / made.unit, c.box.length[2] / made.unit, testing::largest_coordinate(c) / made.unit,
                     made.search == PairSearch::all_pairs ? "all pairs" : "list");
}

Outcome check(std::uint64_t number, Isa isa, const testing::RandomStateMixture& made, const Expected& expected) {
  const ParticleLayout layout = ParticleLayout::in_space_order(made.configuration, made.model.species.size());
  const AlignedArray positions = layout.to_slots(made.configuration.positions);
  AlignedArray gradient(layout.dimension()), with_stress(layout.dimension());
  StateMixture::Options options;
  options.search = made.search;
  options.threads = made.threads;
  StateMixture sites(made.model, made.configuration.box, layout, kernel_table(isa), options);
  const double energy = sites.energy(positions);
  const auto sums = sites.energy_and_gradient(positions, gradient);
  const auto stress = sites.energy_and_stress(positions, with_stress);
  const bool bits = same_bits(energy, sums.energy) && same_bits(energy, stress.energy) && gradient == with_stress;
  const Deviations worst = deviations(made, expected, stress, layout.to_user(gradient));
  const bool forces = expected.at_cutoff || (worst.virial <= 1.0 && worst.gradient <= 1.0);
  if (bits && forces && worst.energy <= 1.0) return expected.at_cutoff ? Outcome::undecided : Outcome::right;
  ADD_FAILURE() << fmt::format("sites {} on {}: {}: energy {} (expected {}){}; deviations {} {} {} of those allowed", number,
                               to_string(isa), describe(made), energy, expected.value.energy,
                               bits ? "" : ", other bits with forces or stress", worst.energy, worst.virial, worst.gradient);
  return Outcome::wrong;
}

TEST(RandomStateMixtures, AgreeWithTheReferenceOrAreRefused) {
  testing::RandomRun(3.0).for_each("systems of sites in states", [](std::uint64_t number, auto add) {
    const testing::RandomStateMixture made = testing::RandomStateMixtures(number).make();
    made.model.check();
    try {
      check_cutoff(made.model, made.configuration.box);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::bad_input) << "sites " << number << ": " << error.what();
      return add(Outcome::refused);
    }
    const Expected expected(made);
    for (const Isa isa : available_isas()) add(check(number, isa, made, expected));
  });
}

}  // namespace
}  // namespace lanescape
