// Random hard spheres on every instruction set and with every search against the scalar reference, whose decisions are part of the
// definition: pairs, counts and the smallest gap are equal to the bit (support/random_run.hpp: how many systems).

#include "random_spheres.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <utility>

#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "interaction/sphere/gap_list.hpp"
#include "interaction/sphere/hard_sphere_list.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"
#include "random_run.hpp"
#include "reference/hard_sphere.hpp"
#include "reference/images.hpp"
#include "verification/check.hpp"

namespace lanescape {
namespace {

using testing::Outcome;
// Pairs of particles in the user's order, sorted.
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

struct Slots {
  ParticleLayout layout;
  std::vector<std::size_t> particle_of;

  explicit Slots(const testing::RandomSpheres& made)
      : layout(made.configuration.species, made.species), particle_of(layout.slots(), made.configuration.size()) {
    for (std::size_t i = 0; i < layout.size(); ++i) particle_of[layout.slot_of(i)] = i;
  }
  std::pair<std::size_t, std::size_t> pair(std::int32_t first, std::int32_t second) const {
    const std::size_t i = particle_of[static_cast<std::size_t>(first)], j = particle_of[static_cast<std::size_t>(second)];
    return {std::min(i, j), std::max(i, j)};
  }
  template <class Found>
  Pairs pairs(const Found& found, std::size_t count) const {
    Pairs pairs;
    for (std::size_t k = 0; k < count; ++k) pairs.push_back(pair(found[k].first, found[k].second));
    std::ranges::sort(pairs);
    return pairs;
  }
};

Pairs overlaps_of(const Configuration& c) {
  Pairs pairs;
  for (const auto& overlap : reference::overlaps(c.positions, c.radii, c.box.length)) pairs.emplace_back(overlap.i, overlap.j);
  return pairs;
}

// Images of pairs with gaps below a reach, sorted.
using Gaps = std::vector<std::pair<std::pair<std::size_t, std::size_t>, double>>;

Gaps gaps_below(const Configuration& c, double reach) {
  Gaps gaps;
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = i + 1; j < c.size(); ++j) {
      const double s = c.radii[i] + c.radii[j];
      reference::for_each_image(difference(c.position(j), c.position(i)), c.box.length, c.box.periodic, s + reach,
                                reference::ImageRule::all, [&](const reference::Image& image) {
                                  const double gap = std::sqrt(reference::dot(image.separation, image.separation)) - s;
                                  if (gap < reach) gaps.push_back({{i, j}, gap});
                                });
    }
  std::ranges::sort(gaps);
  return gaps;
}

// What the reference says of a system, and of the same while its spheres move, in the end anywhere.
struct Expected {
  Pairs within;
  double smallest_gap, diameter, rounding;  // of gaps
  std::vector<std::vector<double>> moved;
  std::vector<Pairs> overlaps;
  Gaps gaps;  // some beyond gap_reach()

