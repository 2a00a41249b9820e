#include "verification/neighbour_checks.hpp"

#include <algorithm>
#include <tuple>

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
  PairFinder finder({.cutoffs = {cutoff}, .sorted = sorted}, table);
  finder.set_particles(one.configuration.positions, one.configuration.box.length, {});
  std::vector<NeighbourPair> pairs = in_one_list(finder.pairs());
  if (!sorted) std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return key(a) < key(b); });
  return pairs;
}

}  // namespace

std::vector<Deviation> verify_neighbour_pairs(const kernels::KernelTable& table, const std::vector<PairCase>& cases) {
  Check any(table, "points_within_group: pairs", tolerance::exact), sorted(table, "sort_few: sorted pairs", tolerance::exact);
  for (const PairCase& one : cases) {
    // Other truncations and image rules have the same configurations.
    if (one.model.truncation != Truncation::shifted || one.model.images != ImageRule::all) continue;
    const double cutoff = one.model.largest_cutoff();
    if (cutoff > max_boxes_in_cutoff * one.configuration.box.shortest()) continue;
    const auto expected = reference::neighbour_pairs(one.configuration.positions, one.configuration.box.length, cutoff);
    any.add(one.name, wrong_entries(find(one, cutoff, false, table), expected));
    sorted.add(one.name, wrong_entries(find(one, cutoff, true, table), expected));
  }
  return {any.deviation, sorted.deviation};
}

}  // namespace lanescape
