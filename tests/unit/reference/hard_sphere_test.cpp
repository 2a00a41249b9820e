#include "reference/hard_sphere.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

namespace {

using namespace lanescape::reference;

using Point = std::vector<double>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Vector kBox{10.0, 12.0, 14.0};
constexpr std::array kPotentials{FictitiousPotential::harmonic, FictitiousPotential::linear, FictitiousPotential::cubic};

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// n spheres of two sizes anywhere, also outside the box, many of them overlapping
struct Crowd {
  Point positions;
  std::vector<double> radii;
};
Crowd crowd(std::size_t n, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> coordinate(-20.0, 20.0);
  Crowd result;
  for (std::size_t k = 0; k < 3 * n; ++k) result.positions.push_back(coordinate(engine));
  for (std::size_t j = 0; j < n; ++j) result.radii.push_back(j % 2 == 0 ? 0.5 : 0.7);
  return result;
}

TEST(ReferenceHardSphere, TouchingSpheresDoNotOverlap) {
  const std::vector<double> radii{0.5, 0.75};
  EXPECT_FALSE(any_overlap(Point{0.0, 0.0, 0.0, 1.25, 0.0, 0.0}, radii, kBox));
  EXPECT_EQ(smallest_gap(Point{0.0, 0.0, 0.0, 1.25, 0.0, 0.0}, radii, kBox), 0.0);
  EXPECT_TRUE(any_overlap(Point{0.0, 0.0, 0.0, std::nextafter(1.25, 0.0), 0.0, 0.0}, radii, kBox));
}

TEST(ReferenceHardSphere, SpheresOverlapAcrossTheBoundary) {
  const std::vector<double> radii{0.5, 0.75};
  const auto found = overlaps(Point{0.25, 3.0, 13.75, 9.5, 3.0, 0.25}, radii, kBox);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].separation, (Vector{-0.75, 0.0, 0.5}));
  EXPECT_DOUBLE_EQ(found[0].gap, std::sqrt(0.8125) - 1.25);
}

TEST(ReferenceHardSphere, UnwrappedPositionsOverlapLikeWrappedOnes) {
  const std::vector<double> radii{0.5, 0.75};
  EXPECT_TRUE(any_overlap(Point{30.0, -24.0, 0.0, 1.0, 0.0, 42.0}, radii, kBox));
  EXPECT_FALSE(any_overlap(Point{30.0, -24.0, 0.0, 1.25, 0.0, 42.0}, radii, kBox));
}

TEST(ReferenceHardSphere, OverlapsAreListedInTheOrderOfTheirParticlesAndPointFromFirstToSecond) {
  const std::vector<double> radii(4, 0.5);
  const auto found = overlaps(Point{0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 0.75, 0.0}, radii, kBox);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(Pairs({{found[0].i, found[0].j}, {found[1].i, found[1].j}, {found[2].i, found[2].j}}), Pairs({{0, 1}, {0, 3}, {1, 3}}));
  EXPECT_EQ(found[0].separation, (Vector{0.5, 0.0, 0.0}));
  EXPECT_EQ(found[0].gap, -0.5);
  EXPECT_EQ(found[1].gap, -0.25);
  EXPECT_EQ(found[2].separation, (Vector{-0.5, 0.75, 0.0}));
}

TEST(ReferenceHardSphere, OverlapsAreThePairsThatTouchSomeImage) {
  const Crowd system = crowd(60, 1);
  Pairs expected;
  double smallest = kInfinity;
  for (std::size_t i = 0; i < 60; ++i)
    for (std::size_t j = i + 1; j < 60; ++j) {
      double nearest = kInfinity;
      for (int x = -5; x <= 5; ++x)
        for (int y = -5; y <= 5; ++y)
          for (int z = -5; z <= 5; ++z)
            nearest = std::min(nearest, std::hypot(system.positions[3 * j] - system.positions[3 * i] + x * kBox[0],
                                                   system.positions[3 * j + 1] - system.positions[3 * i + 1] + y * kBox[1],
                                                   system.positions[3 * j + 2] - system.positions[3 * i + 2] + z * kBox[2]));
      smallest = std::min(smallest, nearest - system.radii[i] - system.radii[j]);
      if (nearest < system.radii[i] + system.radii[j]) expected.emplace_back(i, j);
    }
  Pairs found;
  for (const Overlap& pair : overlaps(system.positions, system.radii, kBox)) found.emplace_back(pair.i, pair.j);
  ASSERT_GT(expected.size(), 3u);
  EXPECT_EQ(found, expected);
  EXPECT_NEAR(smallest_gap(system.positions, system.radii, kBox), smallest, 1e-13);
}

