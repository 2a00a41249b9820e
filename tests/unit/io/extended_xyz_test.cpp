#include "io/extended_xyz.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "configuration/pair_model.hpp"
#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::expect_contains;
using testing::refusal;
using testing::TemporaryFolder;

const std::string comment = "Lattice=\"4 0 0 0 5 0 0 0 6\" Properties=species:S:1:pos:R:3 pbc=\"T T T\"";
const std::string frame = "2\n" + comment + "\nNi 0 1 2\nP -3.5 1e-3 17\n";

std::string with_lattice(const std::string& lattice) {
  return "1\nLattice=\"" + lattice + "\" Properties=species:S:1:pos:R:3\nNi 0 1 2\n";
}
std::string with_properties(const std::string& properties) {
  return "1\nLattice=\"4 0 0 0 5 0 0 0 6\" Properties=" + properties + "\nNi 0 1 2\n";
}
std::string with_pbc(const std::string& pbc) {
  return "1\nLattice=\"4 0 0 0 5 0 0 0 6\" Properties=species:S:1:pos:R:3 pbc=" + pbc + "\nNi 0 1 2\n";
}
std::string with_particle(const std::string& line) { return "1\n" + comment + "\n" + line + "\n"; }

Frame read(const std::string& content, const PairModel& model = kob_andersen()) {
  const TemporaryFolder folder;
  return read_single_frame(folder.file("frame.extxyz", content), model);
}

TEST(ExtendedXyz, ReadsBoxSpeciesAndUnwrappedPositions) {
  const Configuration configuration = read(frame).configuration;
  EXPECT_EQ(configuration.box, (Box{{4.0, 5.0, 6.0}}));
  EXPECT_EQ(configuration.species, (std::vector<int>{0, 1}));
  EXPECT_EQ(configuration.positions, (std::vector<double>{0.0, 1.0, 2.0, -3.5, 1e-3, 17.0}));
}

TEST(ExtendedXyz, KeysOfTheContractIgnoreCaseAndPbcMayBeAbsent) {
  const Frame result = read("1\nLATTICE=\"4 0 0 0 5 0 0 0 6\" properties=species:S:1:pos:R:3 PBC='true T t'\nNi 0 1 2\n");
  EXPECT_EQ(result.configuration.box, (Box{{4.0, 5.0, 6.0}}));
  EXPECT_TRUE(result.info.empty());
  EXPECT_EQ(read(with_lattice("4 0 0 0 5 0 0 0 6")).configuration.size(), 1u);
}

TEST(ExtendedXyz, OpenAxesAreReadWhereTheyAreAllowed) {
  const TemporaryFolder folder;
  const auto box_of = [&](const std::string& pbc) {
    return ExtendedXyzReader(folder.file("open.extxyz", with_pbc(pbc)), kob_andersen(), SizeColumn::ignored, OpenAxes::allowed)
        .next()
        ->configuration.box;
  };
  EXPECT_EQ(box_of("\"F T T\""), (Box{{4.0, 5.0, 6.0}, {false, true, true}}));
  EXPECT_EQ(box_of("[1, 0, 1]"), (Box{{4.0, 5.0, 6.0}, {true, false, true}}));
  EXPECT_EQ(box_of("F"), (Box{{4.0, 5.0, 6.0}, {false, false, false}}));
  EXPECT_EQ(box_of("\"T T T\""), (Box{{4.0, 5.0, 6.0}}));
  expect_contains(refusal([&] { box_of("\"F T\""); }), "pbc \"F T\"");
}

TEST(ExtendedXyz, OtherPairsOfTheCommentLineAreKeptAsText) {
  const Frame result =
      read("1\n" + comment + " energy=-1.5 note=\"say \\\"hi\\\" = \\\\\" bare stress=[[1, 2], [3, 4]] spaced = x\nNi 0 1 2\n");
  const std::map<std::string, std::string> expected{
      {"energy", "-1.5"}, {"note", "say \"hi\" = \\"}, {"bare", "T"}, {"stress", "[[1, 2], [3, 4]]"}, {"spaced", "x"}};
  EXPECT_EQ(result.info, expected);
}

