#include "stepper/contact_projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "core/random.hpp"

namespace lanescape {
namespace {

constexpr std::size_t spheres = 5;

// A random problem: pairs with gaps of 0 or more, wishes and inverse masses.
struct Problem {
  std::vector<PairGap> pairs;
  AlignedArray wish, inverse_masses;

  explicit Problem(std::uint64_t seed, std::size_t count, bool equal_masses)
      : wish(3 * spheres, 0.0), inverse_masses(spheres, 1.0), random_(seed, RandomStream::displacements) {
    for (std::size_t k = 0; k < 3 * spheres; ++k) wish[k] = random_.normal(0, static_cast<std::uint32_t>(k));
    if (!equal_masses)
      for (std::size_t i = 0; i < spheres; ++i) inverse_masses[i] = 0.2 + 3.0 * random_.uniform(1, static_cast<std::uint32_t>(i));
    for (std::uint32_t c = 0; c < count; ++c) {
      const auto i = static_cast<std::int32_t>(random_.below(spheres - 1, 2, c));
      const auto j = i + 1 + static_cast<std::int32_t>(random_.below(static_cast<std::uint32_t>(spheres) - 1 - i, 3, c));
      const auto n = random_.velocity(1.0, 4, c);
      const double norm = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      pairs.push_back({i, j, std::max(0.0, random_.uniform(5, c) - 0.5), {n[0] / norm, n[1] / norm, n[2] / norm}});
    }
  }

 private:
  CounterRandom random_;
};

double closing(const PairGap& pair, const AlignedArray& u) {
  double sum = pair.gap;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sum += pair.normal[axis] *
           (u[axis * spheres + static_cast<std::size_t>(pair.second)] - u[axis * spheres + static_cast<std::size_t>(pair.first)]);
  return sum;
}

AlignedArray moved(const Problem& problem, const std::vector<std::size_t>& active, const std::vector<double>& lambda) {
  AlignedArray u = problem.wish;
  for (std::size_t k = 0; k < active.size(); ++k) {
    const PairGap& pair = problem.pairs[active[k]];
    const auto i = static_cast<std::size_t>(pair.first), j = static_cast<std::size_t>(pair.second);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      u[axis * spheres + i] -= lambda[k] * pair.normal[axis] * problem.inverse_masses[i];
      u[axis * spheres + j] += lambda[k] * pair.normal[axis] * problem.inverse_masses[j];
    }
  }
  return u;
}

// Solves A M^-1 A^T lambda = rhs by elimination; nothing if the contacts depend on each other.
std::optional<std::vector<double>> solved(const Problem& problem, const std::vector<std::size_t>& active) {
  const std::size_t n = active.size();
  std::vector<std::vector<double>> matrix(n, std::vector<double>(n + 1));
  const AlignedArray zero(3 * spheres, 0.0);
  Problem at_rest = problem;
  at_rest.wish = zero;
  for (std::size_t column = 0; column < n; ++column) {
    const AlignedArray u = moved(at_rest, {active[column]}, {1.0});
    for (std::size_t row = 0; row < n; ++row)
      matrix[row][column] = closing(problem.pairs[active[row]], u) - problem.pairs[active[row]].gap;
  }
  for (std::size_t row = 0; row < n; ++row) matrix[row][n] = -closing(problem.pairs[active[row]], problem.wish);
  for (std::size_t k = 0; k < n; ++k) {
    if (matrix[k][k] < 1e-9) return std::nullopt;
    for (std::size_t row = 0; row < n; ++row) {
      if (row == k) continue;
      const double factor = matrix[row][k] / matrix[k][k];
      for (std::size_t column = k; column <= n; ++column) matrix[row][column] -= factor * matrix[k][column];
    }
  }
  std::vector<double> lambda(n);
  for (std::size_t k = 0; k < n; ++k) lambda[k] = matrix[k][n] / matrix[k][k];
  return lambda;
}

// The solution by trying all sets of contacts that act: the one with no negative multiplier and no overlap.
std::optional<AlignedArray> brute_force(const Problem& problem) {
  for (std::size_t set = 0; set < (std::size_t{1} << problem.pairs.size()); ++set) {
    std::vector<std::size_t> active;
    for (std::size_t c = 0; c < problem.pairs.size(); ++c)
      if ((set >> c & 1) != 0) active.push_back(c);
    const auto lambda = solved(problem, active);
    if (!lambda) continue;
    bool optimal = true;
    for (const double l : *lambda) optimal = optimal && l >= 0.0;
    const AlignedArray u = moved(problem, active, *lambda);
    for (const PairGap& pair : problem.pairs) optimal = optimal && closing(pair, u) >= -1e-10;
    if (optimal) return u;
  }
  return std::nullopt;
}

void expect_equal(const AlignedArray& u, const AlignedArray& expected, double tolerance) {
  for (std::size_t k = 0; k < u.size(); ++k) EXPECT_NEAR(u[k], expected[k], tolerance) << k;
}

void expect_brute_force(std::size_t contacts, bool equal_masses) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Problem problem(seed, contacts, equal_masses);
    const auto expected = brute_force(problem);
    ASSERT_TRUE(expected) << seed;
    ContactProjection projection(problem.inverse_masses, {});
    AlignedArray u = problem.wish;
    std::vector<double> multipliers;
    ASSERT_TRUE(projection.project(problem.pairs, u, multipliers)) << seed;
    expect_equal(u, *expected, 1e-9);
    for (std::size_t c = 0; c < problem.pairs.size(); ++c) {
      EXPECT_GE(closing(problem.pairs[c], u), -1e-12);
      EXPECT_GE(multipliers[c], 0.0);
      EXPECT_LE(multipliers[c] * closing(problem.pairs[c], u), 1e-10);
    }
  }
}