TEST(ReferenceHardSphere, FewerThanTwoSpheresHaveNoGapAndNoOverlap) {
  EXPECT_EQ(smallest_gap(Point{}, Point{}, kBox), kInfinity);
  EXPECT_EQ(smallest_gap(Point{1.0, 2.0, 3.0}, Point{0.5}, kBox), kInfinity);
  EXPECT_FALSE(any_overlap(Point{1.0, 2.0, 3.0}, Point{0.5}, kBox));
}

TEST(ReferenceHardSphere, PairsWithinNoReachAreTheOverlapsAndWithinReachTheGapsBelowIt) {
  const Crowd system = crowd(40, 2);
  Pairs touching;
  for (const Overlap& pair : overlaps(system.positions, system.radii, kBox)) touching.emplace_back(pair.i, pair.j);
  EXPECT_EQ(pairs_within(system.positions, system.radii, kBox, 0.0), touching);
  EXPECT_GT(pairs_within(system.positions, system.radii, kBox, 0.5).size(), touching.size());
  const Point apart{0.0, 0.0, 0.0, 1.5, 0.0, 0.0};
  EXPECT_TRUE(pairs_within(apart, Point{0.5, 0.5}, kBox, 0.5).empty());
  EXPECT_EQ(pairs_within(apart, Point{0.5, 0.5}, kBox, 0.5 + 1e-15), (Pairs{{0, 1}}));
}

TEST(ReferenceHardSphere, TheFictitiousForceIsMinusTheSlopeOfTheEnergy) {
  for (const FictitiousPotential potential : kPotentials)
    for (const double s : {0.5, 1.0, 1.4})
      for (const double x : {0.05, 0.3, 0.7, 0.98}) {
        const double h = 1e-4;
        const double slope = (fictitious_energy(potential, x * s + h, s) - fictitious_energy(potential, x * s - h, s)) / (2.0 * h);
        EXPECT_NEAR(fictitious_force(potential, x * s, s), -slope, 1e-7) << x << ' ' << s;  // h^2 times the third derivative, 2
        EXPECT_GT(fictitious_force(potential, x * s, s), 0.0);
      }
}

TEST(ReferenceHardSphere, TheFictitiousEnergyVanishesFromContactOn) {
  for (const FictitiousPotential potential : kPotentials) {
    EXPECT_NEAR(fictitious_energy(potential, 1.4 * (1.0 - 1e-9), 1.4), 0.0, 1e-8);
    for (const double r : {1.4, 1.5}) {
      EXPECT_EQ(fictitious_energy(potential, r, 1.4), 0.0);
      EXPECT_EQ(fictitious_force(potential, r, 1.4), 0.0);
    }
  }
}

