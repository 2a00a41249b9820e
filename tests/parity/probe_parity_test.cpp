#include <gtest/gtest.h>

#include <vector>

#include "dispatch/isa.hpp"
#include "every_isa.hpp"
#include "interaction/pair/probe_field.hpp"
#include "refusal.hpp"
#include "verification/cases.hpp"
#include "verification/probe_checks.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

const std::vector<PairCase>& every_case() {
  static const std::vector<PairCase> cases = pair_cases();
  return cases;
}

using ProbeParity = testing::EveryIsa;

INSTANTIATE_TEST_SUITE_P(EveryIsa, ProbeParity, testing::all_isas(), testing::isa_name);

TEST_P(ProbeParity, KernelsAgreeWithTheReferenceOnEveryCase) {
  for (const Deviation& deviation : verify_probes(kernel_table(GetParam()), every_case())) {
    RecordProperty(deviation.kernel, describe(deviation));
    EXPECT_TRUE(deviation.passed()) << describe(deviation);
    EXPECT_GT(deviation.cases, every_case().size() / 2);
  }
}

// Two species in a box with several columns of cells.
Configuration large_fluid() {
  for (const auto& one : every_case())
    if (one.name == "kob-andersen N=257 all tail") return one.configuration;
  return {};
}

TEST_P(ProbeParity, AFluidThatParticlesWerePutIntoAndTakenOutOfIsFeltAsItIs) {
  PairModel model = kob_andersen();
  model.truncation = Truncation::tail;
  Configuration fluid = large_fluid();
  ASSERT_EQ(fluid.size(), 257U);
  const std::array<double, 3> place = fluid.position(100);
  const int species = fluid.species[100];
  ProbeField field(model, {fluid.box, {}, {}}, species, kernel_table(GetParam()));
  for (std::size_t i = 0; i < fluid.size(); ++i) field.insert(fluid.position(i), fluid.species[i]);
  EXPECT_TRUE(field.remove(place, species));
  EXPECT_FALSE(field.remove(place, species));
  EXPECT_EQ(field.size(), 256U);
  fluid.species.erase(fluid.species.begin() + 100);
  fluid.positions.erase(fluid.positions.begin() + 300, fluid.positions.begin() + 303);
  const reference::Probe expected = probe_reference(model, fluid, place, species);
  const ProbeField::Sample sample = field.sample(place);
  EXPECT_NEAR(sample.energy, expected.energy, 2e-14 * expected.magnitude);
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(sample.gradient[axis], expected.gradient[axis], 3e-13 * expected.gradient_magnitude[axis]);
  // The energy is the same at every periodic image.
  const std::array<double, 3> image = {place[0] + fluid.box.length[0], place[1] - 2.0 * fluid.box.length[1], place[2]};
  EXPECT_NEAR(field.energy(image), expected.energy, 2e-13 * expected.magnitude);
}

TEST(ProbeField, RefusesWhatItCannotProbe) {
  const kernels::KernelTable& table = kernel_table(choose_isa("auto"));
  PairModel model = lennard_jones();
  const Configuration fluid{{{4.0, 6.0, 6.0}}, {0}, {0.0, 0.0, 0.0}};
  EXPECT_EQ(testing::refusal([&] { ProbeField(model, fluid, 1, table); }),
            "species 1 of an inserted particle is not allowed: the model has 1");
  model.images = ImageRule::minimum;
  EXPECT_EQ(
      testing::refusal([&] { ProbeField(model, fluid, 0, table); }),
      "insertion under the minimum-image rule is not allowed in a box of shortest edge 4: at least twice the cutoff, 5, is needed");
}

}  // namespace
}  // namespace lanescape
