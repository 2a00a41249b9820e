#include "verification/host_results.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>
#include <vector>

#include "refusal.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

PairCase case_named(const std::string& name) {
  for (PairCase& one : all_pair_cases())
    if (one.name == name) return one;
  ADD_FAILURE() << name;
  return {};
}

HostResult reference_result(const PairCase& one) {
  const reference::Evaluation expected = evaluate_reference(one.model, one.configuration);
  HostResult result{HostResult::Kind::given, "", expected.energy, expected.virial, expected.gradient};
  for (double& f : *result.forces) f = -f;
  return result;
}

HostReport judge(const PairCase& one, const HostResult& result, HostPrecision precision = HostPrecision::double_precision) {
  return compare_with_reference({one}, {result}, precision);
}

TEST(HostResults, TheReferencePassesItsOwnCasesWithoutAnyDeviation) {
  const std::vector<PairCase> cases = all_pair_cases();
  std::vector<HostResult> results;
  for (const PairCase& one : cases) results.push_back(reference_result(one));
  const HostReport report = compare_with_reference(cases, results, HostPrecision::double_precision);
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.count(HostOutcome::passed), cases.size());
  for (const HostDeviation& quantity : report.quantities) EXPECT_EQ(quantity.worst, 0.0) << quantity.quantity;
}

TEST(HostResults, NamesOfCasesAreUnique) {
  std::set<std::string> names;
  for (const PairCase& one : all_pair_cases()) EXPECT_TRUE(names.insert(one.name).second) << one.name;
}

TEST(HostResults, DeviationsAreRelativeToTheSumOfTheAbsoluteTerms) {
  const PairCase one = case_named("kob-andersen N=31 all shifted");
  const reference::Evaluation expected = evaluate_reference(one.model, one.configuration);
  for (const double part : {0.5, 2.0}) {
    HostResult energy = reference_result(one), virial = energy;
    *energy.energy += part * tolerance::host_sums * expected.magnitude;
    *virial.virial -= part * tolerance::host_sums * expected.virial_magnitude;
    EXPECT_EQ(judge(one, energy).passed(), part < 1.0);
    EXPECT_EQ(judge(one, virial).passed(), part < 1.0);
  }
}

TEST(HostResults, AWrongForceNamesParticleAndComponent) {
  const PairCase one = case_named("kob-andersen N=31 all shifted");
  HostResult result = reference_result(one);
  (*result.forces)[3 * 17 + 1] *= 1.0 + 1e-9;
  const HostReport report = judge(one, result);
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(report.quantities[1].component, 3U * 17U + 1U);
  EXPECT_NE(report.summary().find("force on particle 17 (from 0), y"), std::string::npos) << report.summary();
}

TEST(HostResults, RoundingOfTheForcesOfOwnImagesIsNoFault) {
  const PairCase one = case_named("lennard-jones N=1 all shifted");
  HostResult result = reference_result(one);
  *result.forces = {6e-15, -1e-15, 0.0};
  EXPECT_TRUE(judge(one, result).passed());
  (*result.forces)[2] = 1e-6;
  EXPECT_FALSE(judge(one, result).passed());
  PairCase minimum = one;  // nothing is summed
  minimum.model.images = ImageRule::minimum;
  EXPECT_FALSE(judge(minimum, result).passed());
}

TEST(HostResults, WhatIsNotANumberFails) {
  const PairCase one = case_named("lennard-jones N=0 all shifted");
  HostResult result = reference_result(one);
  EXPECT_TRUE(judge(one, result).passed());
  result.energy = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(judge(one, result).passed());
}

TEST(HostResults, CasesWithAPairAtTheCutoffAreLeftOutInSinglePrecisionOnly) {
  const PairCase one = case_named("pair inside the cutoff (nearest)");
  EXPECT_EQ(judge(one, reference_result(one)).count(HostOutcome::passed), 1U);
  const HostReport single = judge(one, reference_result(one), HostPrecision::single_precision);
  EXPECT_EQ(single.count(HostOutcome::left_out), 1U);
  EXPECT_FALSE(single.passed());
}

TEST(HostResults, AnUnknownPrecisionIsRefusedWithThoseThereAre) {
  EXPECT_NE(testing::refusal([] { parse_host_precision("half"); }).find("double, single"), std::string::npos);
}

}  // namespace
}  // namespace lanescape