TEST(ExtendedXyz, OfARepeatedKeyTheLastValueCounts) {
  EXPECT_EQ(read("1\n" + comment + " step=1 step=2\nNi 0 1 2\n").info.at("step"), "2");
}

TEST(ExtendedXyz, ARepeatedBoxMustBeTheSame) {
  EXPECT_EQ(read("1\n" + comment + " Lattice=\"4 0 0 0 5 0 0 0 6\" pbc=\"T T T\"\nNi 0 1 2\n").configuration.box.length[0], 4.0);
}

TEST(ExtendedXyz, AnotherCaseBesideLatticeIsAnOrdinaryKey) {
  const Frame result = read("1\nlattice=fcc " + comment + "\nNi 0 1 2\n");
  EXPECT_EQ(result.configuration.box, (Box{{4.0, 5.0, 6.0}}));
  EXPECT_EQ(result.info, (std::map<std::string, std::string>{{"lattice", "fcc"}}));
}

TEST(ExtendedXyz, AMissingValueIsAnEmptyText) {
  const Frame result = read("1\nconfig_type= " + comment + " a= b = 'x y' note= \nNi 0 1 2\n");
  EXPECT_EQ(result.configuration.box, (Box{{4.0, 5.0, 6.0}}));
  EXPECT_EQ(result.info, (std::map<std::string, std::string>{{"config_type", ""}, {"a", ""}, {"b", "x y"}, {"note", ""}}));
}

TEST(ExtendedXyz, AByteOrderMarkIsSkipped) { EXPECT_EQ(read("\xEF\xBB\xBF" + frame).configuration.size(), 2u); }

TEST(ExtendedXyz, NumbersTooSmallForADoubleAreZero) {
  EXPECT_EQ(read(with_particle("Ni 1e-999 -1e-400 1d-999")).configuration.positions, (std::vector<double>{0.0, 0.0, 0.0}));
  EXPECT_EQ(read(with_particle("Ni 1.5D+00 0 0")).configuration.positions[0], 1.5);
}

TEST(ExtendedXyz, OtherColumnsAreSkippedInAnyOrder) {
  const Frame result = read(
      "1\nLattice=\"4 0 0 0 5 0 0 0 6\" Properties=id:I:1:pos:R:3:forces:R:3:species:S:1:fixed:L:1\n"
      "7 0.5 1 2 nan inf word P T\n");
  EXPECT_EQ(result.configuration.species, (std::vector<int>{1}));
  EXPECT_EQ(result.configuration.positions, (std::vector<double>{0.5, 1.0, 2.0}));
}

TEST(ExtendedXyz, TabsCarriageReturnsPlusSignsAndAMissingLastLineEndAreAccepted) {
  const Frame result = read("1 \r\n" + comment + "\r\n\tNi  +0.5\t1 2 \r\n\r\n \n");
  EXPECT_EQ(result.configuration.positions, (std::vector<double>{0.5, 1.0, 2.0}));
  EXPECT_EQ(read("1\n" + comment + "\nNi 0.5 1 2").configuration.size(), 1u);
}

TEST(ExtendedXyz, RoundOffOffTheDiagonalIsOrthorhombic) {
  EXPECT_EQ(read(with_lattice("4 4e-12 0 0 5 -5e-12 0 0 6")).configuration.box, (Box{{4.0, 5.0, 6.0}}));
}

TEST(ExtendedXyz, FramesAreReadOneByOne) {
  const TemporaryFolder folder;
  ExtendedXyzReader reader(folder.file("two.extxyz", frame + "1\n" + comment + "\nP 1 1 1\n\n"), kob_andersen());
  EXPECT_EQ(reader.next()->configuration.size(), 2u);
  EXPECT_EQ(reader.next()->configuration.size(), 1u);
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_FALSE(reader.next().has_value());
}

