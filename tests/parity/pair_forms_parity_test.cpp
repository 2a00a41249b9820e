#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "configuration/pair_form.hpp"
#include "every_isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "verification/cases.hpp"
#include "verification/pair_checks.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

using PairFormsParity = testing::EveryIsa;

INSTANTIATE_TEST_SUITE_P(EveryIsa, PairFormsParity, testing::all_isas(), testing::isa_name);

TEST_P(PairFormsParity, EveryLoopOverEveryFormAgreesWithTheReference) {
  for (const PairForm& form : pair_forms())
    for (const Deviation& deviation : verify_pairs(kernel_table(GetParam()), form_cases(form), name_in_results(form)))
      EXPECT_TRUE(deviation.passed()) << describe(deviation);
}

// Mie's potential with the exponents 12 and 6 is Lennard-Jones, computed by another kernel.
TEST_P(PairFormsParity, MieWithExponentsTwelveAndSixIsLennardJones) {
  for (const PairCase& one : form_cases(lennard_jones_form())) {
    PairModel mie = one.model;
    mie.form = &pair_form("mie");
    mie.form_numbers = {12.0, 6.0};
    const ParticleLayout layout = ParticleLayout::in_users_order(one.configuration, mie.species.size());
    const AlignedArray positions = layout.to_slots(one.configuration.positions);
    const double expected = PairInteraction(one.model, one.configuration.box, layout, kernel_table(GetParam())).energy(positions);
    const double scale = evaluate_reference(one.model, one.configuration).magnitude;
    EXPECT_NEAR(PairInteraction(mie, one.configuration.box, layout, kernel_table(GetParam())).energy(positions), expected,
                4e-14 * scale)
        << one.name;
  }
}

// The cases are sensitive to the parameters of a form: a relative change of 1e-6 fails.
TEST(PairFormCases, FailForAWrongNumber) {
  const kernels::KernelTable& table = kernel_table(available_isas().back());
  for (const PairForm& form : pair_forms()) {
    bool seen = false;
    for (const PairCase& one : form_cases(form)) {
      PairModel wrong = one.model;
      for (double& epsilon : wrong.epsilon) epsilon *= 1.0 + 1e-6;
      const ParticleLayout layout = ParticleLayout::in_users_order(one.configuration, wrong.species.size());
      const double energy =
          PairInteraction(wrong, one.configuration.box, layout, table).energy(layout.to_slots(one.configuration.positions));
      const reference::Evaluation expected = evaluate_reference(one.model, one.configuration);
      seen = seen || std::abs(energy - expected.energy) > tolerance::pair_sums * expected.magnitude;
    }
    EXPECT_TRUE(seen) << form.word;
  }
}

TEST(PairFormCases, CoverEveryTruncationThatTheFormAllows) {
  for (const PairForm& form : pair_forms()) {
    std::set<Truncation> truncations;
    for (const PairCase& one : form_cases(form)) truncations.insert(one.model.truncation);
    EXPECT_GE(truncations.size(), form.tail == nullptr ? 4U : 5U) << form.word;
  }
}

}  // namespace
}  // namespace lanescape
