#include "neighbour/neighbour_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "core/error.hpp"
#include "neighbour/pair_finder.hpp"

namespace lanescape {
namespace {

template <class To, class From>
std::vector<std::array<To, 3>> triples(std::span<const From> numbers) {
  std::vector<std::array<To, 3>> out(numbers.size() / 3);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = {numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]};
  return out;
}

}  // namespace

OrderedPairs ordered_pairs(const Box& box, std::span<const double> positions, double cutoff, const kernels::KernelTable& table) {
  PairFinder finder({.cutoffs = {cutoff}}, table);
  finder.set_particles(positions, box.length, {});
  const FoundPairs found = finder.pairs();
  try {
    return {.first = {found.first.begin(), found.first.end()},
            .second = {found.second.begin(), found.second.end()},
            .shift = triples<int>(found.shifts),
            .separation = triples<double>(found.separations),
            .distance = {found.distances.begin(), found.distances.end()}};
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::internal,
                fmt::format("no memory for the {} pairs of {} particles within {}", found.count, positions.size() / 3, cutoff));
  }
}

}  // namespace lanescape
