#include "interaction/pair/pair_interaction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "configuration/lattice.hpp"
#include "core/error.hpp"
#include "dispatch/isa.hpp"
#include "verification/cases.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape {
namespace {

using kernels::ImageSearch;

const kernels::KernelTable& best_table() { return kernel_table(available_isas().back()); }

Box cube(double length) { return {{length, length, length}}; }

PairCase case_named(const std::string& name) {
  for (auto& one : pair_cases())
    if (one.name == name) return one;
  throw std::invalid_argument("no case is named " + name);
}

// Evaluates through the interaction; results are in the user's order.
struct Result {
  PairInteraction::Evaluation sums;
  std::vector<double> gradient;
};

Result evaluate(const PairModel& model, const Configuration& configuration) {
  const ParticleLayout layout(configuration.species, model.species.size());
  PairInteraction interaction(model, configuration.box, layout, best_table());
  AlignedArray gradient(layout.dimension());
  Result result;
  result.sums = interaction.energy_and_stress(layout.to_slots(configuration.positions), gradient);
  result.gradient = layout.to_user(gradient);
  return result;
}

double energy(const PairModel& model, const Configuration& configuration) {
  const ParticleLayout layout(configuration.species, model.species.size());
  return PairInteraction(model, configuration.box, layout, best_table()).energy(layout.to_slots(configuration.positions));
}

// Distance of the separations of particle i from the nearest jump of the gradient: an image at the cutoff or, under the
// minimum-image rule, a separation of half a box.
double distance_to_jump(const PairModel& model, const Configuration& configuration, std::size_t i) {
  double least = std::numeric_limits<double>::infinity();
  const auto& box = configuration.box.length;
  for (std::size_t j = 0; j < configuration.size(); ++j) {
    const double cutoff = model.cutoff * model.sigma[model.pair(static_cast<std::size_t>(configuration.species[i]),
                                                                static_cast<std::size_t>(configuration.species[j]))];
    std::array<double, 3> nearest;
    std::array<int, 3> reach{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      nearest[axis] = std::remainder(configuration.positions[3 * i + axis] - configuration.positions[3 * j + axis], box[axis]);
      if (model.images == ImageRule::all) reach[axis] = static_cast<int>(cutoff / box[axis]) + 1;
      if (model.images == ImageRule::minimum) least = std::min(least, box[axis] / 2.0 - std::abs(nearest[axis]));
    }
    for (int x = -reach[0]; x <= reach[0]; ++x)
      for (int y = -reach[1]; y <= reach[1]; ++y)
        for (int z = -reach[2]; z <= reach[2]; ++z)
          least = std::min(
              least, std::abs(cutoff - std::hypot(nearest[0] + x * box[0], nearest[1] + y * box[1], nearest[2] + z * box[2])));
  }
  return least;
}

class LennardJonesGradient : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Cases, LennardJonesGradient,
                         testing::Values("kob-andersen N=256 all shifted", "kob-andersen N=108 all shifted",
                                         "kob-andersen N=108 minimum shifted", "kob-andersen N=31 all shifted",
                                         "kob-andersen N=31 all tail", "lennard-jones N=9 minimum shifted",
                                         "lennard-jones N=3 all shifted", "orthorhombic nearest kob-andersen all shifted",
                                         "orthorhombic two nearest kob-andersen all shifted",
                                         "orthorhombic lattice kob-andersen all shifted", "slab kob-andersen minimum shifted",
                                         "tiny box N=5 cutoff 4"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                           return name;
                         });

TEST_P(LennardJonesGradient, IsTheDerivativeOfTheEnergy) {
  const auto [name, model, configuration] = case_named(GetParam());
  const Result result = evaluate(model, configuration);
  const auto scale = evaluate_reference(model, configuration).gradient_magnitude;
  constexpr double h = 1e-4;
  std::size_t compared = 0;
  for (std::size_t i = 0; i < configuration.size(); i += configuration.size() > 50 ? 7 : 1) {
    if (distance_to_jump(model, configuration, i) < 3.0 * h) continue;
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      const auto moved = [&](double by) {
        Configuration other = configuration;
        other.positions[k] += by;
        return energy(model, other);
      };
      // Five-point difference: exact to h^4, here 1e-9; the rounding of the energies divided by h is about 1e-7.
      const double slope = (8.0 * (moved(h) - moved(-h)) - (moved(2.0 * h) - moved(-2.0 * h))) / (12.0 * h);
      EXPECT_NEAR(result.gradient[k], slope, 1e-7 * (10.0 + scale[k])) << "particle " << i << ", axis " << k % 3;
      ++compared;
    }
  }
  EXPECT_GE(compared, std::min<std::size_t>(6, 3 * configuration.size()));
}

