#include "io/model_file.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <ostream>
#include <sstream>
#include <string>
#include <variant>

#include "test_files.hpp"
#include "verification/state_mixture_cases.hpp"

namespace lanescape {
namespace {

using testing::expect_contains;
using testing::refusal;
using testing::TemporaryFolder;

const std::string kind = "kind = 'lennard-jones'\n";
const std::string species = "[[species]]\nname = 'Ni'\n[[species]]\nname = 'P'\n";  // 4 lines
const std::string pairs =
    "[[pair]]\nspecies = ['Ni', 'Ni']\nepsilon = 1\nsigma = 1\n"
    "[[pair]]\nspecies = ['P', 'Ni']\nepsilon = 1.5\nsigma = 0.8\n"
    "[[pair]]\nspecies = ['P', 'P']\nepsilon = 0.5\nsigma = 0.88\n";

template <class Kind = PairModel>
Kind read(const std::string& content) {
  const TemporaryFolder folder;
  return std::get<Kind>(read_model_file(folder.file("mixture.toml", content)));
}

void expect_equal_mixtures(const Mixture& a, const Mixture& b) {
  EXPECT_EQ(a.name, b.name);
  ASSERT_EQ(a.species.size(), b.species.size());
  for (std::size_t s = 0; s < a.species.size(); ++s) {
    EXPECT_EQ(a.species[s].name, b.species[s].name);
    EXPECT_EQ(a.species[s].mass, b.species[s].mass);
    EXPECT_EQ(a.species[s].fraction, b.species[s].fraction);
  }
}

void expect_equal(const PairModel& a, const PairModel& b) {
  expect_equal_mixtures(a, b);
  EXPECT_EQ(a.epsilon, b.epsilon);
  EXPECT_EQ(a.sigma, b.sigma);
  EXPECT_EQ(a.cutoff, b.cutoff);
  EXPECT_EQ(a.truncation, b.truncation);
  EXPECT_EQ(a.images, b.images);
}

void expect_equal(const HardSphereModel& a, const HardSphereModel& b) {
  expect_equal_mixtures(a, b);
  EXPECT_EQ(a.diameters, b.diameters);
}

void expect_equal(const StateMixtureModel& a, const StateMixtureModel& b) {
  expect_equal_mixtures(a, b);
  EXPECT_EQ(a.cutoff, b.cutoff);
  EXPECT_EQ(a.entropy_temperature, b.entropy_temperature);
  EXPECT_EQ(a.filter, b.filter);
  ASSERT_EQ(a.states.size(), b.states.size());
  for (std::size_t s = 0; s < a.states.size(); ++s) {
    EXPECT_EQ(a.states[s].mu, b.states[s].mu);
    EXPECT_EQ(a.states[s].switching.threshold, b.states[s].switching.threshold);
    EXPECT_EQ(a.states[s].switching.width, b.states[s].switching.width);
    EXPECT_EQ(a.states[s].switching.cutoff, b.states[s].switching.cutoff);
    ASSERT_EQ(a.states[s].steps.size(), b.states[s].steps.size());
    for (std::size_t k = 0; k < a.states[s].steps.size(); ++k) {
      EXPECT_EQ(a.states[s].steps[k].threshold, b.states[s].steps[k].threshold);
      EXPECT_EQ(a.states[s].steps[k].width, b.states[s].steps[k].width);
    }
    for (std::size_t t = 0; t < a.states.size(); ++t)
      for (std::size_t x = 0; x < a.states_of(s); ++x)
        for (std::size_t y = 0; y < a.states_of(t); ++y) {
          const auto &u = a.potentials[a.potential_at(s, x, t, y)], &v = b.potentials[b.potential_at(s, x, t, y)];
          ASSERT_EQ(u.index(), v.index());
          if (const auto* lj = std::get_if<StateMixtureModel::LennardJones>(&u)) {
            EXPECT_EQ(lj->epsilon, std::get<StateMixtureModel::LennardJones>(v).epsilon);
            EXPECT_EQ(lj->sigma, std::get<StateMixtureModel::LennardJones>(v).sigma);
          } else {
            const auto &one = std::get<StateMixtureModel::Table>(u), &other = std::get<StateMixtureModel::Table>(v);
            EXPECT_EQ(one.first, other.first);
            EXPECT_EQ(one.last, other.last);
            EXPECT_EQ(one.values, other.values);
          }
        }
  }
}

TEST(ModelFile, ModelsWithStatesAreReadBackBitForBit) {
  using Variant = StateMixtureVariant;
  for (const Variant& variant :
       {Variant{1, 1}, Variant{1, 2, Variant::Filter::every, Variant::Potentials::tables},
        Variant{2, 3, Variant::Filter::asymmetric, Variant::Potentials::both, 0.7}, Variant{3, 2, Variant::Filter::cross}}) {
    const StateMixtureModel model = state_mixture_model(variant);
    std::ostringstream out;
    write_model_file(out, model);
    expect_equal(read<StateMixtureModel>(out.str()), model);
  }
}

TEST(ModelFile, WidthsAreATenthOfThresholdsAndFiltersOneWhereNotGiven) {
  const StateMixtureModel model = read<StateMixtureModel>(
      "kind = 'ucg'\n[[species]]\nname = 'Ar'\n[species.density]\nthreshold = 1.4\ncutoff = 2.0\n"
      "[[species.state]]\nthreshold = 5.0\n[[species.state]]\n[[species]]\nname = 'Kr'\n[species.density]\nthreshold = 1\ncutoff = "
      "2\n"
      "[[species.state]]\n[[filter]]\nof = 'Kr'\ncounts = 'Ar'\nweight = 0\n"
      "[[pair]]\nspecies = ['Ar', 'Ar']\nstates = [0, 0]\nepsilon = 1\nsigma = 1\n"
      "[[pair]]\nspecies = ['Ar', 'Ar']\nstates = [1, 0]\nepsilon = 1\nsigma = 1\n"
      "[[pair]]\nspecies = ['Ar', 'Ar']\nstates = [1, 1]\nepsilon = 1\nsigma = 1\n"
      "[[pair]]\nspecies = ['Ar', 'Kr']\nstates = [0, 0]\nepsilon = 1\nsigma = 1\n"
      "[[pair]]\nspecies = ['Kr', 'Ar']\nstates = [0, 1]\nepsilon = 1\nsigma = 1\n"
      "[[pair]]\nspecies = ['Kr', 'Kr']\nepsilon = 1\nsigma = 1\n");
  EXPECT_DOUBLE_EQ(model.states[0].switching.width, 0.14);
  EXPECT_DOUBLE_EQ(model.states[0].steps[0].width, 0.5);
  EXPECT_EQ(model.filter, (std::vector<double>{1.0, 1.0, 0.0, 1.0}));
  EXPECT_EQ(model.states_of(1), 1U);
  EXPECT_EQ(model.states[0].mu, (std::vector<double>{0.0, 0.0}));
}

TEST(ModelFile, KobAndersenFromAFileIsTheNamedModel) {
  const PairModel model = read(
      "kind = \"lennard-jones\"  # a comment\nname = \"kob-andersen\"\ncutoff = 2.5\ntruncation = \"shifted\"\nimages = "
      "\"all\"\n"
      "[[species]]\nname = \"Ni\"\nmass = 1.0\nfraction = 0.8\n[[species]]\nname = \"P\"\nfraction = 0.2\n" +
      pairs);
  expect_equal(model, kob_andersen());
}

TEST(ModelFile, WhatIsLeftOutHasItsDefault) {
  const PairModel model = read(kind + species + pairs);
  EXPECT_EQ(model.name, "mixture");
  EXPECT_EQ(model.cutoff, 2.5);
  EXPECT_EQ(model.truncation, Truncation::shifted);
  EXPECT_EQ(model.images, ImageRule::all);
  for (const Species& s : model.species) {
    EXPECT_EQ(s.mass, 1.0);
    EXPECT_EQ(s.fraction, 0.5);
  }
}

TEST(ModelFile, EveryOptionIsRead) {
  const PairModel model = read(kind + "cutoff = 3\ntruncation = 'tail'\nimages = 'minimum'\n" + species + pairs);
  EXPECT_EQ(model.cutoff, 3.0);
  EXPECT_EQ(model.truncation, Truncation::tail);
  EXPECT_EQ(model.images, ImageRule::minimum);
}

TEST(ModelFile, APairInEitherOrderFillsBothTriangles) {
  const PairModel model = read(kind + species + pairs);
  EXPECT_EQ(model.epsilon, (std::vector<double>{1.0, 1.5, 1.5, 0.5}));
  EXPECT_EQ(model.sigma, (std::vector<double>{1.0, 0.8, 0.8, 0.88}));
}

TEST(ModelFile, WrittenModelsReadBackBitForBit) {
  PairModel model = kob_andersen();
  model.name = "a \"quoted\" \\ name";
  model.species[0] = {"it's", 1.0 / 3.0, 0.30000000000000004};
  model.species[1].fraction = 0.7;
  model.epsilon[1] = model.epsilon[2] = 1e22;
  model.epsilon[3] = 0.0;
  model.sigma[0] = 1.0000000000000002;
  model.cutoff = 2.0;
  model.truncation = Truncation::plain;
  model.images = ImageRule::minimum;
  std::ostringstream out;
  write_model_file(out, model);
  expect_equal(read(out.str()), model);
}

TEST(ModelFile, BinaryHardSpheresFromAFileAreTheNamedModel) {
  const auto model = read<HardSphereModel>(
      "kind = 'hard-sphere'\nname = 'hard-sphere-binary'\n[[species]]\nname = 'Xe'\nmass = 1\nfraction = 0.5\ndiameter = 1.4\n"
      "[[species]]\nname = 'Ar'\nfraction = 0.5\ndiameter = 1\n");
  expect_equal(model, hard_sphere_binary());
}

TEST(ModelFile, HardSpheresHaveTheDefaultsOfOtherModels) {
  const auto model = read<HardSphereModel>("kind = 'hard-sphere'\n[[species]]\nname = 'Ar'\ndiameter = 2\n");
  EXPECT_EQ(model.name, "mixture");
  EXPECT_EQ(model.species[0].mass, 1.0);
  EXPECT_EQ(model.species[0].fraction, 1.0);
}

TEST(ModelFile, WrittenHardSpheresReadBackBitForBit) {
  HardSphereModel model = hard_sphere_binary();
  model.name = "a \"quoted\" \\ name";
  model.species[0] = {"it's", 1.0 / 3.0, 0.30000000000000004};
  model.species[1].fraction = 0.7;
  model.diameters = {1.4000000000000001, 1e-6};
  std::ostringstream out;
  write_model_file(out, model);
  expect_equal(read<HardSphereModel>(out.str()), model);
}

TEST(ModelFile, AModelTheReaderWouldRefuseIsNotWritten) {
  PairModel spaced = lennard_jones(), full = kob_andersen(), broken = lennard_jones();
  spaced.species[0].name = "two words";
  full.species[1].fraction = 1.0;
  broken.sigma[0] = std::numeric_limits<double>::quiet_NaN();
  HardSphereModel hollow = hard_sphere();
  hollow.diameters[0] = 0.0;
  std::ostringstream out;
  expect_contains(refusal([&] { write_model_file(out, hollow); }), "species Ar: diameter 0");
  expect_contains(refusal([&] { write_model_file(out, spaced); }), "model lennard-jones");
  expect_contains(refusal([&] { write_model_file(out, full); }), "fractions");
  expect_contains(refusal([&] { write_model_file(out, broken); }), "Ar-Ar");
  EXPECT_EQ(out.str(), "");
}

struct BadModel {
  const char* name;
  std::string content;
  int line;
  std::string mentions;
};
void PrintTo(const BadModel& bad, std::ostream* out) { *out << bad.name; }

class ModelFileRefusal : public ::testing::TestWithParam<BadModel> {};

TEST_P(ModelFileRefusal, NamesFileLineAndWhatIsAllowed) {
  const BadModel& bad = GetParam();
  const TemporaryFolder folder;
  const auto path = folder.file("bad.toml", bad.content);
  const std::string message = refusal([&] { read_model_file(path); });
  expect_contains(message, path.string() + ":" + std::to_string(bad.line) + ": ");
  expect_contains(message, bad.mentions);
}

std::string pair_section(const std::string& names, const std::string& epsilon = "1", const std::string& sigma = "1") {
  return "[[pair]]\nspecies = " + names + "\nepsilon = " + epsilon + "\nsigma = " + sigma + "\n";
}
std::string one_species(const std::string& lines) { return kind + "[[species]]\nname = 'Ar'\n" + lines; }
const std::string argon = one_species("");  // 3 lines

INSTANTIATE_TEST_SUITE_P(
    Header, ModelFileRefusal,
    ::testing::Values(BadModel{"BrokenToml", "kind = \n", 1, "TOML"}, BadModel{"Binary", std::string("\0\1\2", 3), 1, "TOML"},
                      BadModel{"KeyTwice", kind + kind, 2, "TOML"}, BadModel{"NoKind", species + pairs, 1, "'kind' is missing"},
                      BadModel{"UnknownKind", "\nkind = 'morse'\n", 2, "hard-sphere, ucg"},
                      BadModel{"KindIsNumber", "kind = 1\n", 1, "kind"},
                      BadModel{"UnknownKey", kind + "cut = 2.5\n" + species + pairs, 2, "unknown key 'cut': allowed are kind"},
                      BadModel{"EmptyName", kind + "name = ''\n" + species + pairs, 2, "name"},
                      BadModel{"CutoffIsZero", kind + "cutoff = 0\n" + species + pairs, 2, "above 0"},
                      BadModel{"CutoffIsNan", kind + "cutoff = nan\n" + species + pairs, 2, "finite"},
                      BadModel{"CutoffIsText", kind + "cutoff = '2.5'\n" + species + pairs, 2, "no number"},
                      BadModel{"UnknownTruncation", kind + "truncation = 'cut'\n" + species + pairs, 2, "shifted, plain, tail"},
                      BadModel{"UnknownImages", kind + "images = 'some'\n" + species + pairs, 2, "all, minimum"}),
    [](const auto& info) { return std::string(info.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Species, ModelFileRefusal,
    ::testing::Values(BadModel{"None", kind + pairs, 1, "'species' is missing"},
                      BadModel{"IsText", kind + "species = 'Ni'\n" + pairs, 2, "[[species]]"},
                      BadModel{"IsListOfTexts", kind + "species = ['Ni']\n" + pairs, 2, "[[species]]"},
                      BadModel{"IsEmptyList", kind + "species = []\n" + pairs, 2, "[[species]]"},
                      BadModel{"NoName", kind + "[[species]]\nmass = 1\n" + pairs, 2, "'name' is missing"},
                      BadModel{"UnknownKey", one_species("charge = 1\n"), 4,
                               "unknown key 'charge': allowed are name, mass, fraction"},
                      BadModel{"BlankInName", kind + "[[species]]\nname = 'N i'\n", 3, "blanks"},
                      BadModel{"Twice", kind + "[[species]]\nname = 'Ni'\n[[species]]\nname = 'Ni'\n" + pairs, 5, "given twice"},
                      BadModel{"MassIsZero", one_species("mass = 0\n"), 4, "above 0"},
                      BadModel{"MassIsInfinite", one_species("mass = inf\n"), 4, "finite"},
                      BadModel{"FractionAboveOne", one_species("fraction = 1.5\n"), 4, "from 0 to 1"},
                      BadModel{"SomeFractions", kind + "[[species]]\nname = 'Ni'\nfraction = 1\n[[species]]\nname = 'P'\n" + pairs,
                               2, "all or none"},
                      BadModel{"FractionsOfTooMuch", one_species("fraction = 0.9\n"), 2, "a sum of 1"}),
    [](const auto& info) { return std::string(info.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Pairs, ModelFileRefusal,
    ::testing::Values(BadModel{"None", argon, 1, "'pair' is missing"},
                      BadModel{"OneMissing", kind + species + pair_section("['Ni', 'P']") + pair_section("['P', 'P']"), 6,
                               "pair Ni-Ni is missing"},
                      BadModel{"Twice", kind + species + pairs + pair_section("['Ni', 'P']"), 19, "Ni-P is given twice"},
                      BadModel{"UnknownSpecies", argon + pair_section("['Ar', 'Kr']"), 5, "'Kr': model bad has Ar"},
                      BadModel{"ThreeSpecies", argon + pair_section("['Ar', 'Ar', 'Ar']"), 5, "two names"},
                      BadModel{"SpeciesIsText", argon + pair_section("'Ar'"), 5, "two names"},
                      BadModel{"SpeciesAreNumbers", argon + pair_section("[1, 1]"), 5, "text"},
                      BadModel{"NoSigma", argon + "[[pair]]\nspecies = ['Ar', 'Ar']\nepsilon = 1\n", 4, "'sigma' is missing"},
                      BadModel{"NoEpsilon", argon + "[[pair]]\nspecies = ['Ar', 'Ar']\nsigma = 1\n", 4, "'epsilon' is missing"},
                      BadModel{"UnknownKey", argon + pair_section("['Ar', 'Ar']") + "cutoff = 2\n", 8, "unknown key 'cutoff'"},
                      BadModel{"EpsilonIsNegative", argon + pair_section("['Ar', 'Ar']", "-1"), 6, "at least 0"},
                      BadModel{"SigmaIsZero", argon + pair_section("['Ar', 'Ar']", "1", "0.0"), 7, "above 0"},
                      BadModel{"SigmaIsNan", argon + pair_section("['Ar', 'Ar']", "1", "nan"), 7, "finite"}),
    [](const auto& info) { return std::string(info.param.name); });

std::string hard(const std::string& lines) { return "kind = 'hard-sphere'\n[[species]]\nname = 'Ar'\n" + lines; }

INSTANTIATE_TEST_SUITE_P(HardSpheres, ModelFileRefusal,
                         ::testing::Values(BadModel{"NoDiameter", hard(""), 2, "'diameter' is missing"},
                                           BadModel{"DiameterIsZero", hard("diameter = 0\n"), 4, "from 1e-6 to 1e6"},
                                           BadModel{"DiameterIsNegative", hard("diameter = -1.0\n"), 4, "from 1e-6 to 1e6"},
                                           BadModel{"DiameterIsNan", hard("diameter = nan\n"), 4, "from 1e-6 to 1e6"},
                                           BadModel{"DiameterIsInfinite", hard("diameter = inf\n"), 4, "from 1e-6 to 1e6"},
                                           BadModel{"DiameterIsText", hard("diameter = '1'\n"), 4, "diameter is no number"},
                                           BadModel{"UnknownKey", hard("diameter = 1\nsigma = 1\n"), 5,
                                                    "unknown key 'sigma': allowed are name, mass, fraction, diameter"},
                                           BadModel{"Pairs", hard("diameter = 1\n") + pair_section("['Ar', 'Ar']"), 5,
                                                    "unknown key 'pair': allowed are kind, name, species"},
                                           BadModel{"Cutoff", "cutoff = 2.5\n" + hard("diameter = 1\n"), 1, "unknown key 'cutoff'"},
                                           BadModel{"DiameterOfASoftSpecies", one_species("diameter = 1\n"), 4,
                                                    "unknown key 'diameter'"},
                                           BadModel{"FractionsOfTooMuch", hard("diameter = 1\nfraction = 0.9\n"), 2, "a sum of 1"}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(ModelFile, AZeroHasNoSign) {
  const std::string two =
      "kind = 'ucg'\ncutoff = 2.5\n[[species]]\nname = 'Ar'\n[species.density]\nthreshold = 1.5\ncutoff = 2\n"
      "[[species.state]]\nthreshold = 4\nmu = -0.0\n[[species.state]]\nmu = 0\n";
  std::string pairs_of_states;
  for (const char* states : {"[0, 0]", "[0, 1]", "[1, 1]"})
    pairs_of_states += "[[pair]]\nspecies = ['Ar', 'Ar']\nstates = " + std::string(states) + "\nepsilon = 1\nsigma = 1\n";
  const TemporaryFolder folder;
  const AnyModel model = read_model_file(folder.file("zero.toml", two + pairs_of_states));
  std::ostringstream first, second;
  write_model_file(first, model);
  write_model_file(second, read_model_file(folder.file("again.toml", first.str())));
  EXPECT_EQ(first.str(), second.str());
  EXPECT_EQ(first.str().find("-0"), std::string::npos);
}

TEST(ModelFile, AMissingFileIsRefusedByName) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "absent.toml";
  expect_contains(refusal([&] { read_model_file(path); }), path.string() + ": there is no such file");
}

TEST(ModelFile, AFolderIsRefusedByName) {
  const TemporaryFolder folder;
  expect_contains(refusal([&] { read_model_file(folder.path()); }), folder.path().string() + ": it is a folder");
}

TEST(ModelFile, AHugeFileIsRefusedByName) {
  const TemporaryFolder folder;
  const auto path = folder.file("huge.toml", std::string(2 << 20, '\n'));
  expect_contains(refusal([&] { read_model_file(path); }), path.string() + ": it is too large");
}

TEST(ModelFile, AnUnreadableFileIsRefusedByName) {
  if (::geteuid() == 0) GTEST_SKIP() << "root reads every file";
  const TemporaryFolder folder;
  const auto path = folder.file("secret.toml", kind);
  std::filesystem::permissions(path, std::filesystem::perms::none);
  expect_contains(refusal([&] { read_model_file(path); }), path.string() + ": it cannot be opened");
}

}  // namespace
}  // namespace lanescape