TEST(ContactProjection, FindsTheNearestPointThatEnumerationOfAllSetsOfContactsFinds) {
  expect_brute_force(3, true);
  expect_brute_force(8, true);
}

TEST(ContactProjection, WeighsDistancesWithMasses) { expect_brute_force(8, false); }

TEST(ContactProjection, ReturnsMultipliersThatGiveTheDisplacement) {
  const Problem problem(5, 8, false);
  ContactProjection projection(problem.inverse_masses, {});
  AlignedArray u = problem.wish;
  std::vector<double> multipliers;
  ASSERT_TRUE(projection.project(problem.pairs, u, multipliers));
  expect_equal(moved(problem, {0, 1, 2, 3, 4, 5, 6, 7}, multipliers), u, 1e-13);
}

TEST(ContactProjection, LeavesAWishThatNoContactForbids) {
  Problem problem(1, 8, true);
  for (PairGap& pair : problem.pairs) pair.gap = 100.0;
  ContactProjection projection(problem.inverse_masses, {});
  AlignedArray u = problem.wish;
  std::vector<double> multipliers;
  ASSERT_TRUE(projection.project(problem.pairs, u, multipliers));
  EXPECT_EQ(u, problem.wish);
  EXPECT_EQ(multipliers, std::vector<double>(8, 0.0));
}

TEST(ContactProjection, DoesNotDependOnItsFirstGuess) {
  const Problem problem(9, 8, true);
  ContactProjection projection(problem.inverse_masses, {});
  AlignedArray cold = problem.wish, warm = problem.wish;
  std::vector<double> from_nothing, from_elsewhere(8, 3.0);
  ASSERT_TRUE(projection.project(problem.pairs, cold, from_nothing));
  ASSERT_TRUE(projection.project(problem.pairs, warm, from_elsewhere));
  expect_equal(warm, cold, 1e-11);
}

TEST(ContactProjection, SolvesContactsThatAreGivenTwiceOrDependOnEachOther) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Problem once(seed, 6, true), twice = once;
    twice.pairs.insert(twice.pairs.end(), once.pairs.begin(), once.pairs.end());
    // A row of three with both ends held by the same plane: n, n and their sum, all touching.
    for (Problem* problem : {&once, &twice}) {
      problem->pairs.push_back({0, 1, 0.0, {1.0, 0.0, 0.0}});
      problem->pairs.push_back({1, 2, 0.0, {1.0, 0.0, 0.0}});
      problem->pairs.push_back({0, 2, 0.0, {1.0, 0.0, 0.0}});
    }
    ContactProjection projection(once.inverse_masses, {});
    AlignedArray u = once.wish, v = once.wish;
    std::vector<double> single, doubled;
    ASSERT_TRUE(projection.project(once.pairs, u, single)) << seed;
    ASSERT_TRUE(projection.project(twice.pairs, v, doubled)) << seed;
    expect_equal(v, u, 1e-10);
  }
}

TEST(ContactProjection, SaysWhenOverlapsCannotBeRemoved) {
  // 0 and 1 must approach and must part.
  const std::vector<PairGap> pairs{{0, 1, -1.0, {1.0, 0.0, 0.0}}, {0, 1, -1.0, {-1.0, 0.0, 0.0}}};
  ContactProjection projection(AlignedArray(spheres, 1.0), {.max_rounds = 50});
  AlignedArray u(3 * spheres, 0.0);
  std::vector<double> multipliers;
  EXPECT_FALSE(projection.project(pairs, u, multipliers));
}

TEST(ContactProjection, IgnoresAPairOfASphereWithItself) {
  const std::vector<PairGap> pairs{{1, 1, -1.0, {1.0, 0.0, 0.0}}};
  ContactProjection projection(AlignedArray(spheres, 1.0), {});
  AlignedArray u(3 * spheres, 0.25);
  std::vector<double> multipliers;
  ASSERT_TRUE(projection.project(pairs, u, multipliers));
  EXPECT_EQ(u, AlignedArray(3 * spheres, 0.25));
}

}  // namespace
}  // namespace lanescape
