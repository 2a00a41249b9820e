#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "configuration/lattice.hpp"
#include "every_isa.hpp"
#include "interaction/pair/pair_moves.hpp"
#include "interaction/pair/probe_field.hpp"
#include "refusal.hpp"
#include "verification/cases.hpp"
#include "verification/reference_bridge.hpp"

// Single particles in slabs and clusters: probes, insertion and removal, moves.
namespace lanescape {
namespace {

using Axes = std::array<bool, 3>;
constexpr Axes every_choice[] = {{false, true, true},  {true, false, true},  {true, true, false},
                                 {false, false, true}, {false, true, false}, {false, false, false}};

Configuration slab(const PairModel& model, std::size_t particles, const Axes& periodic) {
  Configuration fluid = fcc_start(model, particles, 0.7, 1);
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> jitter(-0.05, 0.05);
  for (double& x : fluid.positions) x += jitter(engine);
  fluid.box.periodic = periodic;
  return fluid;
}

void expect_reference(const ProbeField& field, const PairModel& model, const Configuration& fluid, const Point& place) {
  const reference::Probe expected = probe_reference(model, fluid, place, 0);
  const ProbeField::Sample found = field.sample(place);
  EXPECT_NEAR(found.energy, expected.energy, 1e-12 * expected.magnitude + 1e-14) << place[0] << ' ' << place[1] << ' ' << place[2];
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(found.gradient[axis], expected.gradient[axis], 1e-11 * expected.gradient_magnitude[axis] + 1e-12);
  EXPECT_EQ(field.energy(place), found.energy);
}

using OpenProbesOnEveryIsa = testing::EveryIsa;

INSTANTIATE_TEST_SUITE_P(EveryIsa, OpenProbesOnEveryIsa, testing::all_isas(), testing::isa_name);

// Within the faces, on them, beyond them where particles are felt, and far away, where none are.
TEST_P(OpenProbesOnEveryIsa, FeelWhatTheReferenceSays) {
  for (const PairModel& model : {lennard_jones(), kob_andersen()})
    for (const Axes& axes : every_choice)
      for (const std::size_t particles : {4U, 256U}) {
        const Configuration fluid = slab(model, particles, axes);
        const ProbeField field(model, fluid, 0, kernel_table(GetParam()));
        const Point& edge = fluid.box.length;
        std::mt19937_64 engine(2);
        std::uniform_real_distribution<double> part(-0.6, 1.6);
        for (int k = 0; k < 40; ++k)
          expect_reference(field, model, fluid, {part(engine) * edge[0], part(engine) * edge[1], part(engine) * edge[2]});
        for (std::size_t axis = 0; axis < 3; ++axis)
          for (const double x : {0.0, edge[axis], std::nextafter(edge[axis], 1e9), -1e-300, -2.4, edge[axis] + 2.4, -1e6, 1e6}) {
            if (axes[axis] && std::abs(x) > 100.0) continue;  // wrapped, it has lost its digits
            Point place{0.35 * edge[0], 0.4 * edge[1], 0.6 * edge[2]};
            place[axis] = x;
            expect_reference(field, model, fluid, place);
          }
      }
}

// Particles outside the faces are felt, by probes beside them too.
TEST_P(OpenProbesOnEveryIsa, FeelParticlesThatHaveLeft) {
  const PairModel model = kob_andersen();
  for (const double away : {0.5, 3.0, 40.0, 1e5}) {
    Configuration fluid = slab(model, 108, {false, true, false});
    ProbeField field(model, fluid, 0, kernel_table(GetParam()));
    for (const double x : {-away, fluid.box.length[0] + away})
      for (const double z : {-away, 0.5 * fluid.box.length[2]}) {
        const Point place{x, 1.0, z};
        fluid.positions.insert(fluid.positions.end(), place.begin(), place.end());
        fluid.species.push_back(1);
        field.insert(place, 1);
        for (const double dx : {-0.9, 0.2, 1.4}) expect_reference(field, model, fluid, {x + dx, 1.7, z + 0.4});
      }
    EXPECT_TRUE(field.remove(fluid.position(fluid.size() - 1), 1));
    fluid.species.pop_back();
    fluid.positions.resize(fluid.positions.size() - 3);
    expect_reference(field, model, fluid, {fluid.box.length[0] + away + 0.3, 1.5, 0.5 * fluid.box.length[2]});
    EXPECT_FALSE(field.remove({-away - 1.0, 1.0, 0.0}, 1));
  }
}

TEST(OpenProbes, DoNotGoAcrossAFace) {
  const PairModel model = lennard_jones();
  Configuration fluid{{{10.0, 10.0, 10.0}}, {0}, {9.5, 5.0, 5.0}};
  EXPECT_LT(ProbeField(model, fluid, 0, kernel_table(choose_isa("auto"))).energy({0.6, 5.0, 5.0}), -0.3);
  fluid.box.periodic = {false, true, true};
  EXPECT_EQ(ProbeField(model, fluid, 0, kernel_table(choose_isa("auto"))).energy({0.6, 5.0, 5.0}), 0.0);
}

TEST(OpenProbes, MovesChangeTheEnergyAsTheReferenceSays) {
  for (const PairForm& form : pair_forms())
    for (const PairCase& one : open_cases(form)) {
      Configuration now = one.configuration;
      PairMoves moves(one.model, now, kernel_table(choose_isa("auto")));
      std::mt19937_64 engine(1);
      std::uniform_real_distribution<double> by(-0.1, 0.1);
      for (int trial = 0; trial < 6; ++trial) {
        const std::size_t i = engine() % now.size();
        Configuration moved = now;
        for (std::size_t axis = 0; axis < 3; ++axis)
          moved.positions[3 * i + axis] += by(engine) + (trial % 3 == 2 ? 1.5 * now.box.length[axis] : 0.0);
        const auto before = evaluate_reference(one.model, now), after = evaluate_reference(one.model, moved);
        EXPECT_NEAR(moves.energy_change(i, moved.position(i)), after.energy - before.energy,
                    1e-12 * (before.magnitude + after.magnitude) + 1e-13)
            << one.name << ", trial " << trial;
        moves.accept();
        now = moved;
      }
    }
}

TEST(OpenProbes, AreRefusedBeyondTheLimitAndWithLongRangeCorrections) {
  PairModel model = lennard_jones();
  const kernels::KernelTable& table = kernel_table(choose_isa("auto"));
  Configuration fluid = slab(model, 108, {true, true, false});
  ProbeField field(model, fluid, 0, table);
  for (const double z : {1.1e7, -1.1e7}) {
    const std::string message = testing::refusal([&] { field.sample({1.0, 1.0, z}); });
    EXPECT_NE(message.find("open along z"), std::string::npos) << message;
  }
  EXPECT_NO_THROW(field.sample({1.0, 1.1e7, 1.0}));
  model.truncation = Truncation::tail;
  testing::refusal([&] { ProbeField(model, fluid, 0, table); });
  testing::refusal([&] { PairMoves(model, fluid, table); });
  // The minimum image knows no open axes that are too short.
  model.truncation = Truncation::shifted;
  model.images = ImageRule::minimum;
  fluid.box.length[2] = 1.0;
  EXPECT_NO_THROW(ProbeField(model, fluid, 0, table));
}

}  // namespace
}  // namespace lanescape
