#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "path/path_check.hpp"
#include "path/shortening/curve_shortening.hpp"
#include "path/shortening/soft_curve.hpp"
#include "reference/curve_shortening.hpp"
#include "small_liquid.hpp"

namespace lanescape {
namespace {

using testing::SmallLiquid;

// The nodes of the shortened path, in the user's order.
std::vector<reference::Point> shortened(const SmallLiquid& liquid, const std::vector<reference::Point>& start) {
  const auto landscape = liquid.make();
  CurveShortening curve(landscape->algebra(),
                        std::make_unique<SoftCurve>([&] { return liquid.make(); }, liquid.landscape_energy, SoftCurveOptions{}),
                        {.coarse_spacing = 0.2});
  curve.begin(liquid.in_slots(start));
  while (!curve.finished()) curve.advance();
  EXPECT_EQ(curve.reason(), "");
  std::vector<reference::Point> nodes;
  for (const AlignedArray& node : curve.nodes()) nodes.push_back(liquid.layout.to_user(node));
  return nodes;
}

PathCheck check(const SmallLiquid& liquid, const std::vector<reference::Point>& nodes) {
  return check_path([&] { return liquid.make(); }, liquid.landscape_energy, liquid.in_slots(nodes));
}

TEST(ShortenedPath, IsAsLongAsThatOfTheReferenceFromTheSameStart) {
  const std::pair<std::size_t, int> systems[] = {{8, 4000}, {12, 4000}, {20, 1500}};
  for (const auto& [particles, steps] : systems) {
    const SmallLiquid liquid(particles, particles, steps);
    const auto greedy = liquid.greedy();
    const auto expected =
        reference::shorten_curve(greedy, reference::below_energy(liquid.energy(), liquid.gradient(), liquid.landscape_energy),
                                 {.fine = 65, .tolerance = 1e-5});
    ASSERT_TRUE(expected.stationary);
    const PathCheck before = check(liquid, greedy), found = check(liquid, shortened(liquid, greedy));
    EXPECT_LT(found.length, 0.99 * before.length) << "there is something to shorten";
    EXPECT_NEAR(found.length, expected.length, 3e-4 * expected.length);  // measured: 1e-4
    EXPECT_LE(found.kuhn_tucker_residual, 1e-2);
    EXPECT_LE(found.largest_violation, 1e-3);
  }
}

// The same system and path with axes and particles exchanged; order[j] is the particle that comes at j.
class Exchanged {
 public:
  Exchanged(const SmallLiquid& liquid, std::vector<std::size_t> order, std::size_t turn)
      : order_(std::move(order)), turn_(turn), liquid_(liquid) {
    for (std::size_t j = 0; j < order_.size(); ++j) liquid_.start.species[j] = liquid.start.species[order_[j]];
    liquid_.start.positions = exchanged(liquid.start.positions);
    liquid_.finish = liquid_.at(exchanged(liquid.finish.positions));
    liquid_.layout = ParticleLayout(liquid_.start.species, 2);
  }
  reference::Point exchanged(const reference::Point& node) const {
    reference::Point result;
    for (const std::size_t j : order_)
      for (std::size_t axis = 0; axis < 3; ++axis) result.push_back(node[3 * j + (axis + turn_) % 3]);
    return result;
  }
  std::vector<reference::Point> exchanged(const std::vector<reference::Point>& nodes) const {
    std::vector<reference::Point> result;
    for (const reference::Point& node : nodes) result.push_back(exchanged(node));
    return result;
  }
  const SmallLiquid& liquid() const { return liquid_; }

 private:
  std::vector<std::size_t> order_;
  std::size_t turn_;
  SmallLiquid liquid_;
};

// The largest distance between nodes of the same number [sigma].
double farthest(const std::vector<reference::Point>& a, const std::vector<reference::Point>& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, reference::distance(a[k], b[k]));
  return largest;
}

class ShortenedPathOfALiquid : public ::testing::Test {
 protected:
  ShortenedPathOfALiquid() : start_(liquid_.greedy()), found_(shortened(liquid_, start_)) {}
  // The path found in other coordinates is the path found, in those.
  void expect_same(const std::vector<reference::Point>& expected, const std::vector<reference::Point>& found) const {
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_LT(farthest(found, expected), 1e-2);
    EXPECT_NEAR(check(liquid_, found_).length, length_of(found), 1e-5);
  }
  static double length_of(const std::vector<reference::Point>& nodes) {
    double length = 0.0;
    for (std::size_t k = 1; k < nodes.size(); ++k) length += reference::distance(nodes[k - 1], nodes[k]);
    return length;
  }

  SmallLiquid liquid_{12, 12, 4000};
  std::vector<reference::Point> start_, found_;
};

TEST_F(ShortenedPathOfALiquid, IsTheSameFromEitherEnd) {
  std::vector<reference::Point> back = shortened(liquid_, {start_.rbegin(), start_.rend()});
  std::reverse(back.begin(), back.end());
  expect_same(found_, back);
}

TEST_F(ShortenedPathOfALiquid, TurnsWithTheAxes) {
  std::vector<std::size_t> order(12);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const Exchanged turned(liquid_, order, 1);
  expect_same(turned.exchanged(found_), shortened(turned.liquid(), turned.exchanged(start_)));
}

TEST_F(ShortenedPathOfALiquid, DoesNotDependOnTheOrderOfParticles) {
  const Exchanged other(liquid_, {7, 4, 0, 11, 2, 9, 1, 10, 3, 5, 8, 6}, 0);
  expect_same(other.exchanged(found_), shortened(other.liquid(), other.exchanged(start_)));
}

}  // namespace
}  // namespace lanescape
