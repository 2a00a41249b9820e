#include "observables/widom.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lanescape {

double widom_chemical_potential(const ProbeField& fluid, double temperature, std::uint64_t probes, const CounterRandom& random,
                                std::uint64_t step) {
  constexpr std::size_t batch = 4096;
  std::vector<double> positions, energies;
  double sum = 0.0;
  for (std::uint64_t done = 0; done < probes; done += energies.size()) {
    energies.resize(std::min<std::uint64_t>(batch, probes - done));
    positions.clear();
    for (std::size_t k = 0; k < energies.size(); ++k) {
      const auto point = random.uniform_point(step, static_cast<std::uint32_t>(done + k));
      for (std::size_t axis = 0; axis < 3; ++axis) positions.push_back(point[axis] * fluid.box().length[axis]);
    }
    fluid.energies(positions, energies);
    for (const double energy : energies) sum += std::exp(-energy / temperature);
  }
  return -temperature * std::log(sum / static_cast<double>(probes));
}

}  // namespace lanescape
