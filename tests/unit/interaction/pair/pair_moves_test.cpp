#include "interaction/pair/pair_moves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "verification/cases.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

const kernels::KernelTable& best_table() { return kernel_table(available_isas().back()); }

bool is_allowed(const PairCase& one) {
  const double reach = one.model.form->has_diameters ? 3.0 : one.model.largest_cutoff();
  return one.configuration.size() > 0 && (one.model.images == ImageRule::all || one.configuration.box.shortest() >= 2.0 * reach);
}

// Some moves, small ones and such that leave the box; half of them are made. Each change is that of the reference's energy.
void expect_reference(const PairCase& one) {
  if (!is_allowed(one)) return;
  Configuration now = one.configuration;
  PairMoves moves(one.model, now, best_table());
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> by(-0.1, 0.1);
  for (int trial = 0; trial < 6; ++trial) {
    const std::size_t i = engine() % now.size();
    Configuration moved = now;
    for (std::size_t axis = 0; axis < 3; ++axis)
      moved.positions[3 * i + axis] += by(engine) + (trial % 3 == 2 ? 1.5 * now.box.length[axis] : 0.0);
    const auto before = evaluate_reference(one.model, now), after = evaluate_reference(one.model, moved);
    EXPECT_NEAR(moves.energy_change(i, moved.position(i)), after.energy - before.energy,
                1e-12 * (before.magnitude + after.magnitude))
        << one.name << ", trial " << trial;
    if (trial % 2 != 0) continue;
    moves.accept();
    now = moved;
  }
  EXPECT_EQ(moves.positions(), now.positions) << one.name;
}

TEST(PairMoves, ChangeTheEnergyAsTheReferenceSays) {
  for (const PairCase& one : pair_cases())
    if (one.configuration.size() <= 300) expect_reference(one);
}

TEST(PairMoves, OfEveryFormChangeTheEnergyAsTheReferenceSays) {
  for (const PairForm& form : pair_forms())
    for (const PairCase& one : form_cases(form)) expect_reference(one);
}

TEST(PairMoves, AddUpOverALongChain) {
  const PairModel model = kob_andersen();
  const Configuration start = fcc_start(model, 1000, 1.2, 1);
  const ParticleLayout layout = ParticleLayout::in_users_order(start, 2);
  PairInteraction interaction(model, start.box, layout, best_table());
  PairMoves moves(model, start, best_table());
  double energy = interaction.energy(layout.to_slots(start.positions));
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> by(-0.1, 0.1), chance(0.0, 1.0);
  std::size_t accepted = 0;
  for (int trial = 1; trial <= 100000; ++trial) {
    const std::size_t i = engine() % 1000;
    Point to = point_at(moves.positions().data(), i);
    for (double& x : to) x += by(engine);
    const double change = moves.energy_change(i, to);
    if (chance(engine) < std::exp(-change)) {
      moves.accept();
      energy += change;
      ++accepted;
    }
    if (trial % 20000 != 0) continue;
    EXPECT_NEAR(energy, interaction.energy(layout.to_slots(moves.positions())), 1e-9) << "after " << trial << " trials";
  }
  EXPECT_GT(accepted, 20000U);
  EXPECT_LT(accepted, 95000U);
}

TEST(PairMoves, ToThePlaceOfAnotherAreInfinite) {
  const Configuration start = fcc_start(lennard_jones(), 108, 0.8, 1);
  PairMoves moves(lennard_jones(), start, best_table());
  EXPECT_FALSE(std::isfinite(moves.energy_change(3, start.position(4))));
  EXPECT_NEAR(moves.energy_change(3, start.position(3)), 0.0, 1e-12);
}

TEST(PairMoves, AreRefusedWhereTheyMakeNoSense) {
  const PairModel model = lennard_jones();
  const Configuration start = fcc_start(model, 108, 0.8, 1);
  PairMoves moves(model, start, best_table());
  EXPECT_THROW(moves.accept(), Error);
  const double change = moves.energy_change(2, {1.0, 1.2, 1.1});
  EXPECT_THROW(moves.energy_change(108, {1.0, 1.0, 1.0}), Error);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(moves.energy_change(5, {1.0, bad, 1.0}), Error);
  EXPECT_EQ(moves.energy_change(2, {1.0, 1.2, 1.1}), change);
  PairModel minimum = model;
  minimum.images = ImageRule::minimum;
  EXPECT_THROW(PairMoves(minimum, fcc_start(model, 32, 0.8, 1), best_table()), Error);
}

}  // namespace
}  // namespace lanescape