TEST(ExtendedXyz, AFrameThatFollowsNeedNotBeWhole) {
  const TemporaryFolder folder;
  const auto another_begins = [&](const std::string& content) {
    ExtendedXyzReader reader(folder.file("more.extxyz", content), kob_andersen());
    EXPECT_EQ(reader.next()->configuration.size(), 2u);
    return reader.another_begins();
  };
  EXPECT_FALSE(another_begins(frame));
  EXPECT_FALSE(another_begins(frame + "\n \n"));
  EXPECT_TRUE(another_begins(frame + "7"));
  EXPECT_TRUE(another_begins(frame + "7\nno box\nNi 1"));
  expect_contains(refusal([&] { another_begins(frame + "Ni 1 1 1\n"); }), "more.extxyz:5: 'Ni 1 1 1'");
}

TEST(ExtendedXyz, AllFramesOfAFileAreRead) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_frames(folder.file("three.extxyz", frame + frame + frame), kob_andersen()).size(), 3u);
}

TEST(ExtendedXyz, ASecondFrameIsRefusedWhereOneIsAllowed) {
  const TemporaryFolder folder;
  const auto path = folder.file("two.extxyz", frame + frame);
  const std::string message = refusal([&] { read_single_frame(path, kob_andersen()); });
  expect_contains(message, path.string());
  expect_contains(message, "exactly one is allowed");
}

struct BadFile {
  const char* name;
  std::string content;
  int line;              // line number in the message; 0: the file only
  std::string mentions;  // text about the error or the allowed values
};
void PrintTo(const BadFile& bad, std::ostream* out) { *out << bad.name; }

class ExtendedXyzRefusal : public ::testing::TestWithParam<BadFile> {};

TEST_P(ExtendedXyzRefusal, NamesFileLineAndWhatIsAllowed) {
  const BadFile& bad = GetParam();
  const TemporaryFolder folder;
  const auto path = folder.file("bad.extxyz", bad.content);
  const std::string message = refusal([&] { read_frames(path, kob_andersen()); });
  expect_contains(message, bad.line == 0 ? path.string() + ": " : path.string() + ":" + std::to_string(bad.line) + ": ");
  expect_contains(message, bad.mentions);
}

