#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "configuration/hard_sphere_model.hpp"
#include "configuration/pair_model.hpp"
#include "io/extended_xyz.hpp"
#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::expect_contains;
using testing::refusal;
using testing::TemporaryFolder;

Frame read(const std::string& content, const PairModel& model = kob_andersen()) {
  const TemporaryFolder folder;
  return read_single_frame(folder.file("frame.extxyz", content), model);
}

Configuration awkward_configuration() {
  Configuration configuration;
  configuration.box.length = {4.481404746557165, 1.0 / 3.0 * 16.0, 7.0};
  configuration.species = {1, 0, 0};
  configuration.positions = {0.1, -0.0, 5e-324, 1.0 / 3.0, 0.30000000000000004, 4.35e6, -1e-17, 2.2250738585072014e-308, 6.99};
  return configuration;
}

TEST(ExtendedXyz, WrittenFramesReadBackBitForBit) {
  const Configuration written = awkward_configuration();
  const std::map<std::string, std::string> info{{"energy", "-1.25"}, {"note", "two words"}, {"quoted", "a \"b\" \\ c"},
                                                {"empty", ""},       {"lines", "one\ntwo"}, {"list", "[1, 2]"}};
  std::ostringstream out;
  write_frame(out, written, kob_andersen(), info);
  const Frame result = read(out.str());
  EXPECT_EQ(result.configuration.box, written.box);
  EXPECT_EQ(result.configuration.species, written.species);
  EXPECT_EQ(result.configuration.positions, written.positions);
  EXPECT_TRUE(std::signbit(result.configuration.positions[1]));
  EXPECT_EQ(result.info, info);
}

TEST(ExtendedXyz, WrittenOpenAxesReadBack) {
  Configuration written = awkward_configuration();
  written.box.periodic = {true, false, false};
  std::ostringstream out;
  write_frame(out, written, kob_andersen(), {});
  expect_contains(out.str(), "pbc=\"T F F\"");
  const TemporaryFolder folder;
  ExtendedXyzReader reader(folder.file("open.extxyz", out.str()), kob_andersen(), SizeColumn::ignored, OpenAxes::allowed);
  EXPECT_EQ(reader.next()->configuration.box, written.box);
}

TEST(ExtendedXyz, WrittenFramesFollowEachOther) {
  std::ostringstream out;
  for (int i = 0; i < 2; ++i) write_frame(out, awkward_configuration(), kob_andersen(), {});
  const TemporaryFolder folder;
  EXPECT_EQ(read_frames(folder.file("two.extxyz", out.str()), kob_andersen()).size(), 2u);
}

TEST(ExtendedXyz, ForcesAreAColumnOfThree) {
  Configuration configuration;
  configuration.box.length = {4.0, 5.0, 6.0};
  configuration.species = {0};
  configuration.positions = {1.0, 2.0, 3.5};
  const std::vector<double> forces{0.1, -7.0, 1e30};
  std::ostringstream out;
  write_frame(out, configuration, kob_andersen(), {{"step", "3"}}, &forces);
  EXPECT_EQ(out.str(),
            "1\nLattice=\"4 0 0 0 5 0 0 0 6\" Properties=species:S:1:pos:R:3:forces:R:3 pbc=\"T T T\" step=3\n"
            "Ni 1 2 3.5 0.1 -7 1e+30\n");
  EXPECT_EQ(read(out.str()).configuration.positions, configuration.positions);
}

TEST(ExtendedXyz, RadiiAreAColumnAfterThePositions) {
  const Configuration written{Box{{4.0, 5.0, 6.0}}, {0, 1}, {1.0, 2.0, 3.5, 0.0, 0.0, 0.0}, {0.7, 1.0 / 3.0}};
  std::ostringstream out;
  write_frame(out, written, hard_sphere_binary(), {});
  EXPECT_EQ(out.str(),
            "2\nLattice=\"4 0 0 0 5 0 0 0 6\" Properties=species:S:1:pos:R:3:radius:R:1 pbc=\"T T T\"\n"
            "Xe 1 2 3.5 0.7\nAr 0 0 0 0.3333333333333333\n");
  const TemporaryFolder folder;
  const auto path = folder.file("hard.extxyz", out.str());
  EXPECT_EQ(read_single_frame(path, hard_sphere_binary(), SizeColumn::radius).configuration.radii, written.radii);
}

TEST(ExtendedXyz, DiametersAreAColumnOfTheirOwn) {
  Configuration written{Box{{4.0, 5.0, 6.0}}, {0, 0}, {1.0, 2.0, 3.5, 0.0, 0.0, 0.0}};
  written.diameters = {0.7, 1.0 / 3.0};
  std::ostringstream out;
  write_frame(out, written, lennard_jones(), {});
  EXPECT_EQ(out.str(),
            "2\nLattice=\"4 0 0 0 5 0 0 0 6\" Properties=species:S:1:pos:R:3:diameter:R:1 pbc=\"T T T\"\n"
            "Ar 1 2 3.5 0.7\nAr 0 0 0 0.3333333333333333\n");
  const TemporaryFolder folder;
  const auto path = folder.file("poly.extxyz", out.str());
  EXPECT_EQ(read_single_frame(path, lennard_jones(), SizeColumn::diameter).configuration.diameters, written.diameters);
  written.diameters = {0.5};
  expect_contains(refusal([&] { write_frame(out, written, lennard_jones(), {}); }), "2 particles and 1 diameters");
  written.diameters = {0.5, std::numeric_limits<double>::quiet_NaN()};
  expect_contains(refusal([&] { write_frame(out, written, lennard_jones(), {}); }), "diameter nan cannot be written");
}

TEST(ExtendedXyz, RadiiThatCouldNotBeReadBackAreNotWritten) {
  Configuration configuration = awkward_configuration();
  std::ostringstream out;
  configuration.radii = {0.5, 0.5};
  expect_contains(refusal([&] { write_frame(out, configuration, kob_andersen(), {}); }), "3 particles and 2 radii");
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    configuration.radii = {0.5, bad, 0.5};
    expect_contains(refusal([&] { write_frame(out, configuration, kob_andersen(), {}); }), "a finite number above 0");
  }
  EXPECT_EQ(out.str(), "");
}

TEST(ExtendedXyz, WhatCouldNotBeReadBackIsNotWritten) {
  const Configuration sound = awkward_configuration();
  const std::vector<double> short_forces(8, 0.0);
  std::ostringstream out;
  expect_contains(refusal([&] { write_frame(out, sound, kob_andersen(), {{"LATTICE", "x"}}); }), "'LATTICE'");
  expect_contains(refusal([&] { write_frame(out, sound, kob_andersen(), {{"two words", "x"}}); }), "'two words'");
  expect_contains(refusal([&] { write_frame(out, sound, kob_andersen(), {{"", "x"}}); }), "''");
  expect_contains(refusal([&] { write_frame(out, sound, kob_andersen(), {{"bell", "\a"}}); }), "bell");
  expect_contains(refusal([&] { write_frame(out, sound, kob_andersen(), {}, &short_forces); }), "8 force components");
  expect_contains(refusal([&] { write_frame(out, sound, lennard_jones(), {}); }), "model lennard-jones");
  expect_contains(refusal([&] { write_frame(out, Configuration{}, kob_andersen(), {}); }), "0 particles");
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace lanescape
