#include "reference/hard_sphere.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hard_spheres.hpp"

namespace {

using namespace lanescape::reference;

TEST(ReferenceFictitiousForce, TheFictitiousForceIsMinusTheSlopeOfTheEnergy) {
  for (const FictitiousPotential potential : kPotentials)
    for (const double s : {0.5, 1.0, 1.4})
      for (const double x : {0.05, 0.3, 0.7, 0.98}) {
        const double h = 1e-4;
        const double slope = (fictitious_energy(potential, x * s + h, s) - fictitious_energy(potential, x * s - h, s)) / (2.0 * h);
        EXPECT_NEAR(fictitious_force(potential, x * s, s), -slope, 1e-7)
            << x << ' ' << s;  // the error is h^2 times the third derivative, 2
        EXPECT_GT(fictitious_force(potential, x * s, s), 0.0);
      }
}

TEST(ReferenceFictitiousForce, TheFictitiousEnergyVanishesFromContactOn) {
  for (const FictitiousPotential potential : kPotentials) {
    EXPECT_NEAR(fictitious_energy(potential, 1.4 * (1.0 - 1e-9), 1.4), 0.0, 1e-8);
    for (const double r : {1.4, 1.5}) {
      EXPECT_EQ(fictitious_energy(potential, r, 1.4), 0.0);
      EXPECT_EQ(fictitious_force(potential, r, 1.4), 0.0);
    }
  }
}

TEST(ReferenceFictitiousForce, TheFictitiousForcesAreMinusTheGradientOfTheSummedEnergy) {
  const Crowd system = crowd(60, 1);
  for (const FictitiousPotential potential : kPotentials) {
    const auto energy = [&](const Point& positions) {
      double sum = 0.0;
      for (const Overlap& pair : overlaps(positions, system.radii, kBox)) {
        const double s = system.radii[pair.i] + system.radii[pair.j];
        sum += fictitious_energy(potential, pair.gap + s, s);
      }
      return sum;
    };
    const Point forces = fictitious_forces(system.positions, system.radii, kBox, potential);
    ASSERT_GT(std::count_if(forces.begin(), forces.end(), [](double f) { return f != 0.0; }), 12);
    for (std::size_t k = 0; k < forces.size(); ++k) {
      Point up = system.positions;
      Point down = system.positions;
      up[k] += 1e-5;
      down[k] -= 1e-5;
      EXPECT_NEAR(forces[k], -(energy(up) - energy(down)) / 2e-5, 1e-8) << k;
    }
  }
}

TEST(ReferenceFictitiousForce, CoincidentCentresFeelNoForce) {
  for (const FictitiousPotential potential : kPotentials)
    EXPECT_EQ(fictitious_forces(Point{1.0, 1.0, 1.0, 1.0, 1.0, 11.0 + 4.0}, Point{0.5, 0.5}, kBox, potential), Point(6, 0.0));
}

}  // namespace
