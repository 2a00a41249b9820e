#include "reference/event_driven.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

#include "hard_spheres.hpp"

namespace {

using namespace lanescape::reference;

FreeSphere sphere(const Vector& position, const Vector& velocity, double radius = 0.5, double growth = 0.0, double time = 0.0) {
  return {position, velocity, time, radius, growth};
}

TEST(ReferenceCollision, SpheresHeadOnCollideAfterTheirGapOverTheirSpeed) {
  const FreeSphere still = sphere({0.0, 0.0, 0.0}, {});
  EXPECT_EQ(collision_time(still, sphere({3.0, 0.0, 0.0}, {-0.5, 0.0, 0.0}), 0.0, kBox), 4.0);
  EXPECT_EQ(collision_time(still, sphere({3.0, 0.0, 0.0}, {-0.5, 0.0, 0.0}), 1.0, kBox), 4.0);  // predicted at a later time
  EXPECT_EQ(collision_time(still, sphere({3.0, 0.0, 0.0}, {-0.5, 0.0, 0.0}, 0.5, 0.0, 2.0), 5.0, kBox),
            6.0);  // with a time of its own
  EXPECT_EQ(collision_time(still, sphere({9.0, 12.0, 0.0}, {-0.5, 0.0, 0.0}), 0.0, kBox), kInfinity);
  EXPECT_EQ(collision_time(still, sphere({8.0, 12.0, 0.0}, {0.5, 0.0, 0.0}), 0.0, kBox), 2.0);  // across the boundary
}

TEST(ReferenceCollision, SpheresOffCentreCollideWhereTheLineMeetsTheSphere) {
  // Impact parameter 0.6 and contact distance 1: contact at 0.8 before the point of closest approach.
  const double time = collision_time(sphere({0.0, 0.0, 0.0}, {}), sphere({3.0, 0.6, 0.0}, {-2.0, 0.0, 0.0}), 0.0, kBox);
  EXPECT_NEAR(time, 1.1, 1e-15);
  EXPECT_EQ(collision_time(sphere({0.0, 0.0, 0.0}, {}), sphere({3.0, 1.0 + 1e-12, 0.0}, {-2.0, 0.0, 0.0}), 0.0, kBox), kInfinity);
}

TEST(ReferenceCollision, SpheresThatPartAtContactDoNotCollideAndThoseThatApproachCollideAtOnce) {
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

TEST(ReferenceCollision, AShortFlightToContactIsAsExactAsTheGap) {
  // The formula [-b - sqrt(...)]/w^2 has an error of about 1e-16 here; the time is 1e-13.
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

TEST(ReferenceCollision, CollisionTimesOfGrowingSpheresAgreeWithBisection) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Vector box{100.0, 100.0, 100.0};
  const double limit = 20.0;
  std::array<int, 5> met{};  // four sign combinations of q and p without overlap, and overlap; each must occur
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
    if (q * q - p * c < 1e-3 && q * q - p * c > -1e-3) continue;  // grazing: the grid may miss it
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

TEST(ReferenceCollision, GrowthCountsFromTimeZeroWhateverTheOwnTimeOfTheSphere) {
  // Radii 0.5 + 0.1 t each, centres 3 apart and at rest: contact when 1 + 0.2 t = 3.
  EXPECT_DOUBLE_EQ(
      collision_time(sphere({0.0, 0.0, 0.0}, {}, 0.5, 0.1, 2.0), sphere({3.0, 0.0, 0.0}, {}, 0.5, 0.1, 3.0), 4.0, kBox), 10.0);
}

TEST(ReferenceCollision, SpheresThatGrowAndPartMeetAgainWhenGrowthIsFasterThanTheirSpeed) {
  const auto time = [](double v, double growth) {
    return collision_time(sphere({0.0, 0.0, 0.0}, {}, 0.5, growth), sphere({2.0, 0.0, 0.0}, {v, 0.0, 0.0}), 0.0, kBox);
  };
  EXPECT_EQ(time(1.0, 0.5), kInfinity);
  EXPECT_EQ(time(1.0, 1.0), kInfinity);
  EXPECT_DOUBLE_EQ(time(1.0, 1.5), 2.0);  // 2 + t = 1 + 1.5 t
  EXPECT_NEAR(time(0.5, 0.5 + 1e-3), 1000.0, 1e-9);
}

TEST(ReferenceCollision, ShrinkingSpheresThatVanishBeforeTheyMeetNeverCollide) {
  const FreeSphere shrinking = sphere({0.0, 0.0, 0.0}, {}, 0.5, -0.5);
  EXPECT_EQ(collision_time(shrinking, sphere({3.0, 0.0, 0.0}, {-0.9, 0.0, 0.0}), 0.0, kBox), kInfinity);
  EXPECT_NEAR(collision_time(shrinking, sphere({3.0, 0.0, 0.0}, {-2.0, 0.0, 0.0}), 0.0, kBox), 2.0 / 1.5, 1e-15);
}

TEST(ReferenceCollision, ACollisionKeepsMomentumAndEnergyForUnequalMasses) {
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
  EXPECT_NEAR(dot(separation, w_after), -dot(separation, w), 1e-15);  // the normal component is reversed
  // The virial is the separation times the transferred momentum.
  EXPECT_NEAR(collision.virial, m_j * dot(separation, collision.velocity_change_j), 1e-15);
}

TEST(ReferenceCollision, EqualMassesExchangeTheirVelocitiesHeadOn) {
  const Collision collision = elastic_collision({1.0, 0.0, 0.0}, {-3.0, 0.5, 0.0}, 1.0, 1.0);
  EXPECT_EQ(collision.velocity_change_i, (Vector{-3.0, 0.0, 0.0}));
  EXPECT_EQ(collision.velocity_change_j, (Vector{3.0, 0.0, 0.0}));
  EXPECT_EQ(collision.virial, 3.0);
}

TEST(ReferenceCollision, AFlightMeetsTheImageThatComesIntoReachOnTheWay) {
  // The sphere moves away from the nearest image and meets another one.
  std::vector<FreeSphere> spheres{sphere({0.0, 0.0, 0.0}, {}), sphere({2.0, 0.0, 0.0}, {1.0, 0.0, 0.0})};
  const Vector box{10.0, 10.0, 10.0};
  EXPECT_EQ(collision_time(spheres[0], spheres[1], 0.0, box), kInfinity);
  const Contact contact = fly_to_contact(spheres, box, 100.0);
  EXPECT_NEAR(contact.time, 7.0, 1e-14);
  EXPECT_NEAR(spheres[1].position[0], 9.0, 1e-14);
  EXPECT_EQ(spheres[0].time, contact.time);

  spheres = {sphere({0.0, 0.0, 0.0}, {}), sphere({2.0, 2.4, 0.0}, {10.0, -1.0, 0.0})};
  // It passes the image at x = 10 at a distance of 1.6 and meets that at x = 20: (10 t - 18)^2 + (2.4 - t)^2 = 1.
  EXPECT_EQ(fly_to_contact(spheres, box, 0.5).time, kInfinity);
  EXPECT_EQ(spheres[1].time, 0.5);
  EXPECT_NEAR(fly_to_contact(spheres, box, 100.0).time, (364.8 - std::sqrt(260.0)) / 202.0, 1e-13);
  EXPECT_NEAR(smallest_gap(Point{0.0, 0.0, 0.0, spheres[1].position[0], spheres[1].position[1], 0.0}, Point{0.5, 0.5}, box), 0.0,
              1e-14);
}

TEST(ReferenceCollision, InputThatDoesNotFitIsRefused) {
  EXPECT_THROW(elastic_collision({1.0, 0.0, 0.0}, {}, 0.0, 1.0), std::invalid_argument);
  std::vector<FreeSphere> spheres(2);
  spheres[1].position = {1.5, 0.0, 0.0};
  EXPECT_THROW(fly_to_contact(spheres, Vector{2.0, 9.0, 9.0}, 1.0), std::invalid_argument);  // a second image is in reach
  EXPECT_THROW(fly_to_contact(spheres, kBox, kInfinity), std::invalid_argument);
}

}  // namespace
