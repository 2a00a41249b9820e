#include "configuration/hard_sphere_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "configuration/model.hpp"
#include "core/error.hpp"

namespace lanescape {
namespace {

std::string fault(const HardSphereModel& model) {
  try {
    model.check();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return "";
}

TEST(HardSphereModel, OneComponentIsArgonOfDiameterOne) {
  const HardSphereModel model = hard_sphere();
  EXPECT_EQ(fault(model), "");
  EXPECT_EQ(model.name, "hard-sphere");
  ASSERT_EQ(model.species.size(), 1u);
  EXPECT_EQ(model.species[0].name, "Ar");
  EXPECT_EQ(model.diameters, (std::vector<double>{1.0}));
}

TEST(HardSphereModel, TheBinaryMixtureIsXenonAndArgonInEqualNumbers) {
  const HardSphereModel model = hard_sphere_binary();
  EXPECT_EQ(fault(model), "");
  EXPECT_EQ(model.name, "hard-sphere-binary");
  EXPECT_EQ(model.find_species("Xe"), 0);
  EXPECT_EQ(model.find_species("Ar"), 1);
  EXPECT_EQ(model.species[0].fraction, 0.5);
  EXPECT_EQ(model.species[1].fraction, 0.5);
  EXPECT_EQ(model.diameters, (std::vector<double>{1.4, 1.0}));
  EXPECT_TRUE(model.has_equal_masses());
}

TEST(HardSphereModel, RadiiAreHalfTheDiametersOfEachParticlesSpecies) {
  EXPECT_EQ(hard_sphere_binary().radii_of({1, 0, 1}), (std::vector<double>{0.5, 0.7, 0.5}));
}

TEST(HardSphereModel, DiametersOutOfRangeAreRefusedByName) {
  for (const double bad :
       {0.0, -1.0, 0.9e-6, 1.1e6, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    HardSphereModel model = hard_sphere_binary();
    model.diameters[1] = bad;
    EXPECT_NE(fault(model).find("species Ar: diameter"), std::string::npos) << bad;
  }
  for (const double good : {1e-6, 1e6}) {
    HardSphereModel model = hard_sphere();
    model.diameters[0] = good;
    EXPECT_EQ(fault(model), "");
  }
}

TEST(HardSphereModel, EverySpeciesNeedsADiameterAndASoundMass) {
  HardSphereModel short_of_one = hard_sphere_binary(), massless = hard_sphere();
  short_of_one.diameters.pop_back();
  massless.species[0].mass = 0.0;
  EXPECT_NE(fault(short_of_one).find("need 2 diameters, 1 are given"), std::string::npos);
  EXPECT_NE(fault(massless).find("species Ar: mass 0"), std::string::npos);
  EXPECT_NE(fault(HardSphereModel{}).find("has no species"), std::string::npos);
}

TEST(PackingFraction, IsTheShareOfTheBoxInsideSpheres) {
  const Configuration configuration{Box{{2.0, 3.0, 4.0}}, {0, 1}, std::vector<double>(6, 0.0), {0.5, 0.7}};
  EXPECT_DOUBLE_EQ(packing_fraction(configuration), std::numbers::pi / 6.0 * (1.0 + 1.4 * 1.4 * 1.4) / 24.0);
  EXPECT_EQ(packing_fraction({Box{{2.0, 3.0, 4.0}}, {}, {}}), 0.0);
}

TEST(NamedModel, FourNamesAreKnown) {
  for (const char* name : {"kob-andersen", "lennard-jones", "hard-sphere", "hard-sphere-binary"})
    EXPECT_EQ(mixture_of(named_model(name)).name, name);
  EXPECT_TRUE(std::holds_alternative<PairModel>(named_model("kob-andersen")));
  EXPECT_TRUE(std::holds_alternative<HardSphereModel>(named_model("hard-sphere")));
}

TEST(NamedModel, EveryNameIsThereAndPotentialsWithoutPresetsAreNot) {
  const std::vector<std::string> names = known_models();
  for (const std::string& name : names) std::visit([](const auto& model) { model.check(); }, named_model(name));
  EXPECT_EQ(names.size(), 13u);
  EXPECT_EQ(std::count(names.begin(), names.end(), "yukawa"), 0);  // its kappa has no default
}

TEST(NamedModel, AnUnknownNameIsRefusedWithTheNamesThereAre) {
  try {
    named_model("soft-sphere");
    FAIL() << "nothing was refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_EQ(error.what(), "unknown model 'soft-sphere': allowed are " + fmt::format("{}", fmt::join(known_models(), ", ")));
  }
}

}  // namespace
}  // namespace lanescape
