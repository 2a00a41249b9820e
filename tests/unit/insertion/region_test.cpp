#include <gtest/gtest.h>

#include "insertion/insertion.hpp"
#include "insertion/removal.hpp"
#include "insertion/search.hpp"
#include "refusal.hpp"
#include "thin_mixture.hpp"

namespace lanescape {
namespace {

using namespace testing;

TEST(Region, ReflectedSearchesProbeNothingOutsideTheirRegion) {
  const PairModel model = kob_andersen();
  const ProbeField field(model, thin_mixture(), 0, table());
  for (const InsertionMethod method : every_method) {
    InsertionOptions options = options_with(-3.5, method);
    options.region = Region{{0.5, 1.0, 0.0}, {1.7, 3.0, field.box().length[2]}};
    std::size_t probes = 0, outside = 0, found = 0;
    for (std::uint64_t number = 0; number < 30; ++number) {
      InsertionSearch search(field, options, number, 0.035, 100, [&](std::uint64_t, const Point& position, double) {
        ++probes;
        // Along z, where the region is as long as the box, it goes round.
        outside += !options.region->contains(options.region->image(field.box(), position));
      });
      search.run();
      found += search.result().found && options.region->contains(search.result().position);
    }
    EXPECT_EQ(outside, 0U) << to_string(method);
    EXPECT_GT(probes, 100U);
    EXPECT_EQ(found, 30U) << to_string(method);
  }
}

TEST(Region, SearchesInAWellEndInTheirRegion) {
  const PairModel model = kob_andersen();
  const ProbeField field(model, thin_mixture(), 0, table());
  InsertionOptions options = options_with(-3.5);
  options.region = Region{{0.5, 1.0, 0.0}, {1.7, 3.0, field.box().length[2]}};
  options.wall = RegionWall::well;
  InsertionHistory history;
  for (const Insertion& place : find_places(field, options, 60, history, 1)) {
    ASSERT_TRUE(place.found);
    EXPECT_TRUE(options.region->contains(place.position));
  }
}

TEST(Region, ARegionMayLieAcrossFacesOfTheBox) {
  const PairModel model = kob_andersen();
  const Box box = thin_mixture().box;
  const double edge = box.length[0];
  for (const RegionWall wall : {RegionWall::reflect, RegionWall::well})
    for (const InsertionMethod method : every_method) {
      ProbeField field(model, thin_mixture(), 0, table());
      InsertionOptions options = options_with(-3.5, method);
      options.wall = wall;
      options.most_trials = 200;
      options.region = Region{{-0.2 * edge, 1.0, -0.5 * box.length[2]}, {0.2 * edge, 3.0, 0.5 * box.length[2]}};
      InsertionHistory history;
      std::size_t below = 0, above = 0;
      for (const Insertion& place : insert_particles(field, options, 12, history, 1)) {
        if (!place.found) continue;
        const auto [x, y, z] = place.position;
        EXPECT_TRUE(x >= 0.0 && x < edge && y >= 0.0 && y < box.length[1] && z >= 0.0 && z < box.length[2]);
        EXPECT_TRUE(x <= 0.2 * edge * (1 + 1e-12) || x >= 0.8 * edge * (1 - 1e-12)) << x;
        EXPECT_TRUE(y >= 1.0 && y <= 3.0) << y;
        ++(x < 0.5 * edge ? below : above);
      }
      EXPECT_GT(below, 0U) << to_string(method);
      EXPECT_GT(above, 0U) << to_string(method);
    }
}

// A slab: its open faces are walls, and nothing is shifted across them.
TEST(Region, OpenFacesAreWalls) {
  const PairModel model = kob_andersen();
  for (const InsertionMethod method : every_method) {
    Configuration fluid = thin_mixture();
    fluid.wrap();
    fluid.box.periodic = {false, true, true};
    ProbeField field(model, fluid, 0, table());
    InsertionOptions options = options_with(-3.5, method);
    std::size_t outside = 0;
    for (std::uint64_t number = 0; number < 30; ++number) {
      InsertionSearch search(field, options, number, 0.035, 100, [&](std::uint64_t, const Point& position, double) {
        outside += position[0] < 0.0 || position[0] > fluid.box.length[0];
      });
      search.run();
      EXPECT_TRUE(search.result().found);
    }
    EXPECT_EQ(outside, 0U) << to_string(method);
    InsertionHistory history;
    for (const Insertion& place : insert_particles(field, options, 10, history, 2)) {
      ASSERT_TRUE(place.found) << to_string(method);
      EXPECT_GE(place.position[0], 0.0);
      EXPECT_LE(place.position[0], fluid.box.length[0]);
    }
  }
}

TEST(Region, LiesBetweenOpenFaces) {
  const Box box{{5.0, 6.0, 7.0}, {false, true, true}};
  EXPECT_NO_THROW((Region{{0.0, -3.0, 0.0}, {5.0, 3.0, 7.0}}.check(box)));
  for (const Region& region : {Region{{-0.1, 0.0, 0.0}, {1.0, 6.0, 7.0}}, Region{{4.0, 0.0, 0.0}, {5.1, 6.0, 7.0}},
                               Region{{6.0, 0.0, 0.0}, {7.0, 6.0, 7.0}}}) {
    const std::string message = refusal([&] { region.check(box); });
    EXPECT_NE(message.find("open along x, from 0 to 5"), std::string::npos) << message;
  }
  const Region region{{0.5, -3.0, 0.0}, {1.5, 3.0, 7.0}};
  EXPECT_EQ(region.image(box, {6.0, 5.0, 1.0}), (Point{6.0, -1.0, 1.0}));
}

TEST(Region, KeepsItsWallsBesideAnOpenFace) {
  const PairModel model = kob_andersen();
  Configuration fluid = thin_mixture();
  fluid.wrap();
  fluid.box.periodic = {false, true, true};
  for (const RegionWall wall : {RegionWall::reflect, RegionWall::well}) {
    ProbeField field(model, fluid, 0, table());
    InsertionOptions options = options_with(-2.0);
    options.wall = wall;
    options.region = Region{{0.0, -1.0, 0.0}, {1.2, 1.5, fluid.box.length[2]}};
    InsertionHistory history;
    for (const Insertion& place : insert_particles(field, options, 6, history, 1)) {
      ASSERT_TRUE(place.found);
      EXPECT_TRUE(options.region->contains(options.region->image(fluid.box, place.position)));
    }
  }
}

TEST(Region, ARegionInAnotherImageOfTheBoxHasTheSamePlacesToRounding) {
  const PairModel model = kob_andersen();
  const ProbeField field(model, thin_mixture(), 0, table());
  const Box& box = field.box();
  for (const InsertionMethod method : {InsertionMethod::usher, InsertionMethod::screened}) {
    InsertionOptions here = options_with(-3.5, method), there = here;
    here.region = Region{{0.5, 1.0, 0.0}, {1.7, 3.0, 2.0}};
    there.region = here.region;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      there.region->low[axis] -= box.length[axis];
      there.region->high[axis] -= box.length[axis];
    }
    InsertionHistory first, second;
    const Insertion a = find_places(field, here, 1, first, 1).front(), b = find_places(field, there, 1, second, 1).front();
    ASSERT_TRUE(a.found && b.found);
    EXPECT_EQ(a.evaluations, b.evaluations);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(a.position[axis], b.position[axis], 1e-6);
  }
}

TEST(Region, ParticlesAreRemovedFromARegionAcrossFaces) {
  const PairModel model = lennard_jones();
  const Configuration fluid{Box{{8.0, 8.0, 8.0}}, {0, 0, 0}, {7.5, 4.0, 4.0, 3.0, 4.0, 4.0, -7.6, 4.0, 12.0}};
  const CounterRandom random(1, RandomStream::insertion);
  const auto chosen = [&](const Region& region, std::uint64_t number) {
    const auto removal = choose_removal(model, fluid, 0, RemovalRule::random, region, 0.0, random, number, choose_isa("auto"));
    return removal ? static_cast<int>(removal->particle) : -1;
  };
  const Region across{{-1.0, -4.0, 0.0}, {1.0, 4.0, 8.0}}, within{{2.0, -4.0, 0.0}, {4.0, 4.0, 8.0}};
  bool first = false, last = false;
  for (std::uint64_t number = 0; number < 30; ++number) {
    const int particle = chosen(across, number);
    EXPECT_NE(particle, 1);
    first = first || particle == 0;
    last = last || particle == 2;
    EXPECT_EQ(chosen(within, number), 1);
  }
  EXPECT_TRUE(first && last);
  EXPECT_EQ(chosen(Region{{4.5, 0.0, 0.0}, {6.0, 8.0, 8.0}}, 0), -1);
}

}  // namespace
}  // namespace lanescape
