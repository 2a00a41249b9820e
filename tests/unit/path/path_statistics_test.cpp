#include "path/path_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "memory_archive.hpp"

namespace lanescape {
namespace {

// Three particles and their positions after each displacement.
class Walk {
 public:
  Walk() : layout_({0, 0, 0}, 1), algebra_(kernel_table(choose_isa("auto"))), at_(layout_.dimension(), 0.0) {}
  PathStatistics statistics(Stepping stepping = Stepping::faithful) const { return {layout_.slots(), layout_.size(), stepping}; }
  void step(PathStatistics& statistics, const std::vector<double>& by) { statistics.add_step(algebra_, at_, move(by)); }
  void hop(PathStatistics& statistics, const std::vector<double>& by) { statistics.add_hop(algebra_, at_, move(by)); }
  std::size_t slot(std::size_t particle) const { return layout_.slot_of(particle); }

 private:
  const AlignedArray& move(const std::vector<double>& by) {
    to_ = layout_.to_slots(by);
    return to_;
  }

  ParticleLayout layout_;
  VectorAlgebra algebra_;
  AlignedArray at_, to_;
};

// sum dr^2 = 9 + 16 = 25, sum dr^4 = 81 + 256 = 337
const std::vector<double> uneven{0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -4.0};
constexpr double uneven_number = 625.0 / 337.0;
const std::vector<double> even{1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0};

TEST(PathStatistics, OfOneStepAreItsLengthAndParticipationNumber) {
  Walk walk;
  PathStatistics statistics = walk.statistics();
  EXPECT_EQ(statistics.participation_number(), 0.0);
  walk.step(statistics, uneven);
  EXPECT_DOUBLE_EQ(statistics.length(), 5.0);
  EXPECT_DOUBLE_EQ(statistics.last_participation_number(), uneven_number);
  EXPECT_DOUBLE_EQ(statistics.participation_number(), uneven_number);
}

TEST(PathStatistics, TheMeanParticipationNumberIsWeightedWithLength) {
  Walk walk;
  PathStatistics statistics = walk.statistics();
  walk.step(statistics, uneven);
  walk.step(statistics, even);
  EXPECT_DOUBLE_EQ(statistics.length(), 5.0 + std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(statistics.last_participation_number(), 3.0);
  EXPECT_DOUBLE_EQ(statistics.participation_number(), (5.0 * uneven_number + std::sqrt(3.0) * 3.0) / (5.0 + std::sqrt(3.0)));
}

TEST(PathStatistics, ParticleLengthsAreSumsOfEachParticlesOwn) {
  Walk walk;
  PathStatistics statistics = walk.statistics();
  walk.step(statistics, uneven);
  walk.step(statistics, even);
  walk.hop(statistics, uneven);
  EXPECT_DOUBLE_EQ(statistics.particle_lengths()[walk.slot(0)], 7.0);
  EXPECT_DOUBLE_EQ(statistics.particle_lengths()[walk.slot(1)], 1.0);
  EXPECT_DOUBLE_EQ(statistics.particle_lengths()[walk.slot(2)], 9.0);
  EXPECT_DOUBLE_EQ(std::accumulate(statistics.particle_lengths().begin(), statistics.particle_lengths().end(), 0.0), 17.0);
}

TEST(PathStatistics, HistogramsCountStepsAndNotTheHop) {
  Walk walk;
  PathStatistics statistics = walk.statistics();
  walk.step(statistics, uneven);
  walk.step(statistics, even);
  walk.step(statistics, {0.0, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  walk.hop(statistics, even);
  // The values of n are 1, 625/337 = 1.85 and 3, in the bins up to 1, up to 2 and up to 3.
  EXPECT_EQ(statistics.participation_histogram(), (std::vector<double>{1, 1, 1}));
}

TEST(PathStatistics, TheAlphaTwoOfAStepIsThatOfItsDisplacements) {
  Walk walk;
  PathStatistics statistics = walk.statistics();
  walk.step(statistics, uneven);
  walk.step(statistics, {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0});
  walk.step(statistics, {1.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0});
  // 1.8/n - 1 for n = 625/337, 2 and 25/17 is -0.03, -0.1 and 0.22; the bins have width 0.2 and start at -1.
  std::vector<double> expected(9, 0);
  expected[4] = 2;
  expected[6] = 1;
  EXPECT_EQ(statistics.alpha2_histogram(), expected);
}

TEST(PathStatistics, StepsOfOneToFourParticlesHaveABinOfAlphaTwoEachAtAnyN) {
  const VectorAlgebra algebra(kernel_table(choose_isa("auto")));
  for (std::size_t particles = 12; particles <= 512; ++particles) {
    const ParticleLayout layout(std::vector<int>(particles, 0), 1);
    PathStatistics statistics(layout.slots(), particles);
    std::vector<double> expected(3 * particles, 0.0);
    for (std::size_t moved = 1; moved <= 4; ++moved) {
      // As an avoidance step moves them: 1e-4 each, in any direction, from coordinates of several digits.
      std::vector<double> from(3 * particles), to;
      for (std::size_t k = 0; k < from.size(); ++k) from[k] = 30.0 * std::sin(1.0 + static_cast<double>(k * moved));
      to = from;
      for (std::size_t j = 0; j < moved; ++j) {
        const double angle = static_cast<double>(particles + 7 * j);
        to[3 * j] += 1e-4 * std::cos(angle);
        to[3 * j + 2] += 1e-4 * std::sin(angle);
      }
      statistics.add_step(algebra, layout.to_slots(from), layout.to_slots(to));
      // The bin whose upper edge is 0.6 N/n, or the next one above it.
      expected[(3 * particles + moved - 1) / moved - 1] += 1.0;
    }
    ASSERT_EQ(statistics.alpha2_histogram(), expected) << particles << " particles";
    const StepHistogram histogram = statistics.histograms().back();
    EXPECT_NEAR(histogram.first + histogram.width * static_cast<double>(3 * particles - 1),
                0.6 * static_cast<double>(particles) - 1.0, 1e-9);
  }
}

TEST(PathStatistics, AdaptiveStepsCountWithTheirLength) {
  Walk walk;
  PathStatistics statistics = walk.statistics(Stepping::adaptive);
  walk.step(statistics, uneven);
  walk.step(statistics, even);
  walk.step(statistics, {0.0, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  walk.step(statistics, {0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  walk.hop(statistics, even);
  EXPECT_EQ(statistics.participation_histogram(), (std::vector<double>{0.75, 5.0, std::sqrt(3.0)}));
}

TEST(PathStatistics, AHopOfNoLengthChangesNothing) {
  Walk walk;
  PathStatistics statistics = walk.statistics();
  walk.step(statistics, uneven);
  walk.hop(statistics, std::vector<double>(9, 0.0));
  EXPECT_DOUBLE_EQ(statistics.length(), 5.0);
  EXPECT_DOUBLE_EQ(statistics.last_participation_number(), uneven_number);
}

TEST(PathStatistics, HandedOnToOthersTheyGoOnAlike) {
  Walk walk;
  PathStatistics whole = walk.statistics(), resumed = walk.statistics();
  walk.step(whole, uneven);
  testing::hand_on(whole, resumed);
  EXPECT_EQ(resumed.last_participation_number(), whole.last_participation_number());
  walk.step(whole, even);
  walk.step(resumed, even);
  EXPECT_EQ(resumed.length(), whole.length());
  EXPECT_EQ(resumed.participation_number(), whole.participation_number());
  EXPECT_EQ(resumed.participation_histogram(), whole.participation_histogram());
  EXPECT_EQ(resumed.alpha2_histogram(), whole.alpha2_histogram());
  EXPECT_EQ(resumed.particle_lengths(), whole.particle_lengths());
}

}  // namespace
}  // namespace lanescape
