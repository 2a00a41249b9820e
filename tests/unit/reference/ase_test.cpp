#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "reference/lennard_jones.hpp"
#include "stored_data.hpp"

namespace {

using namespace lanescape::reference;

TEST(ReferenceAgainstAse, EveryOneComponentConfigurationHasTheEnergyForcesAndVirialOfAse) {
  const nlohmann::json ase = read_json("ase_lennard_jones.json");
  ASSERT_GE(ase.size(), 9u);
  const Mixture argon{1, {1.0}, {1.0}, {2.5}};
  for (const auto& [name, expected] : ase.items()) {
    SCOPED_TRACE(name);
    const System c = read_configuration(name);
    const Evaluation result = lennard_jones(c.positions, c.species, c.box, argon, ImageRule::all, Truncation::shifted);

    const double energy = expected["energy"];
    EXPECT_NEAR(result.energy, energy, 1e-10 * std::abs(energy));

    const std::vector<std::vector<double>> forces = expected["forces"];
    ASSERT_EQ(3 * forces.size(), result.gradient.size());
    double largest_force = 0.0;
    for (const auto& force : forces) largest_force = std::max(largest_force, largest(force));
    // On a perfect lattice the forces cancel and only rounding is left, hence the second term.
    const double tolerance = 1e-10 * largest_force + 1e-14 * largest(result.gradient_magnitude);
    for (std::size_t k = 0; k < result.gradient.size(); ++k)
      EXPECT_NEAR(-result.gradient[k], forces[k / 3][k % 3], tolerance) << "component " << k;

    const std::vector<double> virial = expected["virial"];
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(result.virial_tensor[k], virial[k], 1e-11 * result.magnitude) << k;
  }
}

}  // namespace
