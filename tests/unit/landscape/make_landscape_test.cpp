#include "landscape/make_landscape.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "landscape/pair_landscape.hpp"
#include "landscape/state_mixture_landscape.hpp"
#include "refusal.hpp"

namespace lanescape {
namespace {

std::unique_ptr<SoftLandscape> made(const AnyModel& model, double edge, const PairSearchOptions& options = {}) {
  const ParticleLayout layout({0, 0}, mixture_of(model).species.size());
  return make_landscape(model, Box{{edge, edge, edge}}, layout, choose_isa("auto"), options);
}

TEST(MakeLandscape, GivesEachSoftModelItsOwn) {
  EXPECT_NE(dynamic_cast<PairLandscape*>(made(lennard_jones(), 8.0).get()), nullptr);
  EXPECT_NE(dynamic_cast<StateMixtureLandscape*>(made(liquid_vapour(), 8.0).get()), nullptr);
}

TEST(MakeLandscape, RefusesWhatHasNone) {
  EXPECT_EQ(testing::refusal([] { made(hard_sphere(), 8.0); }), "model hard-sphere has no soft landscape: its spheres are hard");
  EXPECT_EQ(testing::refusal([] { made(liquid_vapour(), 8.0, {.precision = Precision::mixed}); }),
            "mixed precision is not allowed with model ucg: Lennard-Jones mixtures have it");
}

}  // namespace
}  // namespace lanescape
