#include "dynamics/hard_sphere_start.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "core/random.hpp"
#include "dynamics/contraction.hpp"
#include "dynamics/event_driven.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

using testing::refusal;

Configuration made(const HardSphereModel& model, std::size_t particles, double packing_fraction, StartMethod method,
                   std::uint64_t seed = 1) {
  SilentMonitor monitor;
  auto start = make_hard_sphere_start(model, particles, packing_fraction, method, seed, choose_isa(""), monitor);
  if (!start) {
    ADD_FAILURE() << "nobody asked to stop";
    std::abort();
  }
  return *start;
}

// Calls visit(i, j, r_ij / s_ij) for every pair, with nearest images.
template <class Visit>
void for_each_pair(const Configuration& c, Visit visit) {
  for (std::size_t i = 0; i < c.size(); ++i)
    for (std::size_t j = i + 1; j < c.size(); ++j) {
      double r2 = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        r2 += std::pow(c.box.nearest_image(axis, c.positions[3 * j + axis] - c.positions[3 * i + axis]), 2);
      visit(i, j, std::sqrt(r2) / (c.radii[i] + c.radii[j]));
    }
}

double least_ratio(const Configuration& c) {
  double least = std::numeric_limits<double>::infinity();
  for_each_pair(c, [&](std::size_t, std::size_t, double ratio) { least = std::min(least, ratio); });
  return least;
}

double unlike_fraction(const Configuration& c) {
  double unlike = 0.0, all = 0.0;
  for_each_pair(c, [&](std::size_t i, std::size_t j, double ratio) {
    if (ratio > 1.3) return;
    all += 1.0;
    if (c.species[i] != c.species[j]) unlike += 1.0;
  });
  return unlike / all;
}

// Checks the properties that every start must have.
void expect_sound(const Configuration& c, const HardSphereModel& model, std::size_t particles, double wanted) {
  ASSERT_EQ(c.size(), particles);
  EXPECT_NEAR(packing_fraction(c) / wanted, 1.0, 1e-12);
  EXPECT_GE(least_ratio(c), 1.0);
  EXPECT_EQ(c.radii, model.radii_of(c.species));
  for (std::size_t s = 1; s < model.species.size(); ++s)
    EXPECT_EQ(std::count(c.species.begin(), c.species.end(), static_cast<int>(s)),
              std::floor(model.species[s].fraction * static_cast<double>(particles)));
  EXPECT_EQ(c.box.length[0], c.box.length[1]);
  EXPECT_EQ(c.box.length[0], c.box.length[2]);
  ASSERT_EQ(c.positions.size(), 3 * particles);
  for (const double x : c.positions) EXPECT_TRUE(x >= 0.0 && x < c.box.length[0]) << x;
}

double compressibility(const Configuration& start) {
  EventDriven spheres(start, std::vector<double>(start.size(), 1.0), kernel_table(choose_isa("")));
  spheres.draw_velocities(5);
  for (std::size_t k = 0; k < 30 * start.size(); ++k) spheres.collide();
  const double virial = spheres.virial(), time = spheres.time();
  for (std::size_t k = 0; k < 100 * start.size(); ++k) spheres.collide();
  return spheres.compressibility(virial, time);
}

// Requests a stop after the given number of questions.
class StoppingMonitor final : public RunMonitor {
 public:
  explicit StoppingMonitor(int questions) : questions_(questions) {}
  void progress(std::string_view, double, double) override {}
  bool stop_requested() const override { return questions_-- <= 0; }

 private:
  mutable int questions_;
};

TEST(HardSphereStart, MethodsAreNamedByTheirWords) {
  for (const char* word : {"auto", "lattice", "contraction", "growth"}) EXPECT_STREQ(to_string(parse_start_method(word)), word);
  EXPECT_NE(refusal([] { parse_start_method("melt"); }).find("auto, lattice, contraction, growth"), std::string::npos);
}

TEST(HardSphereStart, LatticeStartsAreExactAndSeparateSpecies) {
  expect_sound(made(hard_sphere(), 108, 0.49, StartMethod::lattice), hard_sphere(), 108, 0.49);
  const Configuration halves = made(hard_sphere_binary(), 108, 0.49, StartMethod::lattice);
  expect_sound(halves, hard_sphere_binary(), 108, 0.49);
  double largest_of_large = 0.0, smallest_of_small = halves.box.length[0];
  for (std::size_t i = 0; i < halves.size(); ++i)
    if (halves.species[i] == 0)
      largest_of_large = std::max(largest_of_large, halves.positions[3 * i]);
    else
      smallest_of_small = std::min(smallest_of_small, halves.positions[3 * i]);
  EXPECT_LE(largest_of_large, smallest_of_small);
}

