#include "run/path_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "configuration/lattice.hpp"
#include "io/extended_xyz.hpp"
#include "run/path_nodes.hpp"
#include "test_files.hpp"

namespace lanescape {
namespace {

using testing::expect_contains;
using testing::refusal;
using testing::TemporaryFolder;

// A straight path of a mixture of unequal masses whose first species is not the first in the user's order.
std::vector<Configuration> some_path(const AnyModel& model, bool hard) {
  Configuration node;
  node.box = {{5.0, 6.0, 7.0}};
  node.species = {1, 0, 1};
  node.positions = {0.1, 0.2, 0.3, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0 / 7.0};
  if (hard) node.radii = std::get<HardSphereModel>(model).radii_of(node.species);
  std::vector<Configuration> path(4, node);
  for (std::size_t k = 1; k < path.size(); ++k)
    for (std::size_t i = 0; i < node.positions.size(); ++i)
      path[k].positions[i] += 0.01 * static_cast<double>(k) * std::sin(1.0 + static_cast<double>(i));
  return path;
}

PathFile checked(const AnyModel& model, bool hard) {
  const auto nodes = some_path(model, hard);
  const Isa isa = choose_isa("auto");
  const CheckedPath found = check_path(model, nodes, std::nullopt, isa);
  return path_file(model, nodes, hard ? std::nullopt : std::optional(found.landscape_energy), found.check, "contour", isa);
}

void expect_same(const PathFile& a, const PathFile& b) {
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t k = 0; k < a.nodes.size(); ++k) {
    EXPECT_EQ(a.nodes[k].positions, b.nodes[k].positions);
    EXPECT_EQ(a.nodes[k].species, b.nodes[k].species);
    EXPECT_EQ(a.nodes[k].radii, b.nodes[k].radii);
    EXPECT_EQ(a.nodes[k].box, b.nodes[k].box);
  }
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.isa, b.isa);
  EXPECT_EQ(a.landscape_energy, b.landscape_energy);
  EXPECT_EQ(a.tangents, b.tangents);
  EXPECT_EQ(a.multipliers, b.multipliers);
  EXPECT_EQ(a.excess, b.excess);
  EXPECT_EQ(a.segment_violation, b.segment_violation);
}

TEST(PathFile, KeepsEveryBitOfSoftAndHardPathsAndTheirModels) {
  const TemporaryFolder folder;
  for (const bool hard : {false, true}) {
    const AnyModel model = hard ? AnyModel(hard_sphere_binary()) : AnyModel(wahnstrom());
    const PathFile written = checked(model, hard);
    write_path_file(folder.path() / "path.h5", written);
    EXPECT_TRUE(is_path_file(folder.path() / "path.h5"));
    const PathFile read = read_path_file(folder.path() / "path.h5");
    expect_same(written, read);
    EXPECT_EQ(mixture_of(read.model).name, mixture_of(model).name);
    const Isa isa = choose_isa("auto");
    EXPECT_EQ(check_path(read.model, read.nodes, read.landscape_energy, isa).check.length,
              check_path(model, written.nodes, written.landscape_energy, isa).check.length);
  }
}

TEST(PathFile, TangentsAreUnitVectorsAlongTheSegmentsInTheUsersOrder) {
  const PathFile path = checked(hard_sphere_binary(), true);
  ASSERT_EQ(path.tangents.size(), 3u);
  double length = 0.0, along = 0.0;
  for (std::size_t i = 0; i < 9; ++i) {
    const double step = path.nodes[1].positions[i] - path.nodes[0].positions[i];
    length += step * step;
    along += step * path.tangents[0][i];
  }
  EXPECT_NEAR(along, std::sqrt(length), 1e-14);
}