INSTANTIATE_TEST_SUITE_P(
    Files, ExtendedXyzRefusal,
    ::testing::Values(
        BadFile{"Empty", "", 0, "at least one"}, BadFile{"Blank", "\n \n", 2, "at least one"},
        BadFile{"NulInCount", std::string("2\0\n", 3), 1, "binary"},
        BadFile{"NulInParticle", "1\n" + comment + "\nNi 0 1 " + std::string("2\0\n", 3), 3, "binary"},
        BadFile{"EndlessLine", std::string(3u << 20, 'x'), 1, "too long"}, BadFile{"CountIsAWord", "two\n" + comment, 1, "'two'"},
        BadFile{"CountIsNegative", "-2\n" + comment, 1, "integer from 1 to 10000000"},
        BadFile{"CountIsZero", "0\n" + comment + "\n", 1, "from 1"}, BadFile{"CountIsFractional", "2.0\n" + comment, 1, "'2.0'"},
        BadFile{"CountIsAbsurd", "10000001\n" + comment, 1, "10000000"},
        BadFile{"CountOverflows", "99999999999999999999999\n" + comment, 1, "10000000"},
        BadFile{"CountWithCompany", "2 3\n" + comment, 1, "'2 3'"},
        BadFile{"CountHasControlCharacters", "\x1b[2J\n" + comment, 1, "?[2J"}, BadFile{"EndsAfterCount", "2\n", 1, "comment line"},
        BadFile{"NoParticles", "2\n" + comment + "\n", 2, "after 0 of 2"},
        BadFile{"FewerParticles", "3\n" + comment + "\nNi 0 1 2\nNi 1 1 2\n", 4, "after 2 of 3"},
        BadFile{"ManyClaimedFewThere", "10000000\n" + comment + "\nNi 0 1 2\n", 3, "after 1 of 10000000"},
        BadFile{"BlankParticleLine", "2\n" + comment + "\nNi 0 1 2\n\n", 4, "0 columns"},
        BadFile{"TrailingGarbage", frame + "\nthe end\n", 6, "only blank lines"},
        BadFile{"MoreParticles", frame + "Ni 1 1 1\n", 5, "'Ni 1 1 1'"},
        BadFile{"BadSecondFrame", frame + "1\n" + comment + "\nNi 0 1 x\n", 7, "'x'"}),
    [](const auto& info) { return std::string(info.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Comments, ExtendedXyzRefusal,
    ::testing::Values(
        BadFile{"NoLattice", "1\nProperties=species:S:1:pos:R:3\nNi 0 1 2\n", 2, "no Lattice"},
        BadFile{"PlainXyz", "1\na liquid, the first of a series\nNi 0 1 2\n", 2, "Lattice"},
        BadFile{"EmptyComment", "1\n\nNi 0 1 2\n", 2, "no Lattice"},
        BadFile{"NoProperties", "1\nLattice=\"4 0 0 0 5 0 0 0 6\"\nNi 0 1 2\n", 2, "no Properties=species:S:1:pos:R:3"},
        BadFile{"OpenQuote", "1\nLattice=\"4 0 0 0 5 0 0 0 6 Properties=species:S:1:pos:R:3\n", 2, "quote without an end"},
        BadFile{"OpenBracket", "1\n" + comment + " a=[1 2\n", 2, "bracket without an end"},
        BadFile{"OtherBox", "1\n" + comment + " Lattice=\"4 0 0 0 5 0 0 0 7\"\n", 2,
                "Lattice is given twice, \"4 0 0 0 5 0 0 0 6\" and \"4 0 0 0 5 0 0 0 7\": one value is allowed"},
        BadFile{"OtherBoxInOtherCases", "1\nLATTICE=\"4 5 6\" lattice=\"4 5 7\"\n", 2, "Lattice is given twice"},
        BadFile{"OtherPbc", "1\n" + comment + " pbc=\"T T F\"\n", 2, "pbc is given twice"},
        BadFile{"BoxOfAWord", "1\nlattice=fcc Properties=species:S:1:pos:R:3\n", 2, "'fcc'"},
        BadFile{"NoKey", "1\n" + comment + " =3\n", 2, "without a key"},
        BadFile{"LatticeWithoutAValue", "1\nLattice= Properties=species:S:1:pos:R:3\n", 2, "has 0 numbers"},
        BadFile{"LatticeOfOneNumber", with_lattice("4"), 2, "has 1 number: nine"},
        BadFile{"LatticeTooShort", with_lattice("4 5 6 7"), 2, "has 4 numbers"},
        BadFile{"LatticeIsTriclinicInRows", "1\nLattice=[[4, 0, 0], [1, 5, 0], [0, 0, 6]] Properties=species:S:1:pos:R:3\n", 2,
                "not orthorhombic"},
        BadFile{"LatticeTooLong", with_lattice("4 0 0 0 5 0 0 0 6 0"), 2, "more than 9"},
        BadFile{"LatticeIsAWord", with_lattice("4 0 0 0 five 0 0 0 6"), 2, "'five'"},
        BadFile{"LatticeIsNan", with_lattice("4 0 0 0 nan 0 0 0 6"), 2, "'nan'"},
        BadFile{"LatticeIsInfinite", with_lattice("inf 0 0 0 5 0 0 0 6"), 2, "'inf'"},
        BadFile{"LatticeIsZero", with_lattice("4 0 0 0 0 0 0 0 6"), 2, "edge 2 is 0"},
        BadFile{"LatticeIsNegative", with_lattice("4 0 0 0 5 0 0 0 -6"), 2, "edge 3 is -6"},
        BadFile{"LatticeIsTriclinic", with_lattice("4 0 0 1 5 0 0 0 6"), 2, "not orthorhombic"},
        BadFile{"LatticeIsSlightlyTriclinic", with_lattice("4 0 0 0 5 0 0 6.1e-12 6"), 2, "not orthorhombic"},
        BadFile{"PropertiesWithoutSpecies", with_properties("pos:R:3"), 2, "species 0 times"},
        BadFile{"PropertiesWithoutPositions", with_properties("species:S:1"), 2, "pos 0 times"},
        BadFile{"PropertiesWithTwoPositions", with_properties("species:S:1:pos:R:3:pos:R:3"), 2, "pos 2 times"},
        BadFile{"PositionsOfIntegers", with_properties("species:S:1:pos:I:3"), 2, "pos:I:3"},
        BadFile{"FlatPositions", with_properties("species:S:1:pos:R:2"), 2, "pos:R:2"},
        BadFile{"NumberedSpecies", with_properties("species:I:1:pos:R:3"), 2, "species:I:1"},
        BadFile{"UnknownColumnType", with_properties("species:S:1:pos:R:3:mass:X:1"), 2, "types S, R, I, L"},
        BadFile{"NoColumns", with_properties("species:S:1:pos:R:3:mass:R:0"), 2, "mass:R:0"},
        BadFile{"TooManyColumns", with_properties("species:S:1:pos:R:3:mass:R:18446744073709551615"), 2, "at most 1000"},
        BadFile{"BrokenTriplet", with_properties("species:S:1:pos:R"), 2, "triplets"},
        BadFile{"PbcOpenAlongOneAxis", with_pbc("\"T T F\""), 2, "pbc \"T T F\""},
        BadFile{"PbcOfTwoAxes", with_pbc("[T, T]"), 2, "\"T T T\""}, BadFile{"PbcIsOff", with_pbc("F"), 2, "pbc \"F\""},
        BadFile{"PbcOffInNumbers", with_pbc("[1, 0, 1]"), 2, "pbc \"[1, 0, 1]\""},
        BadFile{"PbcEmpty", with_pbc("\"\""), 2, "\"T T T\""}),
    [](const auto& info) { return std::string(info.param.name); });

INSTANTIATE_TEST_SUITE_P(Particles, ExtendedXyzRefusal,
                         ::testing::Values(BadFile{"TooFewColumns", with_particle("Ni 0 1"), 3, "3 columns"},
                                           BadFile{"TooManyColumns", with_particle("Ni 0 1 2 3"), 3, "5 columns"},
                                           BadFile{"UnknownSpecies", with_particle("Xx 0 1 2"), 3,
                                                   "'Xx': model kob-andersen has Ni, P"},
                                           BadFile{"SpeciesInLowerCase", with_particle("ni 0 1 2"), 3, "'ni'"},
                                           BadFile{"CoordinateIsAWord", with_particle("Ni 0 1 2x"), 3, "'2x'"},
                                           BadFile{"CoordinateIsNan", with_particle("Ni 0 nan 2"), 3, "'nan'"},
                                           BadFile{"CoordinateIsInfinite", with_particle("Ni 0 1 -inf"), 3, "'-inf'"},
                                           BadFile{"CoordinateOverflows", with_particle("Ni 0 1 1e400"), 3, "'1e400'"},
                                           BadFile{"CoordinateIsHuge", with_particle("Ni 4.1e6 1 2"), 3, "box lengths"},
                                           BadFile{"TwoSigns", with_particle("Ni +-1 1 2"), 3, "'+-1'"}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(ExtendedXyz, AMissingFileIsRefusedByName) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "absent.extxyz";
  const std::string message = refusal([&] { read_single_frame(path, kob_andersen()); });
  expect_contains(message, path.string());
  expect_contains(message, "no such file");
}

TEST(ExtendedXyz, AFolderIsRefusedByName) {
  const TemporaryFolder folder;
  const std::string message = refusal([&] { read_single_frame(folder.path(), kob_andersen()); });
  expect_contains(message, folder.path().string());
  expect_contains(message, "folder");
}

TEST(ExtendedXyz, AnUnreadableFileIsRefusedByName) {
  if (::geteuid() == 0) GTEST_SKIP() << "root reads every file";
  const TemporaryFolder folder;
  const auto path = folder.file("secret.extxyz", frame);
  std::filesystem::permissions(path, std::filesystem::perms::none);
  expect_contains(refusal([&] { read_single_frame(path, kob_andersen()); }), path.string() + ": it cannot be opened");
}

TEST(ExtendedXyz, EveryPrefixOfAFileIsRefusedOrEndsInTheLastNumber) {
  const TemporaryFolder folder;
  // A file cut inside the last coordinate is still well formed; a file cut before it never is.
  for (std::size_t length = 0; length + 3 < frame.size(); ++length) {
    const auto path = folder.file("cut.extxyz", frame.substr(0, length));
    refusal([&] { read_single_frame(path, kob_andersen()); });
  }
}

std::string hard_comment(const std::string& properties = "species:S:1:pos:R:3:radius:R:1") {
  return "Lattice=\"4 0 0 0 5 0 0 0 6\" Properties=" + properties;
}
std::string with_radius(const std::string& radius) { return "1\n" + hard_comment() + "\nAr 0 1 2 " + radius + "\n"; }

TEST(ExtendedXyz, RadiiAreReadWhereTheyAreRequired) {
  const TemporaryFolder folder;
  const auto path = folder.file(
      "hard.extxyz", "2\n" + hard_comment("radius:R:1:id:I:1:pos:R:3:species:S:1") + "\n0.7 1 0 1 2 Xe\n+5e-1 2 1 1 2 Ar\n");
  const Frame result = read_single_frame(path, hard_sphere_binary(), SizeColumn::radius);
  EXPECT_EQ(result.configuration.radii, (std::vector<double>{0.7, 0.5}));
  EXPECT_EQ(result.configuration.species, (std::vector<int>{0, 1}));
  EXPECT_EQ(result.configuration.positions, (std::vector<double>{0, 1, 2, 1, 1, 2}));
  EXPECT_TRUE(read_single_frame(path, hard_sphere_binary()).configuration.radii.empty());
}

TEST(ExtendedXyz, AnIgnoredSizeColumnMayHoldAnything) {
  const Frame result = read("1\n" + hard_comment("species:S:1:radius:S:2:pos:R:3") + "\nNi large -1 0 1 2\n");
  EXPECT_EQ(result.configuration.positions, (std::vector<double>{0, 1, 2}));
  EXPECT_TRUE(result.configuration.radii.empty());
}

std::string diameter_comment(const std::string& properties = "species:S:1:pos:R:3:diameter:R:1") {
  return hard_comment(properties);
}

TEST(ExtendedXyz, DiametersAreReadWhereTheyAreRequired) {
  const TemporaryFolder folder;
  const auto path = folder.file("poly.extxyz", "2\n" + diameter_comment("species:S:1:diameter:R:1:radius:R:1:pos:R:3") +
                                                   "\nAr 0.75 9 0 1 2\nAr 1.5 9 1 1 2\n");
  const Configuration result = read_single_frame(path, lennard_jones(), SizeColumn::diameter).configuration;
  EXPECT_EQ(result.diameters, (std::vector<double>{0.75, 1.5}));
  EXPECT_TRUE(result.radii.empty());
  EXPECT_EQ(result.positions, (std::vector<double>{0, 1, 2, 1, 1, 2}));
}

TEST(ExtendedXyz, ADiameterColumnThatIsNotNeededIsIgnored) {
  const TemporaryFolder folder;
  const auto path =
      folder.file("poly.extxyz", "1\n" + diameter_comment("species:S:1:pos:R:3:radius:R:1:diameter:S:1") + "\nAr 0 1 2 0.5 big\n");
  EXPECT_TRUE(read_single_frame(path, lennard_jones()).configuration.diameters.empty());
  EXPECT_TRUE(read_single_frame(path, hard_sphere(), SizeColumn::radius).configuration.diameters.empty());
}

TEST(ExtendedXyz, ADiameterThatIsMissingOrNoLengthIsRefusedByLine) {
  const auto message = [](const std::string& content) {
    const TemporaryFolder folder;
    const auto path = folder.file("poly.extxyz", content);
    return refusal([&] { read_frames(path, lennard_jones(), SizeColumn::diameter); });
  };
  for (const std::string bad : {"nan", "0", "-1", "inf", "big"}) {
    const std::string text = message("1\n" + diameter_comment() + "\nAr 0 1 2 " + bad + "\n");
    expect_contains(text, "poly.extxyz:3: diameter '" + bad + "' is not allowed: a finite number above 0 is needed");
  }
  expect_contains(message("1\n" + comment + "\nAr 0 1 2\n"), "diameter 0 times: polydisperse models need diameter:R:1 once");
  expect_contains(message("1\n" + diameter_comment("species:S:1:pos:R:3:diameter:I:1") + "\nAr 0 1 2 1\n"), "diameter:I:1");
}

TEST(ExtendedXyz, SpeciesNotKnownBeforehandAreNumberedInOrderOfAppearance) {
  const TemporaryFolder folder;
  const std::string particles = "\nKr 0 1 2 1\nAr 1 1 2 0.5\nKr 2 1 2 1\n";
  const auto path = folder.file("any.extxyz", "3\n" + hard_comment() + particles + "1\n" + hard_comment() + "\nXe 0 1 2 2\n");
  ExtendedXyzReader reader(path, SizeColumn::radius);
  EXPECT_TRUE(reader.mixture().species.empty());
  EXPECT_EQ(reader.next()->configuration.species, (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(reader.next()->configuration.species, (std::vector<int>{2}));
  ASSERT_EQ(reader.mixture().species.size(), 3u);
  EXPECT_EQ(reader.mixture().find_species("Kr"), 0);
  EXPECT_EQ(reader.mixture().find_species("Ar"), 1);
  EXPECT_EQ(reader.mixture().find_species("Xe"), 2);
}

TEST(ExtendedXyz, MoreSpeciesThanElementsAreRefused) {
  std::string content = "119\n" + comment + "\n";
  for (int i = 0; i < 119; ++i) content += "X" + std::to_string(i) + " 0 0 0\n";
  const TemporaryFolder folder;
  const auto path = folder.file("many.extxyz", content);
  const std::string message = refusal([&] { ExtendedXyzReader(path).next(); });
  expect_contains(message, path.string() + ":121: ");
  expect_contains(message, "'X118' is one too many: at most 118");
}

class RadiusRefusal : public ::testing::TestWithParam<BadFile> {};

TEST_P(RadiusRefusal, NamesFileLineAndWhatIsAllowed) {
  const BadFile& bad = GetParam();
  const TemporaryFolder folder;
  const auto path = folder.file("bad.extxyz", bad.content);
  const std::string message = refusal([&] { read_frames(path, hard_sphere(), SizeColumn::radius); });
  expect_contains(message, path.string() + ":" + std::to_string(bad.line) + ": ");
  expect_contains(message, bad.mentions);
}

INSTANTIATE_TEST_SUITE_P(
    Radii, RadiusRefusal,
    ::testing::Values(
        BadFile{"NoProperties", "1\nLattice=\"4 0 0 0 5 0 0 0 6\"\nAr 0 1 2\n", 2, "pos:R:3:radius:R:1 is needed"},
        BadFile{"NoColumn", "1\n" + comment + "\nAr 0 1 2\n", 2, "radius 0 times: hard spheres need radius:R:1"},
        BadFile{"ColumnTwice", "1\n" + hard_comment("species:S:1:pos:R:3:radius:R:1:radius:R:1") + "\nAr 0 1 2 1 1\n", 2,
                "radius 2 times"},
        BadFile{"Integers", "1\n" + hard_comment("species:S:1:pos:R:3:radius:I:1") + "\nAr 0 1 2 1\n", 2, "radius:I:1"},
        BadFile{"ThreeOfThem", "1\n" + hard_comment("species:S:1:pos:R:3:radius:R:3") + "\nAr 0 1 2 1 1 1\n", 2, "radius:R:3"},
        BadFile{"OneIsMissing", with_radius(""), 3, "4 columns"},
        BadFile{"IsZero", with_radius("0"), 3, "radius '0' is not allowed: a finite number above 0"},
        BadFile{"IsNegative", with_radius("-0.5"), 3, "'-0.5'"}, BadFile{"IsNan", with_radius("nan"), 3, "'nan'"},
        BadFile{"IsInfinite", with_radius("inf"), 3, "'inf'"}, BadFile{"IsAWord", with_radius("big"), 3, "'big'"},
        BadFile{"Overflows", with_radius("1e400"), 3, "'1e400'"}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace lanescape