  explicit Expected(const testing::RandomSpheres& made, std::uint64_t number)
      : within(reference::pairs_within(made.configuration.positions, made.configuration.radii, made.configuration.box.length,
                                       made.reach)),
        smallest_gap(
            reference::smallest_gap(made.configuration.positions, made.configuration.radii, made.configuration.box.length)),
        diameter(2.0 * *std::ranges::max_element(made.configuration.radii)),
        rounding(8.0 * 0x1p-53 * testing::largest_coordinate(made.configuration)),
        gaps(gaps_below(made.configuration, gap_reach() + rounding)) {
    Configuration c = made.configuration;
    std::mt19937_64 generator(number);
    for (const double step : {0.0, 1e-3, 0.1, 0.29, 0.29, 3.0}) {
      std::uniform_real_distribution<double> move(-step * 0.3 * diameter, step * 0.3 * diameter);
      if (step > 0.0)
        for (double& x : c.positions) x += move(generator);
      moved.push_back(c.positions);
      overlaps.push_back(overlaps_of(c));
    }
  }
  double gap_reach() const { return 0.3 * diameter; }
};

// What is wrong with a search; empty if nothing is.
std::string fault(const testing::RandomSpheres& made, const Slots& slots, const Expected& expected, Isa isa,
                  SpherePairSearch search) {
  const Configuration& c = made.configuration;
  const AlignedArray positions = slots.layout.to_slots(c.positions);
  HardSphereOverlap spheres(c.box, slots.layout, c.radii, kernel_table(isa), search);
  if (spheres.any_overlap(positions) == expected.overlaps[0].empty()) return "any overlap";
  if (!same_bits(spheres.smallest_gap(positions), expected.smallest_gap)) return "smallest gap";
  const auto& overlaps = spheres.pairs_within(positions, 0.0);
  if (slots.pairs(overlaps, overlaps.size()) != expected.overlaps[0]) return "overlapping pairs";
  const auto& within = spheres.pairs_within(positions, made.reach);
  if (slots.pairs(within, within.size()) != expected.within) return "pairs within a reach";
  return "";
}

// A list is made once and used while the spheres move.
std::string list_fault(const testing::RandomSpheres& made, const Slots& slots, const Expected& expected, Isa isa, double skin) {
  HardSphereOverlap spheres(made.configuration.box, slots.layout, made.configuration.radii, kernel_table(isa));
  HardSphereList list(spheres, skin);
  for (std::size_t step = 0; step < expected.moved.size(); ++step) {
    const AlignedArray positions = slots.layout.to_slots(expected.moved[step]);
    if (list.any_overlap(positions) == expected.overlaps[step].empty()) return fmt::format("any overlap of a list, step {}", step);
    const ContactPairs found = list.find_contacts(positions);
    if (slots.pairs(found, found.count) != expected.overlaps[step]) return fmt::format("contacts of a list, step {}", step);
  }
  return "";
}

// Every gap of `some` has one of the same pair in `all` that differs by rounding.
bool are_among(const Gaps& some, const Gaps& all, double rounding) {
  return std::ranges::all_of(some, [&](const auto& gap) {
    auto other = std::ranges::lower_bound(all, std::pair(gap.first, gap.second - rounding));
    return other != all.end() && other->first == gap.first && std::abs(other->second - gap.second) <= rounding;
  });
}

// All gaps are there; rounding may put one on either side of the reach.
std::string gap_fault(const testing::RandomSpheres& made, const Slots& slots, const Expected& expected, Isa isa) {
  HardSphereOverlap spheres(made.configuration.box, slots.layout, made.configuration.radii, kernel_table(isa));
  GapList list(spheres, expected.gap_reach(), 0.1 * expected.diameter);
  const double surely = list.reach() - expected.rounding;
  Gaps found, found_within, wanted;
  for (const PairGap& gap : list.at(slots.layout.to_slots(made.configuration.positions))) {
    found.push_back({slots.pair(gap.first, gap.second), gap.gap});
    if (gap.gap < surely) found_within.push_back(found.back());
  }
  std::ranges::sort(found);
  std::ranges::copy_if(expected.gaps, std::back_inserter(wanted), [&](const auto& gap) { return gap.second < surely; });
  if (!are_among(wanted, found, expected.rounding)) return "a gap is missing";
  return are_among(found_within, expected.gaps, expected.rounding) ? "" : "a gap of no pair";
}

std::string describe(const testing::RandomSpheres& made) {
  const Configuration& c = made.configuration;
  const double diameter = 2.0 * *std::ranges::max_element(c.radii);
  return fmt::format("N={}, {} species, box {} {} {} of the largest diameter {}, reach {}, largest coordinate {}", c.size(),
                     made.species, c.box.length[0] / diameter, c.box.length[1] / diameter, c.box.length[2] / diameter, diameter,
                     made.reach / diameter, testing::largest_coordinate(c) / diameter);
}

TEST(RandomSpheres, HaveThePairsAndGapsOfTheReference) {
  testing::RandomRun(3.0).for_each("systems of hard spheres", [](std::uint64_t number, auto add) {
    const testing::RandomSpheres made = testing::RandomSphereSystems(number).make();
    if (!made.box_holds_spheres) return add(Outcome::refused);  // by whoever makes one: check_box_holds_spheres()
    const Slots slots(made);
    const Expected expected(made, number);
    for (const Isa isa : available_isas()) {
      std::string wrong = list_fault(made, slots, expected, isa, number % 3 == 0 ? 0.0 : 0.3 * expected.diameter);
      for (const auto search : {SpherePairSearch::by_size, SpherePairSearch::all_pairs, SpherePairSearch::cells})
        if (wrong.empty()) wrong = fault(made, slots, expected, isa, search);
      if (wrong.empty()) wrong = gap_fault(made, slots, expected, isa);
      if (!wrong.empty()) ADD_FAILURE() << fmt::format("spheres {} on {}: {}: {}", number, to_string(isa), describe(made), wrong);
      add(wrong.empty() ? Outcome::right : Outcome::wrong);
    }
  });
}

}  // namespace
}  // namespace lanescape
