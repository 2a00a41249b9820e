#include <lanescape/lanescape.hpp>

#include <utility>

#include "dispatch/isa.hpp"
#include "neighbour/neighbour_pairs.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN

const char* version() noexcept { return LANESCAPE_VERSION; }

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const Isa isa : available_isas()) names.emplace_back(to_string(isa));
  return names;
}

NeighbourPairs neighbour_pairs(std::span<const double> positions, const std::array<double, 3>& box, double cutoff) {
  OrderedPairs pairs = ordered_pairs(Box{box}, positions, cutoff, kernel_table(choose_isa("auto")));
  return {.first = std::move(pairs.first),
          .second = std::move(pairs.second),
          .shift = std::move(pairs.shift),
          .separation = std::move(pairs.separation),
          .distance = std::move(pairs.distance)};
}

LANESCAPE_ABI_END
}  // namespace lanescape