TEST(HardSphereStart, GrowthReachesAnyFluidPackingFraction) {
  for (const double wanted : {0.05, 0.30, 0.50, 0.59})
    expect_sound(made(hard_sphere_binary(), 108, wanted, StartMethod::growth), hard_sphere_binary(), 108, wanted);
  expect_sound(made(hard_sphere(), 500, 0.58, StartMethod::growth), hard_sphere(), 500, 0.58);
}

TEST(HardSphereStart, GrowthGoesFastEnoughThatOneComponentStaysAFluid) {
  // At 0.54 the crystal has Z = 12.0 by its equation of state, the fluid 20.3 by that of Carnahan and Starling.
  EXPECT_GT(compressibility(made(hard_sphere(), 500, 0.54, StartMethod::growth)), 17.0);
}

TEST(HardSphereStart, GrowthMixesTheSpecies) {
  EXPECT_NEAR(unlike_fraction(made(hard_sphere_binary(), 500, 0.58, StartMethod::growth)), 0.5, 0.05);
  EXPECT_LT(unlike_fraction(made(hard_sphere_binary(), 500, 0.49, StartMethod::lattice)), 0.3);  // the measure distinguishes them
}

TEST(HardSphereStart, GrowthKeepsUnevenCompositions) {
  HardSphereModel model = hard_sphere_binary();
  model.diameters = {3.0, 1.0};
  model.species[0].fraction = 0.1;
  model.species[1].fraction = 0.9;
  expect_sound(made(model, 200, 0.45, StartMethod::growth), model, 200, 0.45);
}

TEST(HardSphereStart, GrowthDoesNotDependOnTheUnitOfLength) {
  HardSphereModel model = hard_sphere_binary();
  for (double& diameter : model.diameters) diameter *= 1e-4;
  expect_sound(made(model, 108, 0.55, StartMethod::growth), model, 108, 0.55);
}

TEST(HardSphereStart, SeedsDecideAndNothingElse) {
  for (const StartMethod method : {StartMethod::growth, StartMethod::automatic}) {
    const Configuration one = made(hard_sphere_binary(), 108, 0.55, method, 1);
    EXPECT_EQ(made(hard_sphere_binary(), 108, 0.55, method, 1).positions, one.positions);
    EXPECT_NE(made(hard_sphere_binary(), 108, 0.55, method, 2).positions, one.positions);
  }
}

TEST(HardSphereStart, AutomaticIsTheLatticeWhereItHasRoomAndGrowthElsewhere) {
  const auto positions = [](double wanted, StartMethod method) {
    return made(hard_sphere_binary(), 108, wanted, method).positions;
  };
  EXPECT_EQ(positions(0.40, StartMethod::automatic), positions(0.40, StartMethod::lattice));
  EXPECT_EQ(positions(0.52, StartMethod::automatic), positions(0.52, StartMethod::growth));
  // With vacancies the one-component lattice is limited to 0.7405 * 62/108 = 0.425.
  expect_sound(made(hard_sphere(), 62, 0.46, StartMethod::automatic), hard_sphere(), 62, 0.46);
}

TEST(HardSphereStart, RefusesWhatCannotBe) {
  const auto refused = [](std::size_t particles, double wanted, StartMethod method) {
    return refusal([&] { made(hard_sphere_binary(), particles, wanted, method); });
  };
  for (const double wanted : {0.0, -0.1, 0.75, std::nan("")})
    EXPECT_NE(refused(108, wanted, StartMethod::automatic).find("above 0 and at most 0.74"), std::string::npos);
  for (const StartMethod method : {StartMethod::automatic, StartMethod::lattice, StartMethod::contraction, StartMethod::growth}) {
    EXPECT_NE(refused(4, 0.5, method).find("at least 2.05 of the largest diameter 1.4"), std::string::npos) << to_string(method);
    EXPECT_NE(refused(1, 0.01, method).find("1 particle"), std::string::npos) << to_string(method);
    refused(0, 0.3, method);
  }
  EXPECT_NE(refused(108, 0.70, StartMethod::lattice).find("fcc lattice"), std::string::npos);
  const std::string jammed = refused(108, 0.70, StartMethod::growth);
  EXPECT_NE(jammed.find("packing fraction 0.7 is beyond what growth reached for this composition (0.6"), std::string::npos)
      << jammed;
}

TEST(HardSphereStart, EndsWithNothingWhenAskedToStop) {
  for (const StartMethod method : {StartMethod::contraction, StartMethod::growth})
    for (const int questions : {0, 10}) {
      StoppingMonitor monitor(questions);
      EXPECT_FALSE(make_hard_sphere_start(hard_sphere_binary(), 108, 0.55, method, 1, choose_isa(""), monitor))
          << to_string(method);
    }
}

