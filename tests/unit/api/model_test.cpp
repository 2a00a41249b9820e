#include <lanescape/model.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <lanescape/potential.hpp>

#include "refusal.hpp"
#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::refusal;

PairParameters argon_and_krypton() {
  PairParameters p;
  p.species = {{"Ar", 1.0, 0.5}, {"Kr", 2.1, 0.5}};
  p.epsilon = {1.0, 1.2, 1.2, 1.4};
  p.sigma = {1.0, 1.05, 1.05, 1.1};
  return p;
}

TEST(Model, OfEveryNameIsThatOfItsOwnText) {
  const std::vector<std::string> names = model_names();
  EXPECT_NE(std::find(names.begin(), names.end(), "kob-andersen"), names.end());
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const Model model = Model::named(name);
    EXPECT_EQ(Model::from_toml(model.to_toml()), model);
    EXPECT_FALSE(model.species().empty());
    EXPECT_GT(model.length_unit(), 0.0);
    EXPECT_EQ(model.is_hard(), model.largest_cutoff() == 0.0);
  }
  EXPECT_FALSE(Model::named("kob-andersen") == Model::named("lennard-jones"));
}

TEST(Model, OfParametersHasTheirNumbers) {
  const Model model = Model::mixture(argon_and_krypton());
  EXPECT_EQ(model.species_count(), 2u);
  EXPECT_EQ(model.find_species("Kr"), 1);
  EXPECT_EQ(model.species()[1].mass, 2.1);
  EXPECT_DOUBLE_EQ(model.largest_cutoff(), 2.5 * 1.1);
  Potential potential(model, std::vector<int>{0, 1}, {10.0, 10.0, 10.0});
  const double r = 1.05;  // where 4 epsilon (1 - 1) is only the shift
  const double s6 = std::pow(1.0 / 2.5, 6);
  EXPECT_NEAR(potential.energy(std::vector<double>{0.0, 0.0, 0.0, r, 0.0, 0.0}), -4.0 * 1.2 * (s6 * s6 - s6), 1e-12);
}

TEST(Model, OfAPotentialWithNumbersTakesThemByName) {
  PairParameters p = argon_and_krypton();
  p.form = "yukawa";
  EXPECT_EQ(refusal([&] { Model::mixture(p); }), "number 'kappa' of potential yukawa is missing");
  p.numbers = {{"kappa", 1.2}};
  EXPECT_EQ(Model::from_toml(Model::mixture(p).to_toml()), Model::mixture(p));
  p.numbers["q"] = 3.0;
  EXPECT_NE(refusal([&] { Model::mixture(p); }).find("potential yukawa has no number 'q': it has kappa"), std::string::npos);
}

TEST(Model, OfHardSpheresHasNoCutoff) {
  HardSphereParameters p;
  p.species = {{"Xe"}, {"Ar"}};
  p.diameters = {1.4, 1.0};
  const Model model = Model::hard_spheres(p);
  EXPECT_TRUE(model.is_hard());
  EXPECT_EQ(model.largest_cutoff(), 0.0);
  p.diameters = {1.4};
  EXPECT_FALSE(refusal([&] { Model::hard_spheres(p); }).empty());
}

TEST(Model, IsReadFromAFile) {
  const testing::TemporaryFolder folder;
  const Model model = Model::mixture(argon_and_krypton());
  EXPECT_EQ(Model::from_file(folder.file("m.toml", model.to_toml()).string()), model);
  EXPECT_NE(refusal([&] { Model::from_file((folder.path() / "none.toml").string()); }).find("there is no such file"),
            std::string::npos);
  EXPECT_EQ(refusal([] { Model::from_toml("kind ="); }).rfind("model text:1: ", 0), 0u);
}

TEST(Model, RefusesWhatCannotBe) {
  EXPECT_NE(refusal([] { Model::named("water"); }).find("unknown model 'water': allowed are kob-andersen, lennard-jones"),
            std::string::npos);
  EXPECT_EQ(refusal([] { Model::named("hard-sphere", {.cutoff = 2.0}); }),
            "model hard-sphere has no cutoff, truncation or images to change: models of pair potentials have");
  EXPECT_NE(refusal([] { Model::named("lennard-jones", {.cutoff = -1.0}); }).find("cutoff -1 is not allowed"), std::string::npos);
  EXPECT_NE(refusal([] { Model::named("lennard-jones", {.truncation = "abrupt"}); }).find("unknown truncation 'abrupt'"),
            std::string::npos);
  EXPECT_EQ(refusal([] { Model::named("lennard-jones", {.images = "some"}); }),
            "unknown image rule 'some': allowed are all, minimum");
  PairParameters p = argon_and_krypton();
  p.epsilon.pop_back();
  EXPECT_EQ(refusal([&] { Model::mixture(p); }), "epsilon has 3 entries: 4 are needed, one for each pair of 2 species");
  p = argon_and_krypton();
  p.species[1].name = "K r";
  EXPECT_EQ(refusal([&] { Model::mixture(p); }),
            "model mixture: the name of a species is a column in files: blanks are not allowed in it");
  p = argon_and_krypton();
  p.name = "two\nlines";
  EXPECT_EQ(refusal([&] { Model::mixture(p); }), "the name of a model is one line, without control characters");
  p = argon_and_krypton();
  p.sigma[1] = 7.0;
  EXPECT_FALSE(refusal([&] { Model::mixture(p); }).empty());  // not symmetric
  p = argon_and_krypton();
  p.form = "coulomb";
  EXPECT_FALSE(refusal([&] { Model::mixture(p); }).empty());
}

}  // namespace
}  // namespace lanescape