TEST(PathFile, RefusesWhatIsCutShortDamagedOrNoPath) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "path.h5";
  write_path_file(file, checked(wahnstrom(), false));
  const std::string whole = testing::content_of(file);
  const PathFile path = read_path_file(file);
  int refused = 0;
  // Refused, or the same: no byte may be used that is not checked.
  const auto is_refused_or_same = [&](const std::string& content) {
    try {
      expect_same(read_path_file(folder.file("broken.h5", content)), path);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::bad_input);
      expect_contains(error.what(), "broken.h5");
      ++refused;
    }
  };
  for (const std::size_t length : {std::size_t{0}, std::size_t{8}, whole.size() / 2, whole.find_last_not_of('\0')})
    is_refused_or_same(whole.substr(0, length));
  EXPECT_EQ(refused, 4);
  for (std::size_t at = 100; at < whole.size(); at += 97) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    is_refused_or_same(damaged);
  }
  EXPECT_GT(refused, 10);
  EXPECT_FALSE(is_path_file(folder.file("text.extxyz", "3\n")));
  expect_contains(refusal([&] { read_path_file(folder.path() / "none.h5"); }), "none.h5");
}

TEST(PathFile, RefusesContentsThatDoNotGoTogether) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "path.h5";
  const auto refused = [&](const PathFile& path) {
    write_path_file(file, path);
    return refusal([&] { read_path_file(file); });
  };
  PathFile short_path = checked(wahnstrom(), false);
  short_path.nodes.resize(2);
  expect_contains(refused(short_path), "2 nodes is not allowed: at least 3");
  PathFile without_radii = checked(hard_sphere_binary(), true);
  for (Configuration& node : without_radii.nodes) node.radii.clear();
  expect_contains(refused(without_radii), "no radii");
  PathFile not_finite = checked(wahnstrom(), false);
  not_finite.nodes[2].positions[4] = std::numeric_limits<double>::infinity();
  expect_contains(refused(not_finite), "node 2, particle 1");
  PathFile other_species = checked(wahnstrom(), false);
  other_species.nodes[0].species[1] = 7;
  expect_contains(refused(other_species), "species 7");
  PathFile few = checked(wahnstrom(), false);
  few.multipliers.pop_back();
  expect_contains(refused(few), "multipliers");
}

TEST(PathFrames, GiveTheNodesAndTheLandscapeEnergyOfTheirComments) {
  const TemporaryFolder folder;
  const AnyModel model = wahnstrom();
  const auto nodes = some_path(model, false);
  const auto written = [&](std::size_t count, const std::map<std::string, std::string>& info) {
    std::ostringstream out;
    for (std::size_t k = 0; k < count; ++k) write_frame(out, nodes[k], mixture_of(model), info);
    return folder.file("path.extxyz", out.str());
  };
  EXPECT_EQ(read_path_frames(written(4, {}), model).landscape_energy, std::nullopt);
  const PathFile read = read_path_frames(written(4, {{landscape_energy_key, "-7.25"}}), model);
  EXPECT_EQ(read.landscape_energy, -7.25);
  ASSERT_EQ(read.nodes.size(), 4u);
  EXPECT_EQ(read.nodes[3].positions, nodes[3].positions);
  expect_contains(refusal([&] { read_path_frames(written(2, {}), model); }), "holds 2 frames: a path has at least 3");
  expect_contains(refusal([&] { read_path_frames(written(4, {{landscape_energy_key, "high"}}), model); }), "'high'");
  expect_contains(refusal([&] { read_path_frames(written(4, {}), hard_sphere_binary()); }), "path.extxyz");
}

TEST(CheckPath, RefusesNodesOfDifferentSystems) {
  const AnyModel model = wahnstrom();
  const auto refused = [&](auto change) {
    auto nodes = some_path(model, false);
    change(nodes[2]);
    return refusal([&] { check_path(model, nodes, std::nullopt, choose_isa("auto")); });
  };
  expect_contains(refused([](Configuration& node) { node.box.length[1] = 9.0; }), "node 2 of the path has other box edges");
  expect_contains(refused([](Configuration& node) { node.species[0] = 0; }), "node 2 of the path has other particles");
}

}  // namespace
}  // namespace lanescape
