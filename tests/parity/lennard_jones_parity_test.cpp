#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "dispatch/isa.hpp"
#include "every_isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "verification/cases.hpp"
#include "verification/junit.hpp"
#include "verification/kernel_checks.hpp"
#include "verification/pair_checks.hpp"
#include "verification/reference_bridge.hpp"
#include "wrong_kernels.hpp"

namespace lanescape {
namespace {

using kernels::KernelTable;
using kernels::PairForm;
using kernels::PairInput;
using kernels::PairKernels;
using kernels::PairOutput;

const PairKernels& of(const KernelTable& table) { return table.pair_kernels(PairForm::lennard_jones); }

const std::vector<PairCase>& every_case() {
  static const std::vector<PairCase> cases = pair_cases();
  return cases;
}

std::vector<PairCase> small_cases() {
  std::vector<PairCase> cases;
  std::copy_if(every_case().begin(), every_case().end(), std::back_inserter(cases),
               [](const PairCase& c) { return c.configuration.size() <= 31; });
  return cases;
}

using LennardJonesParity = testing::EveryIsa;

INSTANTIATE_TEST_SUITE_P(EveryIsa, LennardJonesParity, testing::all_isas(), testing::isa_name);

TEST_P(LennardJonesParity, KernelsAgreeWithTheReferenceOnEveryCase) {
  for (const PairCase& one : every_case())
    for (const Deviation& deviation : verify_all_pairs(kernel_table(GetParam()), {one}))
      EXPECT_TRUE(deviation.passed()) << one.name << ": " << describe(deviation);
}

TEST_P(LennardJonesParity, WorstDeviationsAreWithinTheDeclaredTolerances) {
  for (const Deviation& deviation : verify_all_pairs(kernel_table(GetParam()), every_case())) {
    RecordProperty(deviation.kernel, describe(deviation));
    EXPECT_TRUE(deviation.passed()) << describe(deviation);
  }
}

TEST_P(LennardJonesParity, ListKernelsAgreeWithTheReferenceOnEveryCaseThatAllowsAList) {
  for (const PairCase& one : every_case())
    for (const Deviation& deviation : verify_lists(kernel_table(GetParam()), {one}))
      EXPECT_TRUE(deviation.passed() || deviation.cases == 0) << one.name << ": " << describe(deviation);
  for (const Deviation& deviation : verify_lists(kernel_table(GetParam()), every_case())) {
    RecordProperty(deviation.kernel, describe(deviation));
    EXPECT_TRUE(deviation.passed()) << describe(deviation);
    EXPECT_GT(deviation.cases, every_case().size() / 2);
  }
}

TEST_P(LennardJonesParity, MixedPrecisionAgreesWithTheReferenceOnEveryCaseThatAllowsAListAndHasNoPairAtTheCutoff) {
  for (const PairCase& one : every_case())
    for (const Deviation& deviation : verify_mixed(kernel_table(GetParam()), {one}))
      EXPECT_TRUE(deviation.passed() || deviation.cases == 0) << one.name << ": " << describe(deviation);
  for (const Deviation& deviation : verify_mixed(kernel_table(GetParam()), every_case())) {
    RecordProperty(deviation.kernel, describe(deviation));
    EXPECT_TRUE(deviation.passed()) << describe(deviation);
    EXPECT_GT(deviation.cases, every_case().size() / 2);
  }
}

TEST_P(LennardJonesParity, ClustersAgreeWithTheReferenceOnEveryCaseThatTheyCanHold) {
  for (const Deviation& deviation : verify_clusters(kernel_table(GetParam()), every_case())) {
    RecordProperty(deviation.kernel, describe(deviation));
    EXPECT_TRUE(deviation.passed()) << describe(deviation);
  }
}

TEST_P(LennardJonesParity, AForcedInstructionSetIsTheOneThatRuns) {
  const std::string name = to_string(GetParam());
  ASSERT_EQ(choose_isa(name), GetParam());
  const KernelTable& forced = kernel_table(choose_isa(name));
  EXPECT_EQ(forced.name, name);
  const std::size_t lanes = GetParam() == Isa::avx512 ? 8 : GetParam() == Isa::sse2 ? 2 : 4;
  EXPECT_EQ(forced.lanes, lanes);
  for (const Deviation& deviation : verify_all_pairs(forced, {every_case().front()})) EXPECT_EQ(deviation.isa, name);
  // Its own code, not that of another instruction set under its name.
  for (const Isa isa : available_isas())
    if (isa != GetParam()) {
      const KernelTable& other = kernel_table(isa);
      EXPECT_NE(of(forced).energy, of(other).energy) << other.name;
      EXPECT_NE(of(forced).gradient, of(other).gradient) << other.name;
      EXPECT_NE(of(forced).stress, of(other).stress) << other.name;
      EXPECT_NE(forced.dot, other.dot) << other.name;
    }
}

TEST_P(LennardJonesParity, RepeatedEvaluationsGiveTheSameBits) {
  for (const auto& [name, model, configuration] : every_case()) {
    const ParticleLayout layout(configuration.species, model.species.size());
    const AlignedArray positions = layout.to_slots(configuration.positions);
    PairInteraction interaction(model, configuration.box, layout, kernel_table(GetParam()));
    AlignedArray first(layout.dimension()), second(layout.dimension(), 1.0);
    const auto before = interaction.energy_and_gradient(positions, first);
    const auto after = interaction.energy_and_gradient(positions, second);
    EXPECT_EQ(before.energy, after.energy) << name;
    EXPECT_EQ(before.virial, after.virial) << name;
    EXPECT_EQ(first, second) << name;
  }
}

TEST(LennardJonesCases, HaveNamesThatTellThemApart) {
  std::set<std::string> names;
  for (const PairCase& one : every_case()) EXPECT_TRUE(names.insert(one.name).second) << one.name;
}

TEST(LennardJonesCases, HaveNoPairsNearerThanTheirDescriptionSays) {
  for (const auto& [name, model, configuration] : every_case())
    for (std::size_t i = 0; i < configuration.size(); ++i)
      for (std::size_t j = i + 1; j < configuration.size(); ++j) {
        std::array<double, 3> d;
        for (std::size_t axis = 0; axis < 3; ++axis)
          d[axis] = std::remainder(configuration.positions[3 * i + axis] - configuration.positions[3 * j + axis],
                                   configuration.box.length[axis]);
        const auto a = static_cast<std::size_t>(configuration.species[i]), b = static_cast<std::size_t>(configuration.species[j]);
        EXPECT_GT(std::hypot(d[0], d[1], d[2]), 0.7 * model.sigma[model.pair(a, b)]) << name << ": " << i << ' ' << j;
      }
}

TEST(LennardJonesCases, RunThroughEveryImageSearchInCubesAndInOtherBoxes) {
  std::set<std::pair<kernels::ImageSearch, bool>> met;
  for (const auto& [name, model, configuration] : every_case()) {
    const auto& length = configuration.box.length;
    const bool cubic = length[0] == length[1] && length[0] == length[2];
    met.insert({image_search(configuration.box, model.cutoff * model.sigma[0], model.images), cubic});
  }
  EXPECT_EQ(met.size(), 6U);
}

TEST(LennardJonesCases, CutoffEdgesAreDecidedAsTheirNamesSay) {
  std::size_t found = 0;
  for (const auto& [name, model, configuration] : every_case()) {
    const bool inside = name.starts_with("pair inside the cutoff"), outside = name.starts_with("pair outside the cutoff");
    if (!inside && !outside) continue;
    ++found;
    PairModel slightly_smaller = model;
    slightly_smaller.cutoff = model.cutoff * (1.0 - 3e-12);
    const double step =
        evaluate_reference(model, configuration).energy - evaluate_reference(slightly_smaller, configuration).energy;
    const double at_cutoff = 4.0 * (std::pow(2.5, -12) - std::pow(2.5, -6));
    EXPECT_NEAR(step, inside ? at_cutoff : 0.0, 1e-12) << name;
  }
  EXPECT_EQ(found, 10U);
}

// The checks must be able to fail: each of these kernels is slightly wrong in one place.
const KernelTable* right = nullptr;  // source of the correct kernels; global, because a kernel is a plain function

// The correct table with other Lennard-Jones kernels.
KernelTable with(const PairKernels& lennard_jones) {
  KernelTable table = *right;
  table.pair[static_cast<std::size_t>(PairForm::lennard_jones)] = &lennard_jones;
  return table;
}

double energy_slightly_wrong(const PairInput& in) noexcept { return of(*right).energy(in) * (1.0 + 1e-11); }
double energy_off_by_one_bit(const PairInput& in) noexcept { return std::nextafter(of(*right).energy(in), 1e300); }
double energy_not_a_number(const PairInput&) noexcept { return std::numeric_limits<double>::quiet_NaN(); }
double energy_without_shift(const PairInput& in) noexcept {
  std::vector<kernels::PairParameters> pairs(in.pairs, in.pairs + in.block_count * in.block_count);
  for (auto& pair : pairs) pair.coefficient[2] = 0.0;
  PairInput changed = in;
  changed.pairs = pairs.data();
  return of(*right).energy(changed);
}
void gradient_wrong_in_one_component(const PairInput& in, double* gradient, PairOutput& out) noexcept {
  of(*right).gradient(in, gradient, out);
  if (in.slots > 0) gradient[0] *= 1.0 + 1e-10;
}
void gradient_with_dirty_padding(const PairInput& in, double* gradient, PairOutput& out) noexcept {
  of(*right).gradient(in, gradient, out);
  if (in.slots > 0) gradient[in.slots - 1] += 1e-300;
}
void gradient_leaving_the_last_pairs_out(const PairInput& in, double* gradient, PairOutput& out) noexcept {
  std::vector<kernels::SpeciesBlock> blocks(in.blocks, in.blocks + in.block_count);
  if (blocks[0].count > 1) --blocks[0].count;
  PairInput changed = in;
  changed.blocks = blocks.data();
  of(*right).gradient(changed, gradient, out);
}
void gradient_with_wrong_virial(const PairInput& in, double* gradient, PairOutput& out) noexcept {
  of(*right).gradient(in, gradient, out);
  out.virial *= 1.0 - 1e-11;
}
void stress_with_swapped_shears(const PairInput& in, double* gradient, PairOutput& out) noexcept {
  of(*right).stress(in, gradient, out);
  std::swap(out.virial_tensor[3], out.virial_tensor[5]);
}
void stress_with_wrong_gradient(const PairInput& in, double* gradient, PairOutput& out) noexcept {
  of(*right).stress(in, gradient, out);
  if (in.slots > 0) gradient[2 * in.slots] = -gradient[2 * in.slots];
}

std::vector<std::string> failed_checks(const KernelTable& table) {
  return testing::failed_of(verify_all_pairs(table, small_cases()));
}

TEST(LennardJonesChecks, FailForTheResultThatIsWrongAndForNoOther) {
  right = &kernel_table(available_isas().back());
  const auto failed_with = [](auto PairKernels::* kernel, auto replacement) {
    PairKernels wrong = of(*right);
    wrong.*kernel = replacement;
    return failed_checks(with(wrong));
  };
  using Names = std::vector<std::string>;
  const std::string same_energy = "lennard_jones_energy, lennard_jones_gradient, lennard_jones_stress: same energy",
                    same_virial = "lennard_jones_gradient, lennard_jones_stress: same virial";
  EXPECT_EQ(failed_checks(*right), Names{});
  EXPECT_EQ(failed_with(&PairKernels::energy, energy_slightly_wrong), (Names{"lennard_jones_energy", same_energy}));
  EXPECT_EQ(failed_with(&PairKernels::energy, energy_not_a_number), (Names{"lennard_jones_energy", same_energy}));
  EXPECT_EQ(failed_with(&PairKernels::energy, energy_without_shift), (Names{"lennard_jones_energy", same_energy}));
  EXPECT_EQ(failed_with(&PairKernels::gradient, gradient_wrong_in_one_component), Names{"lennard_jones_gradient gradient"});
  EXPECT_EQ(failed_with(&PairKernels::gradient, gradient_with_dirty_padding), Names{"lennard_jones_gradient gradient"});
  EXPECT_EQ(failed_with(&PairKernels::gradient, gradient_leaving_the_last_pairs_out),
            (Names{"lennard_jones_gradient energy", "lennard_jones_gradient gradient", "lennard_jones_gradient virial", same_energy,
                   same_virial}));
  EXPECT_EQ(failed_with(&PairKernels::gradient, gradient_with_wrong_virial), (Names{"lennard_jones_gradient virial", same_virial}));
  EXPECT_EQ(failed_with(&PairKernels::stress, stress_with_swapped_shears), Names{"lennard_jones_stress tensor"});
  EXPECT_EQ(failed_with(&PairKernels::stress, stress_with_wrong_gradient), Names{"lennard_jones_stress gradient"});
}

TEST(LennardJonesChecks, SeeASingleBitBetweenTheKernels) {
  right = &kernel_table(available_isas().back());
  PairKernels wrong = of(*right);
  wrong.energy = energy_off_by_one_bit;
  // If no pair is in range the energy is exactly zero, and a change of one bit is not a rounding error.
  std::vector<PairCase> dense = small_cases();
  std::erase_if(dense, [](const PairCase& c) { return c.configuration.size() < 8; });
  std::vector<std::string> failed;
  for (const Deviation& deviation : verify_all_pairs(with(wrong), dense))
    if (!deviation.passed()) failed.push_back(deviation.kernel);
  EXPECT_EQ(failed, std::vector<std::string>{"lennard_jones_energy, lennard_jones_gradient, lennard_jones_stress: same energy"});
}

TEST(LennardJonesChecks, DoNotPassWithoutASingleCase) {
  for (const Deviation& deviation : verify_all_pairs(kernel_table(available_isas().back()), {}))
    EXPECT_FALSE(deviation.passed()) << deviation.kernel;
}

TEST(Junit, ListsEveryCheckAndEscapesWhatXmlReserves) {
  std::ostringstream out;
  write_junit(out, {{"lennard_jones_energy", "avx2", "", 0.0, 1e-14, 3}, {"dot", "sse2", "a<b & \"c\"\n", 1.0, 1e-15, 2}});
  EXPECT_EQ(out.str(),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<testsuites>\n"
            "  <testsuite name=\"lanescape verify\" tests=\"2\" failures=\"1\" errors=\"0\" skipped=\"0\">\n"
            "    <testcase classname=\"avx2\" name=\"lennard_jones_energy\"/>\n"
            "    <testcase classname=\"sse2\" name=\"dot\">\n"
            "      <failure message=\"dot on sse2: worst deviation 1, allowed 1e-15, of 2 cases the worst is "
            "&apos;a&lt;b &amp; &quot;c&quot;&#10;&apos;\"/>\n"
            "    </testcase>\n"
            "  </testsuite>\n"
            "</testsuites>\n");
}

}  // namespace
}  // namespace lanescape