TEST(LennardJonesVirial, IsMinusThreeTimesVolumeTimesTheSlopeOfTheEnergyWithVolume) {
  for (const char* chosen :
       {"kob-andersen N=31 all shifted", "kob-andersen N=108 all shifted", "lennard-jones N=2 all shifted",
        "orthorhombic two nearest kob-andersen all shifted", "tiny box N=1 cutoff 4", "tiny box N=2 cutoff 4"}) {
    const auto [name, model, configuration] = case_named(chosen);
    const auto scaled = [&, &model = model, &configuration = configuration](double strain) {
      Configuration other = configuration;
      for (double& length : other.box.length) length *= 1.0 + strain;
      for (double& x : other.positions) x *= 1.0 + strain;
      return energy(model, other);
    };
    constexpr double h = 3e-6;
    for (std::size_t i = 0; i < configuration.size(); ++i)
      ASSERT_GT(distance_to_jump(model, configuration, i), 3.0 * h * model.cutoff) << name << ": a pair crosses its cutoff";
    // V d/dV = (1/3) d/d(strain).
    const double slope = (8.0 * (scaled(h) - scaled(-h)) - (scaled(2.0 * h) - scaled(-2.0 * h))) / (12.0 * h);
    const double virial = evaluate(model, configuration).sums.virial;
    const double magnitude = evaluate_reference(model, configuration).magnitude;
    EXPECT_NEAR(virial, -slope, 1e-6 * magnitude + 1e-9) << name;
  }
}

TEST(LennardJonesStress, HasTheVirialForItsTrace) {
  for (const auto& [name, model, configuration] : pair_cases()) {
    const auto sums = evaluate(model, configuration).sums;
    const double magnitude = evaluate_reference(model, configuration).magnitude;
    EXPECT_NEAR(sums.virial_tensor[0] + sums.virial_tensor[1] + sums.virial_tensor[2], sums.virial, 1e-13 * magnitude) << name;
  }
}

TEST(LennardJonesSelfImages, OfASingleParticleAreAllItsEnergy) {
  for (const Box& box : {cube(0.941), cube(1.7), Box{{1.1, 1.4, 2.3}}, Box{{1.3, 6.0, 7.0}}})
    for (const Truncation truncation : {Truncation::shifted, Truncation::plain, Truncation::tail}) {
      PairModel model = lennard_jones();
      model.truncation = truncation;
      const Configuration one{box, {0}, {0.3, -4.0, 11.0}};
      const auto expected = evaluate_reference(model, one);
      const Result result = evaluate(model, one);
      ASSERT_GT(expected.magnitude, 0.0);
      EXPECT_NEAR(result.sums.energy, expected.energy, 1e-14 * expected.magnitude) << box.length[0] << to_string(truncation);
      EXPECT_NEAR(result.sums.virial, expected.virial, 1.2e-13 * expected.magnitude) << box.length[0] << to_string(truncation);
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_NEAR(result.sums.virial_tensor[k], expected.virial_tensor[k], 1.2e-13 * expected.magnitude) << "component " << k;
      EXPECT_EQ(result.gradient, (std::vector<double>{0.0, 0.0, 0.0}));
    }
}

TEST(LennardJonesSelfImages, CountForEachParticleOfEachSpecies) {
  const auto [name, model, configuration] = case_named("tiny box N=5 cutoff 4");
  const auto expected = evaluate_reference(model, configuration);
  const Result result = evaluate(model, configuration);
  EXPECT_NEAR(result.sums.energy, expected.energy, 1e-14 * expected.magnitude);
  EXPECT_NEAR(result.sums.virial, expected.virial, 1.2e-13 * expected.magnitude);
}

