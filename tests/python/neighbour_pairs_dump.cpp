// Neighbour pairs through the public facade, for neighbour_pairs_test.py. Reads numbers from stdin (edges of the box, cutoff,
// coordinates) and writes a row `i j Sx Sy Sz Dx Dy Dz d` per pair, with all digits.

#include <array>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <iostream>
#include <lanescape/lanescape.hpp>
#include <vector>

int main() {
  std::array<double, 3> box{};
  double cutoff = 0.0;
  if (!(std::cin >> box[0] >> box[1] >> box[2] >> cutoff)) return 2;
  std::vector<double> positions;
  for (double x = 0.0; std::cin >> x;) positions.push_back(x);
  try {
    const lanescape::NeighbourPairs pairs = lanescape::neighbour_pairs(positions, box, cutoff);
    for (std::size_t k = 0; k < pairs.first.size(); ++k) {
      const auto& [sx, sy, sz] = pairs.shift[k];
      const auto& [dx, dy, dz] = pairs.separation[k];
      std::printf("%zu %zu %d %d %d %.17g %.17g %.17g %.17g\n", pairs.first[k], pairs.second[k], sx, sy, sz, dx, dy, dz,
                  pairs.distance[k]);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
