// The C interface has the C++ facade's numbers, to the bit.
#include <lanescape/lanescape.h>
#include <lanescape/lanescape.hpp>

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace lanescape {
namespace {

static_assert(LANESCAPE_GOAL_NOT_REACHED == static_cast<int>(ErrorCode::goal_not_reached));
static_assert(LANESCAPE_BAD_INPUT == static_cast<int>(ErrorCode::bad_input));
static_assert(LANESCAPE_INTERNAL == static_cast<int>(ErrorCode::internal));
static_assert(LANESCAPE_INTERRUPTED == static_cast<int>(ErrorCode::interrupted));

constexpr std::size_t particles = 108;

struct Handles {
  explicit Handles(const char* name) {
    EXPECT_EQ(lanescape_model_named(name, nullptr, &model), LANESCAPE_OK) << lanescape_last_error();
  }
  ~Handles() { lanescape_model_destroy(model); }
  lanescape_model* model = nullptr;
};

Start start_of(const char* name, double density) { return make_start(Model::named(name), particles, density); }

TEST(CInterface, MakesTheSameStart) {
  const Start expected = start_of("kob-andersen", 1.2);
  const Handles handles("kob-andersen");
  std::vector<int> species(particles);
  std::vector<double> positions(3 * particles), box(3);
  ASSERT_EQ(lanescape_make_start(handles.model, particles, 1.2, 1, species.data(), positions.data(), box.data(), nullptr),
            LANESCAPE_OK);
  EXPECT_EQ(species, expected.species);
  EXPECT_EQ(positions, expected.positions);
  EXPECT_EQ(box, std::vector<double>(expected.box.begin(), expected.box.end()));
}

TEST(CInterface, HasTheSameEnergyForcesStressAndEnergies) {
  const Start start = start_of("kob-andersen", 1.2);
  Potential potential(Model::named("kob-andersen"), start.species, start.box);
  std::vector<double> forces(3 * particles), energies(particles), c_forces(forces), c_energies(energies);
  const Evaluation expected =
      potential.evaluate(start.positions, {.forces = Vectors<double>::interleaved(forces), .energies = energies, .stress = true});

  const Handles handles("kob-andersen");
  lanescape_potential* c_potential = nullptr;
  ASSERT_EQ(lanescape_potential_create(handles.model, particles, start.species.data(), start.box.data(), nullptr, &c_potential),
            LANESCAPE_OK);
  Evaluation found;
  const lanescape_outputs outputs{sizeof outputs,      &found.energy,   &found.virial,
                                  found.stress.data(), c_forces.data(), c_energies.data()};
  ASSERT_EQ(lanescape_potential_evaluate(c_potential, start.positions.data(), &outputs), LANESCAPE_OK);
  EXPECT_EQ(found.energy, expected.energy);
  EXPECT_EQ(found.virial, expected.virial);
  EXPECT_EQ(found.stress, expected.stress);
  EXPECT_EQ(c_forces, forces);
  EXPECT_EQ(c_energies, energies);
  EXPECT_EQ(lanescape_potential_destroy(c_potential), LANESCAPE_OK);
}

TEST(CInterface, HasTheSameTrajectory) {
  const Start start = start_of("lennard-jones", 0.8);
  Potential potential(Model::named("lennard-jones"), start.species, start.box);
  MolecularDynamics dynamics(potential, {}, start.positions, 0.002);
  dynamics.draw_velocities(1.0, 7);
  dynamics.run(50);

  const Handles handles("lennard-jones");
  lanescape_potential* c_potential = nullptr;
  lanescape_dynamics* c_dynamics = nullptr;
  std::vector<double> positions(3 * particles), velocities(positions);
  ASSERT_EQ(lanescape_potential_create(handles.model, particles, start.species.data(), start.box.data(), nullptr, &c_potential),
            LANESCAPE_OK);
  ASSERT_EQ(lanescape_dynamics_create(c_potential, nullptr, start.positions.data(), 0.002, &c_dynamics), LANESCAPE_OK);
  EXPECT_EQ(lanescape_dynamics_draw_velocities(c_dynamics, 1.0, 7), LANESCAPE_OK);
  EXPECT_EQ(lanescape_dynamics_run(c_dynamics, 50), LANESCAPE_OK);
  EXPECT_EQ(lanescape_dynamics_get(c_dynamics, positions.data(), velocities.data()), LANESCAPE_OK);
  EXPECT_EQ(positions, dynamics.positions());
  EXPECT_EQ(velocities, dynamics.velocities());
  EXPECT_EQ(lanescape_dynamics_destroy(c_dynamics), LANESCAPE_OK);
  EXPECT_EQ(lanescape_potential_destroy(c_potential), LANESCAPE_OK);
}

TEST(CInterface, HasTheSamePairs) {
  const Start start = start_of("lennard-jones", 0.4);
  const NeighbourPairs expected = neighbour_pairs(start.positions, start.box, 2.5);
  lanescape_neighbours* neighbours = nullptr;
  lanescape_neighbour_pairs pairs{};
  pairs.size = sizeof pairs;
  lanescape_neighbour_options options;
  ASSERT_EQ(lanescape_neighbour_options_init(&options, sizeof options), LANESCAPE_OK);
  options.cutoff = 2.5;
  ASSERT_EQ(lanescape_neighbours_create(&options, &neighbours), LANESCAPE_OK);
  ASSERT_EQ(lanescape_neighbours_find(neighbours, particles, start.positions.data(), start.box.data(), nullptr, &pairs),
            LANESCAPE_OK);
  ASSERT_EQ(pairs.count, expected.first.size());
  for (std::size_t k = 0; k < pairs.count; ++k) {
    EXPECT_EQ(static_cast<std::size_t>(pairs.first[k]), expected.first[k]);
    EXPECT_EQ(static_cast<std::size_t>(pairs.second[k]), expected.second[k]);
    EXPECT_EQ(pairs.distance[k], expected.distance[k]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(pairs.shift[3 * k + axis], expected.shift[k][axis]);
      EXPECT_EQ(pairs.separation[3 * k + axis], expected.separation[k][axis]);
    }
  }
  EXPECT_EQ(lanescape_neighbours_destroy(neighbours), LANESCAPE_OK);
}

TEST(CInterface, HasTheSameInsertions) {
  const Start start = start_of("lennard-jones", 0.4);
  Inserter inserter(Model::named("lennard-jones"), start.species, start.positions, start.box);
  const std::vector<InsertedParticle> places = inserter.find({.energy = -4.0}, 3);
  const Handles handles("lennard-jones");
  lanescape_inserter* c_inserter = nullptr;
  ASSERT_EQ(lanescape_inserter_create(handles.model, particles, start.species.data(), start.positions.data(), start.box.data(),
                                      nullptr, &c_inserter),
            LANESCAPE_OK);
  lanescape_insertion_settings settings;
  EXPECT_EQ(lanescape_insertion_settings_init(&settings, sizeof settings), LANESCAPE_OK);
  settings.energy = -4.0;
  std::vector<double> positions(9), energies(3);
  lanescape_insertions insertions{};
  insertions.size = sizeof insertions;
  insertions.positions = positions.data();
  insertions.energies = energies.data();
  ASSERT_EQ(lanescape_inserter_find(c_inserter, &settings, 3, &insertions), LANESCAPE_OK);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(energies[k], places[k].energy);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(positions[3 * k + axis], places[k].position[axis]);
  }
  EXPECT_EQ(lanescape_inserter_destroy(c_inserter), LANESCAPE_OK);
}

// Two particles, r apart, turned by a third of a turn.
const std::vector<double> ends[2] = {{5.65, 5.0, 5.0, 4.35, 5.0, 5.0}, {4.6875, 5.541265877, 5.0, 5.3125, 4.458734123, 5.0}};

TEST(CInterface, HasTheSamePath) {
  const std::vector<int> two = {0, 0};
  const std::array<double, 3> box{10.0, 10.0, 10.0};
  const Path expected = find_path(Model::named("lennard-jones"), two, box, ends[0], ends[1], {});
  const Handles handles("lennard-jones");
  lanescape_path* path = nullptr;
  ASSERT_EQ(lanescape_find_path(handles.model, 2, two.data(), box.data(), ends[0].data(), ends[1].data(), nullptr, nullptr, &path),
            LANESCAPE_OK)
      << lanescape_last_error();
  lanescape_path_summary summary{};
  summary.size = sizeof summary;
  ASSERT_EQ(lanescape_path_summarise(path, &summary), LANESCAPE_OK);
  EXPECT_EQ(summary.outcome, expected.outcome);
  EXPECT_EQ(summary.length, expected.length);
  EXPECT_EQ(summary.ratio_squared, expected.ratio_squared);
  EXPECT_EQ(summary.evaluations, expected.evaluations);
  ASSERT_EQ(summary.frames, expected.frames.size());
  std::vector<double> frame(6);
  for (std::size_t k = 0; k < summary.frames; ++k) {
    EXPECT_EQ(lanescape_path_frame(path, k, frame.data()), LANESCAPE_OK);
    EXPECT_EQ(frame, expected.frames[k]);
  }
  EXPECT_EQ(lanescape_path_destroy(path), LANESCAPE_OK);
}

int throwing(void*, const double*, double*, double*) { throw std::runtime_error("out of order"); }
int throwing_progress(void*, double) { throw 7; }

TEST(CInterface, KeepsExceptionsOfCallbacksInside) {
  const lanescape_landscape landscape{sizeof landscape, nullptr, 2, throwing};
  lanescape_path* path = nullptr;
  EXPECT_EQ(lanescape_find_path_on(&landscape, ends[0].data(), ends[1].data(), nullptr, nullptr, &path), LANESCAPE_CALLBACK_FAILED);
  EXPECT_STREQ(lanescape_last_error(), "evaluate of the landscape threw an exception: out of order");
  EXPECT_EQ(lanescape_last_callback_error(), 0);

  const Handles handles("lennard-jones");
  const std::vector<int> two = {0, 0};
  const std::array<double, 3> box{10.0, 10.0, 10.0};
  lanescape_path_settings settings;
  EXPECT_EQ(lanescape_path_settings_init(&settings, sizeof settings), LANESCAPE_OK);
  settings.step = 1e-5;
  settings.progress = throwing_progress;
  EXPECT_EQ(
      lanescape_find_path(handles.model, 2, two.data(), box.data(), ends[0].data(), ends[1].data(), nullptr, &settings, &path),
      LANESCAPE_CALLBACK_FAILED);
  EXPECT_STREQ(lanescape_last_error(), "progress threw an exception");
  EXPECT_EQ(path, nullptr);
}

}  // namespace
}  // namespace lanescape