TEST(LennardJonesSelfImages, DoNotExistUnderTheMinimumImageRule) {
  PairModel model = lennard_jones();
  model.images = ImageRule::minimum;
  EXPECT_EQ(energy(model, {cube(1.2), {0}, {0.1, 0.2, 0.3}}), 0.0);
}

TEST(ImageSearch, NeedsTheNearestImageOnlyUpToHalfTheShortestEdge) {
  const Box box{{5.0, 6.0, 7.0}};
  EXPECT_EQ(image_search(box, 2.5, ImageRule::all), ImageSearch::nearest);
  EXPECT_EQ(image_search(box, std::nextafter(2.5, 3.0), ImageRule::all), ImageSearch::two_nearest);
}

TEST(ImageSearch, NeedsOneMoreImageUpToHalfTheDiagonalOfTheSmallestFace) {
  // A 3-4-5 triangle: half the diagonal is exactly 2.5.
  for (const Box& box : {Box{{3.0, 4.0, 10.0}}, Box{{10.0, 3.0, 4.0}}, Box{{4.0, 10.0, 3.0}}}) {
    EXPECT_EQ(image_search(box, 2.5, ImageRule::all), ImageSearch::two_nearest);
    EXPECT_EQ(image_search(box, std::nextafter(2.5, 3.0), ImageRule::all), ImageSearch::lattice);
  }
}

TEST(ImageSearch, NeedsOneMoreImageUpToTheShortestEdge) {
  const Box box{{3.0, 10.0, 10.0}};
  EXPECT_EQ(image_search(box, 3.0, ImageRule::all), ImageSearch::two_nearest);
  EXPECT_EQ(image_search(box, std::nextafter(3.0, 4.0), ImageRule::all), ImageSearch::lattice);
}

TEST(ImageSearch, NeedsTheNearestImageOnlyUnderTheMinimumImageRule) {
  EXPECT_EQ(image_search(cube(1.0), 100.0, ImageRule::minimum), ImageSearch::nearest);
}

// The message of the Error(bad_input) that a call throws, or an empty string.
template <class Call>
std::string bad_input_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  return "";
}

TEST(CheckSeparations, NamesTheClosestPairOfThoseThatOverlap) {
  Configuration configuration{cube(8.0), {0, 0, 0, 0, 0}, {1, 1, 1, 3, 3, 3, 3.25, 3, 3, 5, 5, 5, 5.1, 5, 5}};
  const std::string message = bad_input_of([&] { check_separations(configuration, lennard_jones()); });
  EXPECT_NE(message.find("particles 3 and 4 overlap"), std::string::npos) << message;
  EXPECT_NE(message.find("0.1 sigma"), std::string::npos) << message;
  EXPECT_NE(message.find("at least 0.3"), std::string::npos) << message;
}

TEST(CheckSeparations, LooksAcrossTheBoundaryAndAtUnwrappedPositions) {
  const Configuration configuration{cube(8.0), {0, 0}, {0.1, 1.0, 1.0, 7.95 - 24.0, 9.0, 1.0}};
  EXPECT_NE(bad_input_of([&] { check_separations(configuration, lennard_jones()); }).find("particles 0 and 1"), std::string::npos);
}

TEST(CheckSeparations, MeasuresInTheSigmaOfThePair) {
  // 0.26 exceeds 0.3 x 0.8 = 0.24 (unlike pair) but is below 0.3 x 0.88 = 0.264 (two P).
  const std::vector<double> positions = {1.0, 1.0, 1.0, 1.26, 1.0, 1.0};
  EXPECT_EQ(bad_input_of([&] { check_separations({cube(8.0), {0, 1}, positions}, kob_andersen()); }), "");
  EXPECT_NE(bad_input_of([&] { check_separations({cube(8.0), {1, 1}, positions}, kob_andersen()); }), "");
}

TEST(CheckSeparations, NamesTheFirstOfPairsThatAreEquallyClose) {
  const Configuration configuration{
      cube(8.0), std::vector<int>(6, 0), {5, 5, 5, 1, 1, 1, 3, 3, 3, 3.125, 3, 3, 1.125, 1, 1, 5.125, 5, 5}};
  EXPECT_NE(bad_input_of([&] { check_separations(configuration, lennard_jones()); }).find("particles 0 and 5"), std::string::npos);
}