TEST(ReferenceHardSphere, TheFictitiousForcesAreMinusTheGradientOfTheSummedEnergy) {
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

TEST(ReferenceHardSphere, CoincidentCentresFeelNoForce) {
  for (const FictitiousPotential potential : kPotentials)
    EXPECT_EQ(fictitious_forces(Point{1.0, 1.0, 1.0, 1.0, 1.0, 11.0 + 4.0}, Point{0.5, 0.5}, kBox, potential), Point(6, 0.0));
}

FreeSphere sphere(const Vector& position, const Vector& velocity, double radius = 0.5, double growth = 0.0, double time = 0.0) {
  return {position, velocity, time, radius, growth};
}

TEST(ReferenceHardSphere, SpheresHeadOnCollideAfterTheirGapOverTheirSpeed) {
  const FreeSphere still = sphere({0.0, 0.0, 0.0}, {});
  EXPECT_EQ(collision_time(still, sphere({3.0, 0.0, 0.0}, {-0.5, 0.0, 0.0}), 0.0, kBox), 4.0);
  EXPECT_EQ(collision_time(still, sphere({3.0, 0.0, 0.0}, {-0.5, 0.0, 0.0}), 1.0, kBox), 4.0);                 // seen later
  EXPECT_EQ(collision_time(still, sphere({3.0, 0.0, 0.0}, {-0.5, 0.0, 0.0}, 0.5, 0.0, 2.0), 5.0, kBox), 6.0);  // own clock
  EXPECT_EQ(collision_time(still, sphere({9.0, 12.0, 0.0}, {-0.5, 0.0, 0.0}), 0.0, kBox), kInfinity);
  EXPECT_EQ(collision_time(still, sphere({8.0, 12.0, 0.0}, {0.5, 0.0, 0.0}), 0.0, kBox), 2.0);  // through the boundary
}

TEST(ReferenceHardSphere, SpheresOffCentreCollideWhereTheLineMeetsTheSphere) {
  // Impact parameter 0.6 and contact distance 1: contact at 0.8 before the point of closest approach.
  const double time = collision_time(sphere({0.0, 0.0, 0.0}, {}), sphere({3.0, 0.6, 0.0}, {-2.0, 0.0, 0.0}), 0.0, kBox);
  EXPECT_NEAR(time, 1.1, 1e-15);
  EXPECT_EQ(collision_time(sphere({0.0, 0.0, 0.0}, {}), sphere({3.0, 1.0 + 1e-12, 0.0}, {-2.0, 0.0, 0.0}), 0.0, kBox), kInfinity);
}

TEST(ReferenceHardSphere, SpheresThatPartAtContactDoNotCollideAndThoseThatApproachCollideAtOnce) {
  const auto time = [](double r, const Vector& velocity) {
    return collision_time(sphere({0.0, 0.0, 0.0}, {}), sphere({r, 0.0, 0.0}, velocity, 0.5, 0.0, 7.0), 7.0, kBox);
  };
  for (const double r : {1.0, 1.0 - 1e-15, 0.9}) {
    EXPECT_EQ(time(r, {1.0, 0.3, 0.0}), kInfinity);
    EXPECT_EQ(time(r, {-1.0, 0.3, 0.0}), 7.0);
    EXPECT_EQ(time(r, {0.0, 0.3, 0.0}), kInfinity);
    EXPECT_EQ(time(r, {}), kInfinity);
  }
}

TEST(ReferenceHardSphere, AShortFlightToContactIsAsExactAsTheGap) {
  // [-b - sqrt(...)]/w^2 would be wrong by about 1e-16 here, in a time of 1e-13.
  const double gap = 0x1p-43;
  const double time = collision_time(sphere({0.0, 0.0, 0.0}, {}), sphere({1.0 + gap, 0.0, 0.0}, {-1.1, 0.0, 0.0}), 0.0, kBox);
  EXPECT_NEAR(time, gap / 1.1, 1e-12 * gap);
}

/// First sign change of |d + w t| - (s + a t) on a fine grid, then bisection; infinity if none up to `limit`.
double bisected_contact(const Vector& d, const Vector& w, double s, double a, double limit) {
  const auto gap = [&](double t) { return std::hypot(d[0] + w[0] * t, d[1] + w[1] * t, d[2] + w[2] * t) - (s + a * t); };
  const int cells = 20'000;
  for (int k = 0; k < cells; ++k) {
    double low = limit * k / cells;
    double high = limit * (k + 1) / cells;
    if (!(gap(low) >= 0.0 && gap(high) < 0.0)) continue;
    for (int n = 0; n < 100; ++n) {
      const double middle = 0.5 * (low + high);
      (gap(middle) >= 0.0 ? low : high) = middle;
    }
    return low;
  }
  return kInfinity;
}

TEST(ReferenceHardSphere, CollisionTimesOfGrowingSpheresAgreeWithBisection) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Vector box{100.0, 100.0, 100.0};
  const double limit = 20.0;
  std::array<int, 5> met{};  // falling or not at first, decelerating or not, overlapping at first; each must occur
  for (int trial = 0; trial < 1000; ++trial) {
    const Vector d{2.0 * uniform(engine), 2.0 * uniform(engine), 2.0 * uniform(engine)};
    const Vector w{uniform(engine), uniform(engine), uniform(engine)};
    const double grow_i = 0.4 * (1.0 + uniform(engine));
    const double grow_j = trial % 3 == 0 ? 0.0 : 0.4 * (1.0 + uniform(engine));
    const double s = 1.0;
    const double a = grow_i + grow_j;
    const double c = dot(d, d) - s * s;
    const double q = dot(d, w) - s * a;
    const double p = dot(w, w) - a * a;
    if (q * q - p * c < 1e-3 && q * q - p * c > -1e-3) continue;  // grazing: the grid would miss it
    const double time = collision_time(sphere({}, {}, 0.5, grow_i), sphere(d, w, 0.5, grow_j), 0.0, box);
    if (c < 0.0 && q < 0.0) {
      EXPECT_EQ(time, 0.0);
      ++met[4];
      continue;
    }
    ++met[(q < 0.0 ? 0u : 2u) + (p < 0.0 ? 0u : 1u)];
    const double expected = bisected_contact(d, w, s, a, limit);
    if (expected == kInfinity)
      EXPECT_GT(time, limit) << trial;
    else
      EXPECT_NEAR(time, expected, 1e-9) << trial;
  }
  for (const int count : met) EXPECT_GT(count, 10);
}

