#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "reference/pair_sum.hpp"
#include "stored_data.hpp"

namespace {

using namespace lanescape::reference;

PairForm form_of(const nlohmann::json& stored, double epsilon, double sigma) {
  const std::string name = stored["form"];
  if (name == "lennard_jones") return LennardJones{epsilon, sigma};
  if (name == "mie") return Mie{epsilon, sigma, stored["n"], stored["m"]};
  if (name == "inverse_power") return InversePower{epsilon, sigma, stored["n"]};
  if (name == "yukawa") return Yukawa{epsilon, sigma, stored["kappa"]};
  if (name == "harmonic") return Harmonic{epsilon, sigma};
  if (name == "hertzian") return Hertzian{epsilon, sigma};
  throw std::invalid_argument("no such form: " + name);
}

PairMixture mixture_of(const nlohmann::json& stored) {
  const std::map<std::string, Truncation> truncations{{"plain", Truncation::plain},
                                                      {"shifted", Truncation::shifted},
                                                      {"tail", Truncation::tail},
                                                      {"shifted_force", Truncation::shifted_force}};
  PairMixture mixture{2, {}};
  for (const std::size_t ab : {0, 1, 1, 2}) {
    const nlohmann::json& pair = stored["pairs"][ab];
    mixture.potentials.push_back({form_of(stored, pair[0], pair[1]), pair[2], truncations.at(stored["truncation"])});
  }
  return mixture;
}

/// LAMMPS evaluates the same formulas in double precision and another order, so only rounding differs: about 1e-16 of the absolute
/// terms, times the exponent. Its images are sums of positions and box edges, which adds 1e-16 L to a distance. The worst deviation
/// is 5e-15, of forces of r^-24.
constexpr double tolerance = 2e-14;

void expect_results_of_lammps(const nlohmann::json& stored) {
  const System system = read_configuration(stored["configuration"]);
  const Evaluation result = pair_sum(system.particles(), mixture_of(stored), ImageRule::all);
  ASSERT_GT(result.magnitude, 0.0);
  EXPECT_NEAR(result.energy, stored.value("energy", result.energy), tolerance * result.magnitude);  // none for soft spheres
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(result.virial_tensor[k], stored["virial"][k], tolerance * result.virial_magnitude) << k;
  ASSERT_EQ(result.gradient.size(), stored["forces"].size());
  const double scale = largest(result.gradient_magnitude);
  for (std::size_t k = 0; k < result.gradient.size(); ++k)
    EXPECT_NEAR(-result.gradient[k], stored["forces"][k], tolerance * scale) << k;
}

TEST(ReferenceAgainstLammps, EveryPotentialThatLammpsHasGivesItsEnergyForcesAndVirial) {
  const nlohmann::json stored = read_json("lammps_pairs.json");
  ASSERT_GE(stored["cases"].size(), 45u);
  for (const nlohmann::json& one : stored["cases"]) {
    SCOPED_TRACE(one["form"].dump() + " " + one["truncation"].dump() + " " + one["commands"][0].dump() + " " +
                 one["configuration"].dump());
    expect_results_of_lammps(one);
  }
}

}  // namespace
