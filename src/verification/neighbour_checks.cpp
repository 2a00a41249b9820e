#include "verification/neighbour_checks.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

#include "neighbour/neighbour_list.hpp"
#include "neighbour/neighbour_rows.hpp"
#include "neighbour/pair_finder.hpp"
#include "reference/neighbours.hpp"
#include "verification/check.hpp"

namespace lanescape {
namespace {

using reference::NeighbourPair;

auto key(const NeighbourPair& pair) { return std::tuple(pair.first, pair.second, pair.shift); }

std::vector<NeighbourPair> in_one_list(const FoundPairs& found) {
  std::vector<NeighbourPair> pairs;
  for (std::size_t k = 0; k < found.count; ++k)
    pairs.push_back({static_cast<std::size_t>(found.first[k]),
                     static_cast<std::size_t>(found.second[k]),
                     {found.shifts[3 * k], found.shifts[3 * k + 1], found.shifts[3 * k + 2]},
                     point_at(found.separations.data(), k),
                     found.distances[k]});
  return pairs;
}

double wrong_entries(const std::vector<NeighbourPair>& found, const std::vector<NeighbourPair>& expected) {
  if (found.size() != expected.size()) return static_cast<double>(std::max(found.size(), expected.size()));
  double wrong = 0.0;
  for (std::size_t k = 0; k < found.size(); ++k)
    wrong += key(found[k]) != key(expected[k]) || found[k].separation != expected[k].separation ||
             found[k].distance != expected[k].distance;
  return wrong;
}

std::vector<NeighbourPair> find(const PairCase& one, double cutoff, bool sorted, const kernels::KernelTable& table) {
  PairFinder finder({.cutoffs = {cutoff}, .periodic = one.configuration.box.periodic, .sorted = sorted}, table);
  finder.set_particles(one.configuration.positions, one.configuration.box.length, {});
  std::vector<NeighbourPair> pairs = in_one_list(finder.pairs());
  if (!sorted) std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return key(a) < key(b); });
  return pairs;
}

// Particles of a pair and its distance, rounded.
using Listed = std::tuple<std::size_t, std::size_t, long>;

// Lists may hold pairs just beyond the cutoff: nearer ones are compared.
void add_listed(std::vector<Listed>& pairs, std::size_t first, std::size_t second, double distance, double cutoff) {
  if (distance < (1.0 - 1e-9) * cutoff) pairs.emplace_back(first, second, std::lround(1e6 * distance / cutoff));
}

std::vector<Listed> in_neighbour_list(const PairCase& one, double cutoff, const kernels::KernelTable& table) {
  const ParticleLayout layout(one.configuration.species, one.model.species.size());
  const std::vector<double> cutoffs(one.model.species.size() * one.model.species.size(), cutoff);
  NeighbourList list(one.configuration.box, layout, cutoffs, 0.0, table, 1, NeighbourList::Coordinates::floating,
                     NeighbourList::Members::with_own_images);
  list.update(layout.to_slots(one.configuration.positions));
  std::vector<std::size_t> particle_in(layout.slots());
  for (std::size_t i = 0; i < layout.size(); ++i) particle_in[layout.slot_of(i)] = i;
  std::vector<Listed> pairs;
  for (std::size_t b = 0; b < list.block_count(); ++b) {
    const kernels::NeighbourRows rows = list.rows_of(b);
    for_each_neighbour(rows, [&](std::size_t row, std::size_t, std::uint32_t offset) {
      const double *from = rows.points + rows.rows[row], *to = rows.points + offset;
      add_listed(pairs, particle_in[list.slot_at(rows.rows[row])], particle_in[list.slot_at(offset)],
                 std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]), cutoff);
    });
  }
  return pairs;
}

double wrong_in_list(const PairCase& one, double cutoff, const std::vector<NeighbourPair>& expected,
                     const kernels::KernelTable& table) {
  std::vector<Listed> found = in_neighbour_list(one, cutoff, table), wanted, wrong;
  for (const NeighbourPair& pair : expected) add_listed(wanted, pair.first, pair.second, pair.distance, cutoff);
  std::sort(found.begin(), found.end());
  std::sort(wanted.begin(), wanted.end());
  std::set_symmetric_difference(found.begin(), found.end(), wanted.begin(), wanted.end(), std::back_inserter(wrong));
  return static_cast<double>(wrong.size());
}

}  // namespace

std::vector<Deviation> verify_neighbour_pairs(const kernels::KernelTable& table, const std::vector<PairCase>& cases) {
  Check any(table, "points_within_group: pairs", tolerance::exact), sorted(table, "sort_few: sorted pairs", tolerance::exact),
      lists(table, "list_group: lists", tolerance::exact);
  const auto add = [&](const PairCase& one) {
    const Box& box = one.configuration.box;
    const double cutoff = one.model.largest_cutoff();
    if (cutoff > max_boxes_in_cutoff * box.shortest()) return;
    const auto expected = reference::neighbour_pairs(one.configuration.positions, box.length, cutoff, box.periodic);
    any.add(one.name, wrong_entries(find(one, cutoff, false, table), expected));
    sorted.add(one.name, wrong_entries(find(one, cutoff, true, table), expected));
    lists.add(one.name, wrong_in_list(one, cutoff, expected, table));
  };
  // Other truncations and image rules have the same configurations.
  for (const PairCase& one : cases)
    if (one.model.truncation == Truncation::shifted && one.model.images == ImageRule::all) add(one);
  for (const PairCase& one : open_cases(lennard_jones_form())) add(one);
  return {any.deviation, sorted.deviation, lists.deviation};
}

}  // namespace lanescape
