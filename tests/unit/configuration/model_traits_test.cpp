#include "configuration/model_traits.hpp"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>
#include <variant>

#include "core/overloaded.hpp"

namespace lanescape {
namespace {

// std::visit needs a function object that accepts every alternative. This one rejects a fourth kind, even one derived from a
// mixture.
struct FourthKind : Mixture {};
using AskEveryKind = decltype(Overloaded{[](const PairModel&) { return 1; }, [](const HardSphereModel&) { return 2; },
                                         [](const StateMixtureModel&) { return 3; }});
static_assert(std::is_invocable_v<AskEveryKind, const PairModel&>);
static_assert(std::is_invocable_v<AskEveryKind, const HardSphereModel&>);
static_assert(std::is_invocable_v<AskEveryKind, const StateMixtureModel&>);
static_assert(!std::is_invocable_v<AskEveryKind, const FourthKind&>, "a kind of model that misses an answer must not compile");

TEST(ModelTraits, TellTheFamily) {
  EXPECT_FALSE(is_hard(named_model("kob-andersen")));
  EXPECT_FALSE(is_hard(named_model("ucg")));
  EXPECT_TRUE(is_hard(named_model("hard-sphere-binary")));
}

TEST(ModelTraits, ImagesFollowTheModel) {
  PairModel model = lennard_jones();
  model.images = ImageRule::minimum;
  EXPECT_EQ(traits_of(model).images, ImageRule::minimum);
  model.images = ImageRule::all;
  EXPECT_EQ(traits_of(model).images, ImageRule::all);
  EXPECT_EQ(traits_of(liquid_vapour()).images, ImageRule::all);
}

TEST(ModelTraits, OnlySitesHaveStatesAndOnlyPairsHaveAPrecision) {
  EXPECT_TRUE(traits_of(lennard_jones()).has_precision);
  EXPECT_FALSE(traits_of(lennard_jones()).has_states);
  EXPECT_FALSE(traits_of(hard_sphere()).has_precision);
  EXPECT_FALSE(traits_of(hard_sphere()).has_states);
  EXPECT_FALSE(traits_of(liquid_vapour()).has_precision);
  EXPECT_TRUE(traits_of(liquid_vapour()).has_states);
  EXPECT_EQ(std::string(traits_of(hard_sphere()).particles), "hard spheres");
}

}  // namespace
}  // namespace lanescape
