#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "reference/lennard_jones.hpp"

namespace {

using namespace lanescape::reference;

struct Configuration {
  std::vector<double> positions;
  std::vector<int> species;
  std::array<double, 3> box;
};

std::string data_file(const std::string& name) { return std::string(LANESCAPE_TEST_DATA_DIR) + "/" + name; }

/// Reads what tools/make_configurations.py writes, and nothing else.
Configuration read(const std::string& name) {
  std::ifstream file(data_file(name));
  std::size_t count = 0;
  std::string comment;
  file >> count;
  std::getline(file, comment);
  std::getline(file, comment);
  Configuration result;
  if (!file || std::sscanf(comment.c_str(), "Lattice=\"%lf 0.0 0.0 0.0 %lf 0.0 0.0 0.0 %lf\"", &result.box[0],
                           &result.box[1], &result.box[2]) != 3)
    throw std::runtime_error(data_file(name) + ": not as expected");
  std::string symbol;
  for (double x, y, z; file >> symbol >> x >> y >> z;) {
    result.positions.insert(result.positions.end(), {x, y, z});
    result.species.push_back(symbol == "P" ? 1 : 0);
  }
  if (result.species.size() != count) throw std::runtime_error(data_file(name) + ": wrong number of particles");
  return result;
}

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

TEST(ReferenceAgainstAse, EveryOneComponentConfigurationHasTheEnergyForcesAndVirialOfAse) {
  nlohmann::json ase;
  std::ifstream(data_file("ase_lennard_jones.json")) >> ase;
  ASSERT_GE(ase.size(), 9u);
  const Mixture argon{1, {1.0}, {1.0}, {2.5}};
  for (const auto& [name, expected] : ase.items()) {
    SCOPED_TRACE(name);
    const Configuration c = read(name);
    const Evaluation result =
        lennard_jones(c.positions, c.species, c.box, argon, ImageRule::all, Truncation::shifted);

    const double energy = expected["energy"];
    EXPECT_NEAR(result.energy, energy, 1e-10 * std::abs(energy));

    const std::vector<std::vector<double>> forces = expected["forces"];
    ASSERT_EQ(3 * forces.size(), result.gradient.size());
    double largest_force = 0.0;
    for (const auto& force : forces) largest_force = std::max(largest_force, largest(force));
    // On a perfect lattice the forces cancel and only rounding is left to compare, hence the second term.
    const double tolerance = 1e-10 * largest_force + 1e-14 * largest(result.gradient_magnitude);
    for (std::size_t k = 0; k < result.gradient.size(); ++k)
      EXPECT_NEAR(-result.gradient[k], forces[k / 3][k % 3], tolerance) << "component " << k;

    const std::vector<double> virial = expected["virial"];
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(result.virial_tensor[k], virial[k], 1e-11 * result.magnitude) << k;
  }
}

}  // namespace