TEST(ReferenceHardSphere, GrowthCountsFromTimeZeroWhateverTheOwnTimeOfTheSphere) {
  // Radii 0.5 + 0.1 t each, centres 3 apart and at rest: contact when 1 + 0.2 t = 3.
  EXPECT_DOUBLE_EQ(
      collision_time(sphere({0.0, 0.0, 0.0}, {}, 0.5, 0.1, 2.0), sphere({3.0, 0.0, 0.0}, {}, 0.5, 0.1, 3.0), 4.0, kBox), 10.0);
}

TEST(ReferenceHardSphere, SpheresThatGrowAndPartMeetAgainWhenGrowthIsFasterThanTheirSpeed) {
  const auto time = [](double v, double growth) {
    return collision_time(sphere({0.0, 0.0, 0.0}, {}, 0.5, growth), sphere({2.0, 0.0, 0.0}, {v, 0.0, 0.0}), 0.0, kBox);
  };
  EXPECT_EQ(time(1.0, 0.5), kInfinity);
  EXPECT_EQ(time(1.0, 1.0), kInfinity);
  EXPECT_DOUBLE_EQ(time(1.0, 1.5), 2.0);  // 2 + t = 1 + 1.5 t
  EXPECT_NEAR(time(0.5, 0.5 + 1e-3), 1000.0, 1e-9);
}

TEST(ReferenceHardSphere, ShrinkingSpheresThatVanishBeforeTheyMeetNeverCollide) {
  const FreeSphere shrinking = sphere({0.0, 0.0, 0.0}, {}, 0.5, -0.5);
  EXPECT_EQ(collision_time(shrinking, sphere({3.0, 0.0, 0.0}, {-0.9, 0.0, 0.0}), 0.0, kBox), kInfinity);
  EXPECT_NEAR(collision_time(shrinking, sphere({3.0, 0.0, 0.0}, {-2.0, 0.0, 0.0}), 0.0, kBox), 2.0 / 1.5, 1e-15);
}

