#include <lanescape/neighbours.hpp>

#include "dispatch/isa.hpp"
#include "neighbour/neighbour_pairs.hpp"
#include "neighbour/pair_finder.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN
namespace {

PairFinderOptions internal(const NeighbourFinder::Options& options) {
  const NeighbourFinder::Quantities& wanted = options.quantities;
  return {.cutoffs = options.cutoffs,
          .periodic = options.periodic,
          .origin = options.origin,
          .half = options.members == NeighbourFinder::Members::half,
          .sorted = options.order == NeighbourFinder::Order::sorted,
          .first = wanted.i,
          .second = wanted.j,
          .shifts = wanted.S,
          .separations = wanted.D,
          .distances = wanted.d,
          .segments = wanted.segments,
          .threads = options.threads};
}

NeighbourFinder::Pairs views(const FoundPairs& found) {
  return {.count = found.count,
          .i = found.first,
          .j = found.second,
          .S = found.shifts,
          .D = found.separations,
          .d = found.distances,
          .segments = found.segments};
}

}  // namespace

struct NeighbourFinder::Implementation {
  PairFinder finder;
};

NeighbourFinder::NeighbourFinder(const Options& options)
    : implementation_(std::make_unique<Implementation>(
          Implementation{PairFinder(internal(options), kernel_table(choose_isa(options.instruction_set)))})) {}
NeighbourFinder::~NeighbourFinder() = default;
NeighbourFinder::NeighbourFinder(NeighbourFinder&&) noexcept = default;
NeighbourFinder& NeighbourFinder::operator=(NeighbourFinder&&) noexcept = default;

void NeighbourFinder::exclude(std::span<const std::pair<std::int64_t, std::int64_t>> pairs) {
  implementation_->finder.exclude(pairs);
}

void NeighbourFinder::set_particles(std::span<const double> positions, const std::array<double, 3>& box,
                                    std::span<const std::int32_t> species) {
  implementation_->finder.set_particles(positions, box, species);
}

NeighbourFinder::Pairs NeighbourFinder::find(std::span<const double> positions, const std::array<double, 3>& box,
                                             std::span<const std::int32_t> species) {
  set_particles(positions, box, species);
  return views(implementation_->finder.pairs());
}

NeighbourFinder::Pairs NeighbourFinder::neighbours(std::span<const double> points, std::span<const std::int32_t> species) {
  return views(implementation_->finder.neighbours(points, species));
}

NeighbourFinder::Pairs NeighbourFinder::neighbours(const std::array<double, 3>& point, std::int32_t species) {
  return neighbours(std::span<const double>(point), std::span<const std::int32_t>(&species, 1));
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