TEST(CheckSeparations, FindsTheOnePairThatOverlapsAmongMany) {
  Configuration liquid = fcc_start(kob_andersen(), 10'000, 1.2, 1);
  EXPECT_EQ(bad_input_of([&] { check_separations(liquid, kob_andersen()); }), "");
  for (const std::size_t i : {0U, 4999U, 9998U}) {
    Configuration squeezed = liquid;
    for (std::size_t axis = 0; axis < 3; ++axis) squeezed.positions[3 * i + axis] = liquid.positions[3 * 9999 + axis] + 0.1;
    EXPECT_NE(bad_input_of([&] { check_separations(squeezed, kob_andersen()); }).find(std::to_string(i) + " and 9999"),
              std::string::npos);
  }
}

TEST(CheckSeparations, AcceptsEverySharedCase) {
  for (const auto& [name, model, configuration] : pair_cases())
    EXPECT_EQ(bad_input_of([&, &model = model, &configuration = configuration] { check_separations(configuration, model); }), "")
        << name;
}

std::string refusal(double cutoff, const Box& box, ImageRule images) {
  PairModel model = lennard_jones();
  model.cutoff = cutoff;
  model.images = images;
  const ParticleLayout layout({0, 0}, 1);
  return bad_input_of([&] { PairInteraction(model, box, layout, best_table()); });
}

TEST(LennardJonesCutoff, MayReachOverEightImagesOfTheShortestEdge) {
  EXPECT_EQ(refusal(8.5, {{4.0, 1.0, 3.0}}, ImageRule::all), "");
  const std::string message = refusal(8.6, {{4.0, 1.0, 3.0}}, ImageRule::all);
  EXPECT_NE(message.find("cutoff 8.6"), std::string::npos) << message;
  EXPECT_NE(message.find("at most 8.5 is allowed"), std::string::npos) << message;
}

TEST(LennardJonesCutoff, IsRefusedWhereTheNumberOfImagesFitsNoInteger) {
  EXPECT_NE(refusal(1e12, cube(1.0), ImageRule::all), "");
  EXPECT_NE(refusal(1e300, cube(1.0), ImageRule::all), "");
}

TEST(LennardJonesCutoff, HasNoLimitUnderTheMinimumImageRule) { EXPECT_EQ(refusal(1000.0, cube(1.0), ImageRule::minimum), ""); }

TEST(MixedPrecision, TakesAListAtAnySizeAndRefusesWhatHasNone) {
  const PairCase small = case_named("kob-andersen N=8 all shifted");
  const ParticleLayout layout(small.configuration.species, 2);
  const auto made = [&](const PairModel& model, PairSearch search) {
    return PairInteraction(model, small.configuration.box, layout, best_table(), {.search = search, .precision = Precision::mixed});
  };
  EXPECT_NE(made(small.model, PairSearch::automatic).list(), nullptr);
  EXPECT_THROW(made(small.model, PairSearch::all_pairs), Error);
  PairModel minimum = small.model;
  minimum.images = ImageRule::minimum;
  EXPECT_THROW(made(minimum, PairSearch::automatic), Error);
}

// Separations are equally accurate everywhere in a box of any size, because coordinates are not stored in single precision.
TEST(MixedPrecision, LosesNothingInALargeBox) {
  const PairModel model = lennard_jones();
  for (const double length : {10.0, 1000.0, 60'000.0}) {
    const Configuration pair{cube(length), {0, 0}, {0.9 * length, 0.7 * length, 0.0, 0.9 * length + 0.7, 0.7 * length - 0.8, -0.1}};
    const ParticleLayout layout(pair.species, 1);
    PairInteraction interaction(model, pair.box, layout, best_table(), {.precision = Precision::mixed});
    const double expected = energy(model, pair);
    EXPECT_NEAR(interaction.energy(layout.to_slots(pair.positions)), expected, 1e-6 * std::fabs(expected)) << length;
  }
}

TEST(MixedPrecision, HasNamesThatAreReadBack) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed})
    EXPECT_EQ(parse_precision(to_string(precision)), precision);
  EXPECT_THROW(parse_precision("single"), Error);
}

}  // namespace
}  // namespace lanescape
