#include <lanescape/neighbours.hpp>

#include "capi/arguments.hpp"
#include "capi/handles.hpp"

using namespace lanescape;
using namespace lanescape::capi;

struct lanescape_neighbours : Handle<NeighbourFinder> {};

namespace {

NeighbourFinder::Options options_of(const lanescape_neighbour_options* given) {
  const auto& o = sized(given, "options", "lanescape_neighbour_options");
  NeighbourFinder::Options options;
  if (o.cutoffs == nullptr) {
    options.cutoffs = {o.cutoff};
  } else {
    check_species(o.species);
    const auto cutoffs = array(o.cutoffs, o.species * o.species, "cutoffs");
    options.cutoffs.assign(cutoffs.begin(), cutoffs.end());
  }
  for (std::size_t axis = 0; axis < 3; ++axis) options.periodic[axis] = o.periodic[axis] != 0;
  options.origin = three(o.origin, "origin");
  options.members = o.half != 0 ? NeighbourFinder::Members::half : NeighbourFinder::Members::full;
  options.order = o.sorted != 0 ? NeighbourFinder::Order::sorted : NeighbourFinder::Order::any;
  options.quantities.S = o.shifts != 0;
  options.quantities.D = o.separations != 0;
  options.quantities.d = o.distances != 0;
  options.quantities.segments = o.segments != 0;
  options.threads = o.threads;
  options.instruction_set = word(o.instruction_set, options.instruction_set.c_str());
  return options;
}

void show(const NeighbourFinder::Pairs& found, lanescape_neighbour_pairs& out) {
  const auto start = [](auto numbers) { return numbers.empty() ? nullptr : numbers.data(); };
  out = {out.size,       found.count,    start(found.i), start(found.j),
         start(found.S), start(found.D), start(found.d), start(found.segments)};
}

}  // namespace

lanescape_status lanescape_neighbour_options_init(lanescape_neighbour_options* options, size_t size) {
  return guarded([&] {
    const NeighbourFinder::Options own;
    lanescape_neighbour_options presets{};
    for (std::size_t axis = 0; axis < 3; ++axis) presets.periodic[axis] = own.periodic[axis] ? 1 : 0;
    copy_out(own.origin, presets.origin);
    presets.half = own.members == NeighbourFinder::Members::half ? 1 : 0;
    presets.sorted = own.order == NeighbourFinder::Order::sorted ? 1 : 0;
    presets.shifts = own.quantities.S ? 1 : 0;
    presets.separations = own.quantities.D ? 1 : 0;
    presets.distances = own.quantities.d ? 1 : 0;
    presets.segments = own.quantities.segments ? 1 : 0;
    presets.threads = own.threads;
    initialise(options, size, "options", "lanescape_neighbour_options", presets);
  });
}

lanescape_status lanescape_neighbours_create(const lanescape_neighbour_options* options, lanescape_neighbours** neighbours) {
  return guarded([&] { create(neighbours, "neighbours", [&] { return NeighbourFinder(options_of(options)); }); });
}

lanescape_status lanescape_neighbours_exclude(lanescape_neighbours* neighbours, size_t pairs, const int64_t* particles) {
  return alone(neighbours, "neighbours", [&](NeighbourFinder& finder) {
    const auto indices = array(particles, times(2, pairs), "particles");
    std::vector<std::pair<std::int64_t, std::int64_t>> excluded(pairs);
    for (std::size_t k = 0; k < pairs; ++k) excluded[k] = {indices[2 * k], indices[2 * k + 1]};
    finder.exclude(excluded);
  });
}

lanescape_status lanescape_neighbours_find(lanescape_neighbours* neighbours, size_t particles, const double* positions,
                                           const double box[3], const int* species, lanescape_neighbour_pairs* pairs) {
  return alone(neighbours, "neighbours", [&](NeighbourFinder& finder) {
    auto& out = sized(pairs, "pairs", "lanescape_neighbour_pairs");
    show(finder.find(vectors(positions, particles, "positions"), three(box, "box"), optional_array(species, particles, "species")),
         out);
  });
}

lanescape_status lanescape_neighbours_set_particles(lanescape_neighbours* neighbours, size_t particles, const double* positions,
                                                    const double box[3], const int* species) {
  return alone(neighbours, "neighbours", [&](NeighbourFinder& finder) {
    finder.set_particles(vectors(positions, particles, "positions"), three(box, "box"),
                         optional_array(species, particles, "species"));
  });
}

lanescape_status lanescape_neighbours_of_points(lanescape_neighbours* neighbours, size_t points, const double* positions,
                                                const int* species, lanescape_neighbour_pairs* pairs) {
  return alone(neighbours, "neighbours", [&](NeighbourFinder& finder) {
    auto& out = sized(pairs, "pairs", "lanescape_neighbour_pairs");
    show(finder.neighbours(vectors(positions, points, "positions"), optional_array(species, points, "species")), out);
  });
}

lanescape_status lanescape_neighbours_destroy(lanescape_neighbours* neighbours) { return destroy(neighbours, "neighbours"); }