TEST(ReferenceHardSphere, ACollisionKeepsMomentumAndEnergyForUnequalMasses) {
  const Vector separation{0.6, -0.8, 0.5};
  const Vector v_i{1.0, -0.5, 0.2};
  const Vector v_j{-0.3, 0.4, -0.7};
  const Vector w{v_j[0] - v_i[0], v_j[1] - v_i[1], v_j[2] - v_i[2]};
  const double m_i = 1.0;
  const double m_j = 2.75;
  ASSERT_LT(dot(separation, w), 0.0);
  const Collision collision = elastic_collision(separation, w, m_i, m_j);
  Vector after_i;
  Vector after_j;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    after_i[axis] = v_i[axis] + collision.velocity_change_i[axis];
    after_j[axis] = v_j[axis] + collision.velocity_change_j[axis];
    EXPECT_NEAR(m_i * after_i[axis] + m_j * after_j[axis], m_i * v_i[axis] + m_j * v_j[axis], 1e-15);
  }
  EXPECT_NEAR(m_i * dot(after_i, after_i) + m_j * dot(after_j, after_j), m_i * dot(v_i, v_i) + m_j * dot(v_j, v_j), 1e-14);
  const Vector w_after{after_j[0] - after_i[0], after_j[1] - after_i[1], after_j[2] - after_i[2]};
  EXPECT_NEAR(dot(separation, w_after), -dot(separation, w), 1e-15);  // the normal part turns round
  // The virial is separation times momentum transfer.
  EXPECT_NEAR(collision.virial, m_j * dot(separation, collision.velocity_change_j), 1e-15);
}

TEST(ReferenceHardSphere, EqualMassesExchangeTheirVelocitiesHeadOn) {
  const Collision collision = elastic_collision({1.0, 0.0, 0.0}, {-3.0, 0.5, 0.0}, 1.0, 1.0);
  EXPECT_EQ(collision.velocity_change_i, (Vector{-3.0, 0.0, 0.0}));
  EXPECT_EQ(collision.velocity_change_j, (Vector{3.0, 0.0, 0.0}));
  EXPECT_EQ(collision.virial, 3.0);
}

TEST(ReferenceHardSphere, AFlightMeetsTheImageThatComesIntoReachOnTheWay) {
  // The nearest image lies behind, the one that is met a box ahead.
  std::vector<FreeSphere> spheres{sphere({0.0, 0.0, 0.0}, {}), sphere({2.0, 0.0, 0.0}, {1.0, 0.0, 0.0})};
  const Vector box{10.0, 10.0, 10.0};
  EXPECT_EQ(collision_time(spheres[0], spheres[1], 0.0, box), kInfinity);
  const Contact contact = fly_to_contact(spheres, box, 100.0);
  EXPECT_NEAR(contact.time, 7.0, 1e-14);
  EXPECT_NEAR(spheres[1].position[0], 9.0, 1e-14);
  EXPECT_EQ(spheres[0].time, contact.time);

  spheres = {sphere({0.0, 0.0, 0.0}, {}), sphere({2.0, 2.4, 0.0}, {10.0, -1.0, 0.0})};
  // It passes the image at x = 10 at a distance of 1.6; that at 20 is met: (10 t - 18)^2 + (2.4 - t)^2 = 1.
  EXPECT_EQ(fly_to_contact(spheres, box, 0.5).time, kInfinity);
  EXPECT_EQ(spheres[1].time, 0.5);
  EXPECT_NEAR(fly_to_contact(spheres, box, 100.0).time, (364.8 - std::sqrt(260.0)) / 202.0, 1e-13);
  EXPECT_NEAR(smallest_gap(Point{0.0, 0.0, 0.0, spheres[1].position[0], spheres[1].position[1], 0.0}, Point{0.5, 0.5}, box), 0.0,
              1e-14);
}

struct Gas {
  Point positions;
  Point velocities;
  std::vector<double> radii;
  std::vector<double> masses;
  Vector box;
};

/// 32 spheres of diameter 1 on fcc sites, Maxwellian velocities without drift
Gas gas(double packing_fraction, unsigned seed) {
  Gas result;
  const double edge = std::cbrt(32.0 * std::numbers::pi / 6.0 / packing_fraction);
  result.box = {edge, edge, edge};
  const std::array<Vector, 4> basis{{{0.0, 0.0, 0.0}, {0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}, {0.5, 0.5, 0.0}}};
  for (int cell = 0; cell < 8; ++cell)
    for (const Vector& site : basis)
      for (std::size_t axis = 0; axis < 3; ++axis)
        result.positions.push_back(0.5 * edge * (site[axis] + static_cast<double>((cell >> axis) & 1)));
  result.radii.assign(32, 0.5);
  result.masses.assign(32, 1.0);
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  for (std::size_t k = 0; k < 96; ++k) result.velocities.push_back(normal(engine));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double mean = 0.0;
    for (std::size_t k = axis; k < 96; k += 3) mean += result.velocities[k] / 32.0;
    for (std::size_t k = axis; k < 96; k += 3) result.velocities[k] -= mean;
  }
  return result;
}

