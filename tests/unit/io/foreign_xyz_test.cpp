#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "configuration/pair_model.hpp"
#include "io/extended_xyz.hpp"

// Files of other programs; tools/make_foreign_xyz.py writes them.
namespace lanescape {
namespace {

struct ForeignFile {
  std::string name;
  std::size_t frames;
};
void PrintTo(const ForeignFile& file, std::ostream* out) { *out << file.name; }

std::filesystem::path folder() { return std::filesystem::path(LANESCAPE_TEST_DATA_DIR) / "foreign"; }

const std::vector<ForeignFile> files{{"ase-3.22.1", 2},        {"ase-3.22.1-empty", 1}, {"ase-3.29.0", 2},
                                     {"ase-3.29.0-empty", 1},  {"extxyz-0.4.6-c", 2},   {"extxyz-0.4.6-python", 2},
                                     {"lammps-convention", 2}, {"ovito-convention", 2}, {"ovito-numeric-pbc", 1}};

class ForeignXyz : public ::testing::TestWithParam<ForeignFile> {};

TEST_P(ForeignXyz, IsReadWithItsBoxSpeciesAndPositions) {
  const std::vector<Frame> frames = read_frames(folder() / (GetParam().name + ".extxyz"), kob_andersen());
  ASSERT_EQ(frames.size(), GetParam().frames);
  std::vector<double> positions{0.0, 1.0, 2.0, -3.5, 0.25, 17.0, 1.5, 4.75, 0.125, 3.0, 2.5, 5.0};
  for (const Frame& frame : frames) {
    EXPECT_EQ(frame.configuration.box, (Box{{4.0, 5.0, 6.0}}));
    EXPECT_EQ(frame.configuration.species, (std::vector<int>{0, 1, 0, 0}));
    EXPECT_EQ(frame.configuration.positions, positions);
    for (double& x : positions) x += 0.25;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, ForeignXyz, ::testing::ValuesIn(files), [](const auto& info) {
  std::string name = info.param.name;
  std::erase_if(name, [](char c) { return c == '-' || c == '.'; });
  return name;
});

TEST(ForeignXyzFiles, AllThatAreThereAreTested) {
  std::size_t there = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder())) ++there;
  EXPECT_EQ(there, files.size());
}

TEST(ForeignXyzFiles, OtherPairsOfAseAreTextWithoutTheirQuotes) {
  const auto info = read_frames(folder() / "ase-3.29.0.extxyz", kob_andersen()).front().info;
  EXPECT_EQ(info.at("title"), "a \"quoted\" text = [1, 2");
  EXPECT_EQ(info.at("several"), "_JSON [\"a\", \"b]\"]");
  EXPECT_EQ(info.at("flag"), "T");
  EXPECT_EQ(info.at("none"), "T");
  EXPECT_EQ(info.at("empty"), "");
  EXPECT_EQ(info.at("energy"), "-1.5");
}

}  // namespace
}  // namespace lanescape
