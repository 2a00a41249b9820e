#include "dynamics/fluid_state.hpp"

#include <algorithm>
#include <cstdint>

namespace lanescape {

void FluidState::add(int species, const Point& position, const Point& velocity) {
  configuration.species.push_back(species);
  configuration.positions.insert(configuration.positions.end(), position.begin(), position.end());
  velocities.insert(velocities.end(), velocity.begin(), velocity.end());
}

void FluidState::exchange(Archive& archive) {
  std::vector<std::uint64_t> species(configuration.species.begin(), configuration.species.end());
  std::vector<double> box(configuration.box.length.begin(), configuration.box.length.end());
  archive.field("box", box);
  archive.field("species", species);
  archive.field("positions", configuration.positions);
  archive.field("velocities", velocities);
  if (!archive.reading()) return;
  std::copy_n(box.begin(), 3, configuration.box.length.begin());
  configuration.species.assign(species.begin(), species.end());
}

}  // namespace lanescape