TEST(ReferenceHardSphere, EventDrivenDynamicsKeepsEnergyMomentumAndDistance) {
  Gas start = gas(0.3, 4);
  for (std::size_t j = 0; j < 32; j += 2) start.masses[j] = 3.0;
  EventDriven simulation(start.positions, start.velocities, start.radii, start.masses, start.box);
  const auto momentum = [&](std::size_t axis) {
    double sum = 0.0;
    for (std::size_t j = 0; j < 32; ++j) sum += start.masses[j] * simulation.velocities()[3 * j + axis];
    return sum;
  };
  const double energy = simulation.kinetic_energy();
  const Vector before{momentum(0), momentum(1), momentum(2)};
  for (int k = 0; k < 2000; ++k) {
    ASSERT_TRUE(simulation.step(1e3));
    ASSERT_GT(smallest_gap(simulation.positions(), start.radii, start.box), -1e-12);
  }
  EXPECT_EQ(simulation.collisions(), 2000);
  EXPECT_NEAR(simulation.kinetic_energy(), energy, 1e-11 * energy);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(momentum(axis), before[axis], 1e-11);
}

TEST(ReferenceHardSphere, EventDrivenDynamicsStopsAtTheGivenTimeWithoutACollision) {
  EventDriven simulation(Point{0.0, 0.0, 0.0, 2.0, 0.0, 0.0}, Point{0.0, 0.0, 0.0, -1.0, 0.0, 0.0}, Point{0.5, 0.5},
                         Point{1.0, 1.0}, kBox);
  EXPECT_FALSE(simulation.step(0.5));
  EXPECT_EQ(simulation.time(), 0.5);
  EXPECT_EQ(simulation.positions()[3], 1.5);
  EXPECT_TRUE(simulation.step(2.0));
  EXPECT_EQ(simulation.time(), 1.0);
  EXPECT_EQ(simulation.velocities(), (Point{-1.0, 0.0, 0.0, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(simulation.step(1.0));  // no way back and nothing twice
  EXPECT_EQ(simulation.time(), 1.0);
}

TEST(ReferenceHardSphere, RunningTheVelocitiesBackwardsReturnsToTheStart) {
  const Gas start = gas(0.3, 5);
  EventDriven there(start.positions, start.velocities, start.radii, start.masses, start.box);
  const double duration = 0.4;  // some thirty collisions: rounding grows e-fold with each of a particle
  while (there.step(duration)) {
  }
  ASSERT_GT(there.collisions(), 20);
  Point reversed = there.velocities();
  for (double& v : reversed) v = -v;
  EventDriven back(there.positions(), reversed, start.radii, start.masses, start.box);
  while (back.step(duration)) {
  }
  EXPECT_EQ(back.collisions(), there.collisions());
  const Point end = back.positions();
  for (std::size_t k = 0; k < end.size(); ++k) EXPECT_NEAR(end[k], start.positions[k], 1e-9);
}

/// Contact value of the pair distribution by Carnahan and Starling; Z = 1 + 4 phi g.
double contact_value(double phi) { return (1.0 - 0.5 * phi) / std::pow(1.0 - phi, 3); }

/// The same in a periodic box of n spheres: Lebowitz and Percus, g_n = g - S(0)/(2n) d^2(phi^2 g)/dphi^2. At low density that
/// is the factor 1 - 1/n for a sphere that does not collide with itself.
double contact_value(double phi, double n) {
  const double h = 1e-3;
  const auto y = [](double x) { return x * x * contact_value(x); };
  const double curvature = (y(phi + h) - 2.0 * y(phi) + y(phi - h)) / (h * h);
  const double s0 = std::pow(1.0 - phi, 4) / (std::pow(1.0 + 2.0 * phi, 2) + std::pow(phi, 3) * (phi - 4.0));
  return contact_value(phi) - s0 / (2.0 * n) * curvature;
}

TEST(ReferenceHardSphere, PressureAndCollisionRateOfTheFluidAreThoseOfCarnahanAndStarling) {
  for (const double phi : {0.1, 0.2}) {
    const Gas start = gas(phi, 6);
    EventDriven simulation(start.positions, start.velocities, start.radii, start.masses, start.box);
    const double temperature = 2.0 * simulation.kinetic_energy() / 93.0;
    for (int k = 0; k < 2000; ++k) ASSERT_TRUE(simulation.step(1e6));  // 125 collisions of each particle melt the crystal

    const int blocks = 20;
    const double n = 32.0;
    double sum = 0.0, squares = 0.0, rates = 0.0, rate_squares = 0.0;
    for (int block = 0; block < blocks; ++block) {
      const double time = simulation.time();
      const double virial = simulation.virial();
      for (int k = 0; k < 2000; ++k) ASSERT_TRUE(simulation.step(1e6));
      const double duration = simulation.time() - time;
      const double excess = (simulation.virial() - virial) / (3.0 * n * temperature * duration);
      const double rate = 2000.0 / duration;
      sum += excess / blocks;
      squares += excess * excess / blocks;
      rates += rate / blocks;
      rate_squares += rate * rate / blocks;
    }
    const double error = std::sqrt((squares - sum * sum) / (blocks - 1));
    const double rate_error = std::sqrt((rate_squares - rates * rates) / (blocks - 1));
    // Z - 1 = 4 phi g; Enskog's rate is N/2 times 4 rho g sqrt(pi T). Errors from blocks, about 0.5 %: four of them would
    // not hide the 3 % between 3N and 3N - 3.
    const double expected = 4.0 * phi * contact_value(phi, n);
    const double rho = 6.0 * phi / std::numbers::pi;
    const double expected_rate = 2.0 * n * rho * contact_value(phi, n) * std::sqrt(std::numbers::pi * temperature);
    EXPECT_LT(error, 0.01 * expected);
    EXPECT_LT(rate_error, 0.01 * expected_rate);
    EXPECT_NEAR(sum, expected, 4.0 * error);
    EXPECT_NEAR(rates, expected_rate, 4.0 * rate_error);
    EXPECT_NEAR(simulation.compressibility(), 1.0 + expected, 0.03 * expected);  // the start included
  }
}

TEST(ReferenceHardSphere, InputThatDoesNotFitIsRefused) {
  const Point two(6, 0.0);
  EXPECT_THROW(overlaps(two, Point{0.5}, kBox), std::invalid_argument);
  EXPECT_THROW(overlaps(two, Point{0.5, -0.5}, kBox), std::invalid_argument);
  EXPECT_THROW(overlaps(two, Point{0.5, 0.5}, Vector{1.0, 0.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(pairs_within(two, Point{0.5, 0.5}, kBox, -0.1), std::invalid_argument);
  EXPECT_THROW(elastic_collision({1.0, 0.0, 0.0}, {}, 0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(EventDriven(two, two, Point{0.5, 0.5}, Point{1.0, 1.0}, kBox), std::invalid_argument);  // they coincide
  const Point apart{0.0, 0.0, 0.0, 2.0, 0.0, 0.0};
  EXPECT_THROW(EventDriven(apart, two, Point{0.5, 0.5}, Point{1.0}, kBox), std::invalid_argument);
  std::vector<FreeSphere> spheres(2);
  spheres[1].position = {1.5, 0.0, 0.0};
  EXPECT_THROW(fly_to_contact(spheres, Vector{2.0, 9.0, 9.0}, 1.0), std::invalid_argument);  // no room for a second image
  EXPECT_THROW(fly_to_contact(spheres, kBox, kInfinity), std::invalid_argument);
}

}  // namespace
