#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "dispatch/isa.hpp"
#include "every_isa.hpp"
#include "verification/state_mixture_checks.hpp"
#include "wrong_kernels.hpp"

namespace lanescape {
namespace {

using kernels::KernelTable;

const std::vector<StateMixtureCase>& every_case() {
  static const std::vector<StateMixtureCase> cases = state_mixture_cases();
  return cases;
}

using StateMixtureParity = testing::EveryIsa;
INSTANTIATE_TEST_SUITE_P(EveryIsa, StateMixtureParity, testing::all_isas(), testing::isa_name);

TEST_P(StateMixtureParity, KernelsAgreeWithTheReferenceOnEveryCase) {
  for (const Deviation& deviation : verify_state_mixtures(kernel_table(GetParam()), every_case())) {
    RecordProperty(deviation.kernel, describe(deviation));
    EXPECT_TRUE(deviation.passed()) << describe(deviation);
  }
}

TEST_P(StateMixtureParity, AreCodeOfTheirOwnOnEachInstructionSet) {
  for (const Isa isa : available_isas())
    if (isa != GetParam()) {
      const KernelTable &mine = kernel_table(GetParam()), &other = kernel_table(isa);
      EXPECT_NE(mine.state_densities, other.state_densities);
      EXPECT_NE(mine.state_lj_gradient, other.state_lj_gradient);
      EXPECT_NE(mine.state_table_gradient, other.state_table_gradient);
      EXPECT_NE(mine.state_density_gradient, other.state_density_gradient);
    }
}

TEST(StateMixtureCases, HaveNamesThatTellThemApart) {
  std::set<std::string> names;
  for (const StateMixtureCase& one : every_case()) EXPECT_TRUE(names.insert(one.name).second) << one.name;
}

TEST(StateMixtureCases, CoverProbabilitiesFromZeroToOne) {
  std::size_t middling = 0, saturated = 0;
  for (const auto& [name, model, configuration] : every_case())
    for (const double p : evaluate_reference(model, configuration).probabilities) {
      middling += p > 0.1 && p < 0.9;
      saturated += p == 0.0;
    }
  EXPECT_GT(middling, 1000U);
  EXPECT_GT(saturated, 100U);
}

// The checks must be able to fail.
const KernelTable* right = nullptr;

void densities_without_a_row(const kernels::StateDensityInput& in, double* densities) noexcept {
  right->state_densities(in, densities);
  densities[0] *= 1.0 + 1e-11;
}
void gradient_with_half_the_slopes(const kernels::StateLjInput& in, double* g, double* slopes, kernels::PairOutput& out) noexcept {
  right->state_lj_gradient(in, g, slopes, out);
  for (std::size_t k = 0; k < in.list.row_count * in.probabilities.states; ++k) slopes[k] *= 0.5;
}
void density_gradient_of_one_end(const kernels::StateDensityForceInput& in, double* g, kernels::PairOutput& out) noexcept {
  std::vector<double> none(in.list.species_count, 0.0);
  kernels::StateDensityForceInput changed = in;
  changed.filter_back = none.data();
  right->state_density_gradient(changed, g, out);
}
double table_energy_slightly_wrong(const kernels::StateTableInput& in) noexcept {
  return right->state_table_energy(in) * (1.0 + 1e-11);
}

std::vector<std::string> failed_checks(const KernelTable& table) {
  std::vector<StateMixtureCase> few;
  for (const StateMixtureCase& one : every_case())
    if (one.name.starts_with("2 species, 2 states, every")) few.push_back(one);
  std::vector<std::string> failed = testing::failed_of(verify_state_mixtures(table, few));
  return failed;
}

TEST(StateMixtureChecks, FailForWhatIsWrong) {
  right = &kernel_table(available_isas().back());
  EXPECT_EQ(failed_checks(*right), std::vector<std::string>{});
  const auto fails = [](auto KernelTable::* kernel, auto replacement, const std::string& check) {
    const auto failed = failed_checks(testing::with_kernel(*right, kernel, +replacement));
    EXPECT_NE(std::find(failed.begin(), failed.end(), check), failed.end()) << check;
  };
  fails(&KernelTable::state_densities, densities_without_a_row, "state_densities");
  fails(&KernelTable::state_lj_gradient, gradient_with_half_the_slopes, "state_lj_gradient, state_density_gradient gradient");
  fails(&KernelTable::state_density_gradient, density_gradient_of_one_end, "state_lj_gradient, state_density_gradient gradient");
  fails(&KernelTable::state_density_gradient, density_gradient_of_one_end, "state_table_gradient, state_density_gradient virial");
  fails(&KernelTable::state_table_energy, table_energy_slightly_wrong, "state_table_energy");
}

TEST(StateMixtureChecks, DoNotPassWithoutASingleCase) {
  for (const Deviation& deviation : verify_state_mixtures(kernel_table(available_isas().back()), {}))
    EXPECT_FALSE(deviation.passed()) << deviation.kernel;
}

}  // namespace
}  // namespace lanescape
