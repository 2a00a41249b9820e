// Energy, forces and neighbours of a Kob-Andersen crystal.

#include <cstdio>
#include <lanescape/lanescape.hpp>

int main() {
  const lanescape::Model model = lanescape::Model::named("kob-andersen");
  const lanescape::Start start = lanescape::make_start(model, 108, 1.2);
  lanescape::Potential potential(model, start.species, start.box);
  std::vector<double> forces(start.positions.size());
  try {
    const double energy = potential.energy_and_forces(start.positions, forces);
    std::printf("V = %.6f\n", energy);
  } catch (const lanescape::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }

  lanescape::NeighbourFinder finder({.cutoffs = {2.5}, .members = lanescape::NeighbourFinder::Members::half});
  const auto pairs = finder.find(start.positions, start.box);
  return pairs.count > 0 && pairs.i.size() == pairs.count ? 0 : 1;
}
