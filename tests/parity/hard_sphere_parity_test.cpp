#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "dispatch/isa.hpp"
#include "every_isa.hpp"
#include "reference/hard_sphere.hpp"
#include "verification/event_driven_checks.hpp"
#include "verification/hard_sphere_cases.hpp"
#include "verification/hard_sphere_checks.hpp"
#include "wrong_kernels.hpp"

namespace lanescape {
namespace {

using kernels::CalendarView;
using kernels::CollisionEvent;
using kernels::CollisionQuery;
using kernels::ContactPotential;
using kernels::KernelTable;
using kernels::SphereContacts;
using kernels::SphereInput;
using kernels::SphereList;
using kernels::SpherePair;

const std::vector<HardSphereCase>& every_case() {
  static const std::vector<HardSphereCase> cases = hard_sphere_cases();
  return cases;
}

// Enough cases for every check to detect a wrong kernel.
std::vector<HardSphereCase> small_cases() {
  std::vector<HardSphereCase> cases;
  std::copy_if(every_case().begin(), every_case().end(), std::back_inserter(cases),
               [](const HardSphereCase& c) { return c.configuration.size() <= 31; });
  return cases;
}

using HardSphereParity = testing::EveryIsa;

INSTANTIATE_TEST_SUITE_P(EveryIsa, HardSphereParity, testing::all_isas(), testing::isa_name);

TEST_P(HardSphereParity, OverlapsListsForcesAndTrialsAgreeWithTheReference) {
  for (const Deviation& deviation : verify_hard_spheres(kernel_table(GetParam()), every_case())) {
    RecordProperty(deviation.kernel, describe(deviation));
    EXPECT_TRUE(deviation.passed()) << describe(deviation);
    EXPECT_EQ(deviation.isa, to_string(GetParam()));
  }
}

TEST_P(HardSphereParity, CollisionsAndCalendarsAgreeWithTheReference) {
  for (const Deviation& deviation : verify_event_driven(kernel_table(GetParam()))) {
    RecordProperty(deviation.kernel, describe(deviation));
    EXPECT_TRUE(deviation.passed()) << describe(deviation);
    EXPECT_EQ(deviation.isa, to_string(GetParam()));
  }
}

TEST(HardSphereCases, HaveNamesThatTellThemApart) {
  std::set<std::string> names;
  for (const HardSphereCase& one : every_case()) EXPECT_TRUE(names.insert(one.name).second) << one.name;
}

TEST(HardSphereCases, HaveBoxesOfAtLeastTwiceTheLargestDiameter) {
  for (const auto& [name, configuration] : every_case())
    for (const double radius : configuration.radii) EXPECT_GE(configuration.box.shortest(), 4.0 * radius) << name;
}

TEST(HardSphereCases, OverlapAsTheirNamesSay) {
  std::size_t apart = 0, overlapping = 0, touching = 0;
  for (const auto& [name, c] : every_case()) {
    const bool overlap = reference::any_overlap(c.positions, c.radii, c.box.length);
    const double gap = reference::smallest_gap(c.positions, c.radii, c.box.length);
    if (name.ends_with("apart")) {
      EXPECT_FALSE(overlap) << name;
      ++apart;
    }
    if (name.ends_with("overlapping") && c.size() >= 107) {
      EXPECT_TRUE(overlap) << name;
      ++overlapping;
    }
    if (name.starts_with("touching pair") || name.ends_with("pair touching in two images")) {
      EXPECT_FALSE(overlap) << name;
      EXPECT_EQ(gap, 0.0) << name;
      ++touching;
    }
    if (name.starts_with("pair of radii one ulp too large") || name.starts_with("pair one ulp too near")) {
      EXPECT_TRUE(overlap) << name;
      ++touching;
    }
    if (name.starts_with("pair of radii one ulp smaller") || name.starts_with("pair one ulp farther")) {
      EXPECT_FALSE(overlap) << name;
      EXPECT_GT(gap, 0.0) << name;
      ++touching;
    }
  }
  EXPECT_EQ(apart, 90U);
  EXPECT_EQ(overlapping, 24U);
  EXPECT_EQ(touching, 159U);
}

// The checks must be able to fail: each of these kernels is slightly wrong in one place.
const KernelTable* right = nullptr;  // source of the correct kernels; global, because a kernel is a plain function

bool overlap_that_touching_is(const SphereInput& in) noexcept { return right->sphere_smallest_gap(in) <= 0.0; }
bool overlap_without_the_last_row(const SphereInput& in) noexcept {
  std::vector<SpherePair> pairs(10000);
  const std::size_t count = right->sphere_pairs_within(in, 0.0, pairs.data(), pairs.size());
  return std::any_of(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(std::min(count, pairs.size())),
                     [&](const SpherePair& pair) { return pair.first != 0; });
}
std::size_t pairs_but_one(const SphereInput& in, double reach, SpherePair* out, std::size_t capacity) noexcept {
  const std::size_t count = right->sphere_pairs_within(in, reach, out, capacity);
  return count > 30 ? count - 1 : count;
}
std::size_t pairs_up_to_the_capacity(const SphereInput& in, double reach, SpherePair* out, std::size_t capacity) noexcept {
  return std::min(capacity, right->sphere_pairs_within(in, reach, out, capacity));
}
double gap_off_by_one_bit(const SphereInput& in) noexcept { return std::nextafter(right->sphere_smallest_gap(in), 1e300); }
bool list_without_its_last_vector(const SphereList& list, const double* positions, std::size_t slots) noexcept {
  SphereList shorter = list;
  if (shorter.count > 8) shorter.count -= 8;
  return right->sphere_list_any_overlap(shorter, positions, slots);
}
std::size_t contacts_but_one(const SphereList& list, const double* positions, std::size_t slots,
                             const SphereContacts& out) noexcept {
  const std::size_t count = right->sphere_list_contacts(list, positions, slots, out);
  return count > 8 ? count - 1 : count;
}
void cubic_for_harmonic(const SphereList& list, const SphereContacts& contacts, std::size_t count, ContactPotential potential,
                        double* force, std::size_t slots) noexcept {
  right->sphere_contact_forces(list, contacts, count, potential == ContactPotential::harmonic ? ContactPotential::cubic : potential,
                               force, slots);
}
void linear_slightly_wrong(const SphereList& list, const SphereContacts& contacts, std::size_t count, ContactPotential potential,
                           double* force, std::size_t slots) noexcept {
  right->sphere_contact_forces(list, contacts, count, potential, force, slots);
  if (potential == ContactPotential::linear && slots > 0) force[0] *= 1.0 + 1e-14;
}
std::size_t trial_that_counts_all(double* trial, const double* position, double* sum, double* force, double step,
                                  std::size_t slots) noexcept {
  right->sphere_avoidance_trial(trial, position, sum, force, step, slots);
  return slots;
}
std::size_t trial_that_keeps_forces(double* trial, const double* position, double* sum, double* force, double step,
                                    std::size_t slots) noexcept {
  const double first = force[1];
  const std::size_t moved = right->sphere_avoidance_trial(trial, position, sum, force, step, slots);
  force[1] = first;
  return moved;
}
std::size_t trial_slightly_too_far(double* trial, const double* position, double* sum, double* force, double step,
                                   std::size_t slots) noexcept {
  return right->sphere_avoidance_trial(trial, position, sum, force, step * (1.0 + 1e-9), slots);
}
CollisionEvent collision_one_bit_late(const CollisionQuery& query) noexcept {
  CollisionEvent event = right->sphere_first_collision(query);
  if (query.growth == 0.0) event.time = std::nextafter(event.time, 1e300);
  return event;
}
CollisionEvent collision_without_the_last_neighbour(const CollisionQuery& query) noexcept {
  CollisionQuery shorter = query;
  if (query.count > 16 && query.growth == 0.0) --shorter.count;
  return right->sphere_first_collision(shorter);
}
CollisionEvent collision_growing_slightly_less(const CollisionQuery& query) noexcept {
  CollisionQuery slower = query;
  slower.growth *= 1.0 - 1e-12;
  return right->sphere_first_collision(slower);
}
void calendar_late_in_one_lane(const CalendarView& calendar, std::size_t event, double time) noexcept {
  right->calendar_update(calendar, event, event % 16 == 15 ? 1.5 * time : time);
}

std::vector<std::string> failed_checks(const KernelTable& table) {
  std::vector<Deviation> deviations = verify_hard_spheres(table, small_cases());
  for (Deviation& deviation : verify_event_driven(table)) deviations.push_back(std::move(deviation));
  return testing::failed_of(deviations);
}

TEST(HardSphereChecks, FailForTheKernelThatIsWrongAndForNoOther) {
  right = &kernel_table(available_isas().back());
  const auto failed_with = [](auto KernelTable::* kernel, auto replacement) {
    return failed_checks(testing::with_kernel(*right, kernel, +replacement));
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(failed_checks(*right), Names{});
  EXPECT_EQ(failed_with(&KernelTable::sphere_any_overlap, overlap_that_touching_is), Names{"sphere_any_overlap"});
  EXPECT_EQ(failed_with(&KernelTable::sphere_any_overlap, overlap_without_the_last_row), Names{"sphere_any_overlap"});
  EXPECT_EQ(failed_with(&KernelTable::sphere_pairs_within, pairs_but_one).front(), "sphere_pairs_within");
  EXPECT_EQ(failed_with(&KernelTable::sphere_pairs_within, pairs_up_to_the_capacity).back(),
            "sphere_pairs_within beyond the capacity");
  EXPECT_EQ(failed_with(&KernelTable::sphere_smallest_gap, gap_off_by_one_bit), Names{"sphere_smallest_gap"});
  EXPECT_EQ(failed_with(&KernelTable::sphere_list_any_overlap, list_without_its_last_vector), Names{"sphere_list_any_overlap"});
  EXPECT_EQ(failed_with(&KernelTable::sphere_list_contacts, contacts_but_one).front(), "sphere_list_contacts");
  EXPECT_EQ(failed_with(&KernelTable::sphere_contact_forces, cubic_for_harmonic), Names{"sphere_contact_forces harmonic"});
  EXPECT_EQ(failed_with(&KernelTable::sphere_contact_forces, linear_slightly_wrong), Names{"sphere_contact_forces linear"});
  EXPECT_EQ(failed_with(&KernelTable::sphere_avoidance_trial, trial_that_counts_all), Names{"sphere_avoidance_trial moved"});
  EXPECT_EQ(failed_with(&KernelTable::sphere_avoidance_trial, trial_that_keeps_forces), Names{"sphere_avoidance_trial sum"});
  EXPECT_EQ(failed_with(&KernelTable::sphere_avoidance_trial, trial_slightly_too_far), Names{"sphere_avoidance_trial trial"});
  EXPECT_EQ(failed_with(&KernelTable::sphere_first_collision, collision_one_bit_late), Names{"sphere_first_collision"});
  EXPECT_EQ(failed_with(&KernelTable::sphere_first_collision, collision_without_the_last_neighbour),
            Names{"sphere_first_collision"});
  EXPECT_EQ(failed_with(&KernelTable::sphere_first_collision, collision_growing_slightly_less),
            Names{"sphere_first_collision growing"});
  EXPECT_EQ(failed_with(&KernelTable::calendar_update, calendar_late_in_one_lane), Names{"calendar_update"});
}

TEST(HardSphereChecks, DoNotPassWithoutASingleCase) {
  for (const Deviation& deviation : verify_hard_spheres(kernel_table(available_isas().back()), {}))
    EXPECT_EQ(deviation.passed(), deviation.kernel.starts_with("sphere_avoidance_trial")) << deviation.kernel;
}

}  // namespace
}  // namespace lanescape