TEST(Contraction, ReachesBeyondTheLatticeWithFewSweeps) {
  SilentMonitor monitor;
  const Configuration lattice = hard_sphere_start(hard_sphere_binary(), 108, 0.50, Arrangement::halves, 1);
  ContractionOptions options;
  options.sweeps = 500;  // the lattice is limited to 0.5052, where large spheres touch; 50 sweeps may not melt it
  const auto dense = contract(lattice, 0.52, options, 1, monitor);
  ASSERT_TRUE(dense);
  expect_sound(*dense, hard_sphere_binary(), 108, 0.52);
  EXPECT_EQ(dense->species, lattice.species);
  EXPECT_EQ(contract(lattice, 0.52, options, 1, monitor)->positions, dense->positions);
  EXPECT_NE(contract(lattice, 0.52, options, 2, monitor)->positions, dense->positions);
}

TEST(Contraction, LeavesWhatIsDenseEnoughAlone) {
  SilentMonitor monitor;
  const Configuration lattice = hard_sphere_start(hard_sphere(), 108, 0.40, Arrangement::random, 1);
  EXPECT_EQ(contract(lattice, 0.40, {}, 1, monitor)->positions, lattice.positions);
}

TEST(Contraction, EndsWhereSpheresCannotBePushedApart) {
  SilentMonitor monitor;
  ContractionOptions options;
  options.sweeps = 2;
  options.volume_factor = 0.99;
  options.max_passes = 1000;
  const std::string why =
      refusal([&] { contract(made(hard_sphere_binary(), 108, 0.55, StartMethod::growth), 0.74, options, 1, monitor); });
  EXPECT_NE(why.find("beyond what mechanical contraction reached"), std::string::npos) << why;
}

TEST(Contraction, RefusesOptionsOutOfRange) {
  const auto refused = [](auto change) {
    ContractionOptions options;
    change(options);
    return refusal([&] { options.check(); });
  };
  for (const double factor : {0.5, 1.0, std::nan("")})
    EXPECT_NE(refused([&](auto& o) { o.volume_factor = factor; }).find("volume factor"), std::string::npos);
  for (const double move : {0.0, 2.0, std::nan("")})
    EXPECT_NE(refused([&](auto& o) { o.max_move = move; }).find("largest move"), std::string::npos);
  refused([](auto& o) { o.max_passes = 0; });
}

TEST(Contraction, PushesOverlappingSpheresToContactAlongTheirLine) {
  // Two spheres of diameter 1 across the face of the box, and a third far from them.
  const Configuration start{Box{{5.0, 5.0, 5.0}}, {0, 0, 0}, {0.2, 1.0, 1.0, 4.8, 1.0, 1.0, 2.5, 3.0, 3.0}, {0.5, 0.5, 0.5}};
  SqueezedSpheres spheres(start);
  EXPECT_FALSE(spheres.push_apart(1));
  EXPECT_TRUE(spheres.push_apart(2));
  const Configuration apart = spheres.configuration();
  EXPECT_NEAR(apart.positions[0], 0.5, 1e-5);
  EXPECT_NEAR(apart.positions[3], 4.5, 1e-5);
  EXPECT_EQ(apart.positions[1], 1.0);
  EXPECT_EQ(std::vector<double>(apart.positions.begin() + 6, apart.positions.end()), (std::vector<double>{2.5, 3.0, 3.0}));
  EXPECT_GE(least_ratio(apart), 1.0);
}

TEST(Contraction, MonteCarloAcceptsMovesWithoutOverlapsOnly) {
  // 108 particles: lists over the whole box; 2000: cells. Large moves leave the skin of a list immediately.
  for (const auto& [particles, max_move] : {std::pair<std::size_t, double>{108, 0.1}, {108, 0.9}, {2000, 0.1}}) {
    const Configuration start = made(hard_sphere_binary(), particles, 0.48, StartMethod::lattice);
    SqueezedSpheres spheres(start);
    const CounterRandom random(1, RandomStream::monte_carlo);
    std::size_t accepted = 0, tried = 0;
    for (std::uint64_t sweep = 0; sweep < 20; ++sweep) {
      accepted += spheres.sweep(random, sweep, max_move);
      tried += particles;
      if (particles < 1000 || sweep % 10 == 9) {
        EXPECT_GE(least_ratio(spheres.configuration()), 1.0) << sweep;
      }
    }
    EXPECT_GT(accepted, 0u);
    EXPECT_LT(accepted, tried);
    EXPECT_NE(spheres.configuration().positions, start.positions);
  }
}

TEST(Contraction, LooseSpheresMoveFreely) {
  SqueezedSpheres spheres(made(hard_sphere(), 108, 0.001, StartMethod::lattice));
  EXPECT_EQ(spheres.sweep(CounterRandom(1, RandomStream::monte_carlo), 0, 0.1), 108u);
}

}  // namespace
}  // namespace lanescape
