// Two particles 1.5 sigma apart, evaluated with the installed library and by hand.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <lanescape/lanescape.hpp>
#include <string>
#include <vector>

namespace {

bool close(double a, double b) { return std::abs(a - b) <= 1e-13 * std::abs(b); }

bool gives_the_pair_potential(const std::string& isa) {
  const lanescape::Model model = lanescape::Model::named("lennard-jones", {.truncation = "plain"});
  const std::vector<int> species = {0, 0};
  const std::vector<double> positions = {9.5, 1.0, 2.0, 1.0, 1.0, 2.0};  // across a face of the box
  std::vector<double> forces(positions.size());
  double virial = 0.0;
  lanescape::Potential potential(model, species, {10.0, 10.0, 10.0}, {.instruction_set = isa});
  const double energy = potential.energy_and_forces(positions, forces, &virial);

  const double sixth = std::pow(1.5, -6.0);
  const double attraction = 24.0 * (2.0 * sixth - 1.0) * sixth / 1.5;  // -u'(r), negative here
  return close(energy, 4.0 * (sixth - 1.0) * sixth) && energy == potential.energy(positions) && close(virial, 1.5 * attraction) &&
         close(forces[0], -attraction) && close(forces[3], attraction) && forces[1] == 0.0 && forces[5] == 0.0;
}

// The two particles above are neighbours across the face: each is in the other's list.
bool finds_the_pair() {
  const lanescape::NeighbourPairs pairs =
      lanescape::neighbour_pairs(std::vector<double>{9.5, 1.0, 2.0, 1.0, 1.0, 2.0}, {10.0, 10.0, 10.0}, 2.5);
  using Shifts = std::vector<std::array<int, 3>>;
  return pairs.first == std::vector<std::size_t>{0, 1} && pairs.second == std::vector<std::size_t>{1, 0} &&
         pairs.shift == Shifts{{1, 0, 0}, {-1, 0, 0}} && pairs.separation[0] == std::array<double, 3>{1.5, 0.0, 0.0} &&
         pairs.distance == std::vector<double>{1.5, 1.5};
}

bool refuses_what_it_does_not_know() {
  try {
    lanescape::Potential potential(lanescape::Model::named("lennard-jones"), std::vector<int>{0}, {10.0, 10.0, 10.0},
                                   {.instruction_set = "abacus"});
  } catch (const lanescape::Error& error) {
    return error.code() == lanescape::ErrorCode::bad_input && std::string(error.what()).find("abacus") != std::string::npos;
  }
  return false;
}

}  // namespace

int main() {
  bool good = std::string(lanescape::version()) == LANESCAPE_VERSION && refuses_what_it_does_not_know() && finds_the_pair();
  for (const std::string& isa : lanescape::instruction_sets()) good = gives_the_pair_potential(isa) && good;
  std::printf("lanescape %s\n", lanescape::version());
  return good ? 0 : 1;
}
