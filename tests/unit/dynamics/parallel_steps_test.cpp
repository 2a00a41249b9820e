// Steps of molecular and Langevin dynamics on several threads, where particles move in the loop that looks after the list.

#include <gtest/gtest.h>

#include <utility>

#include "configuration/lattice.hpp"
#include "core/thread_team.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/langevin.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "landscape/pair_landscape.hpp"

namespace lanescape {
namespace {

PairModel with_second_mass(PairModel model, double mass) {
  model.species[1].mass = mass;
  return model;
}

// Several ranges of slots and more than one thread for each loop.
struct Liquid {
  explicit Liquid(PairModel of = kob_andersen())
      : model(std::move(of)), start(fcc_start(model, 4000, 1.2, 1)), layout(start.species, model.species.size()) {}

  PairModel model;
  Configuration start;
  ParticleLayout layout;

  PairLandscape landscape(int threads, Precision precision = Precision::double_precision) const {
    const PairSearch search = precision == Precision::mixed ? PairSearch::clusters : PairSearch::list;
    return {model, start.box, layout, choose_isa("auto"), {.search = search, .threads = threads, .precision = precision}};
  }
};

// Knows nothing of moves: particles move first, then gradients are taken.
class Plain final : public SoftLandscape {
 public:
  explicit Plain(PairLandscape& inner) : inner_(&inner) {}
  std::size_t dimension() const override { return inner_->dimension(); }
  std::size_t particles() const override { return inner_->particles(); }
  const VectorAlgebra& algebra() const override { return inner_->algebra(); }
  double energy(const AlignedArray& position) override { return inner_->energy(position); }
  double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) override {
    return inner_->energy_and_gradient(position, gradient);
  }
  void gradient(const AlignedArray& position, AlignedArray& gradient) override { inner_->gradient(position, gradient); }

 private:
  PairLandscape* inner_;
};

struct State {
  AlignedArray position, velocity;
  bool operator==(const State&) const = default;
};

constexpr int steps = 30;  // with several rebuilds at T = 5

State after_verlet(SoftLandscape& landscape, const Liquid& liquid) {
  VelocityVerlet verlet(landscape, liquid.model, liquid.layout, liquid.layout.to_slots(liquid.start.positions), 4e-3);
  verlet.draw_velocities(5.0, 1);
  for (int k = 0; k < steps; ++k) verlet.step();
  return {verlet.position(), verlet.velocity()};
}

State after_langevin(SoftLandscape& landscape, const Liquid& liquid) {
  Langevin langevin(landscape, liquid.model, liquid.layout, liquid.layout.to_slots(liquid.start.positions),
                    {.temperature = 5.0, .time_step = 4e-3});
  for (int k = 0; k < steps; ++k) langevin.step();
  return {langevin.position(), langevin.velocity()};
}

TEST(ParallelSteps, HaveTheBitsOfParticlesThatMoveFirstOnAnyNumberOfThreads) {
  for (const double second_mass : {1.0, 2.5}) {
    const Liquid liquid(with_second_mass(kob_andersen(), second_mass));
    for (const Precision precision : {Precision::double_precision, Precision::mixed}) {
      PairLandscape one = liquid.landscape(1, precision);
      Plain plain(one);
      const State verlet = after_verlet(plain, liquid), langevin = after_langevin(plain, liquid);
      for (const int threads : {1, 2, 3}) {
        PairLandscape moved = liquid.landscape(threads, precision);
        EXPECT_TRUE(after_verlet(moved, liquid) == verlet) << threads << " threads, mass " << second_mass;
        EXPECT_TRUE(after_langevin(moved, liquid) == langevin) << threads << " threads, mass " << second_mass;
      }
    }
  }
}

// The interaction then works in another unit of length than the particles move in.
TEST(ParallelSteps, HaveTheSameBitsInAnyUnitOfLength) {
  PairModel large = kob_andersen();
  for (double& sigma : large.sigma) sigma *= 4.0;
  for (Species& species : large.species) species.mass /= 16.0;
  const Liquid liquid;
  Liquid scaled;
  scaled.model = large;
  for (double& edge : scaled.start.box.length) edge *= 4.0;
  for (double& x : scaled.start.positions) x *= 4.0;
  PairLandscape one = liquid.landscape(2), other = scaled.landscape(2);
  State state = after_verlet(one, liquid);
  const State in_other = after_verlet(other, scaled);
  for (double& x : state.position) x *= 4.0;
  EXPECT_EQ(state.position, in_other.position);
}

TEST(ParallelSteps, TakeThreeLoopsOfThreads) {
  const Liquid liquid;
  PairLandscape landscape = liquid.landscape(2);
  // Slow particles: no list is rebuilt.
  VelocityVerlet verlet(landscape, liquid.model, liquid.layout, liquid.layout.to_slots(liquid.start.positions), 1e-4);
  const std::uint32_t before = ThreadTeam::of_this_thread(2).loops();
  for (int k = 0; k < 10; ++k) verlet.step();
  EXPECT_EQ(ThreadTeam::of_this_thread(2).loops() - before, 30U);
}

}  // namespace
}  // namespace lanescape
