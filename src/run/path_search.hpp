#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "landscape/kinematic_landscape.hpp"
#include "landscape/soft_landscape.hpp"
#include "path/finder.hpp"
#include "run/path_run.hpp"
#include "run/run_loop.hpp"

namespace lanescape {

// A pair as searches see it, checked.
struct PreparedPair {
  ParticleLayout layout;
  KinematicMetric metric;
  AlignedArray start, goal;  // kinematic coordinates
  double distance = 0.0, landscape_energy = 0.0;
};

// Throws Error(bad_input) for a pair that check_end_points() refuses, for faithful steps of hard spheres of unequal masses, and for
// an end above a given landscape energy. Messages start with `where`.
PreparedPair prepare_pair(const AnyModel& model, const ConfigurationPair& pair, const std::string& where,
                          const PathRunOptions& options, Isa isa);
// The same on any landscape of soft particles with these masses, in positions; the pair is not checked.
PreparedPair prepare_pair_on(const SoftLandscapeMaker& make, const Mixture& mixture, const ParticleLayout& layout,
                             const ConfigurationPair& pair, const std::string& where, const PathRunOptions& options, Isa isa);

// What the search for one path starts from.
struct SearchSetup {
  const AnyModel& model;
  const ConfigurationPair& pair;
  const PreparedPair& prepared;
  const PathRunOptions& options;
  Isa isa;
  int threads = 1;  // of one evaluation
  bool reversed = false;
  SoftLandscapeMaker landscape{};  // in positions, in place of the model's

  const AlignedArray& start() const { return reversed ? prepared.goal : prepared.start; }
  const AlignedArray& goal() const { return reversed ? prepared.start : prepared.goal; }
  FinderOptions finder_options() const;
};

// A landscape in positions, in the coordinates of a metric.
std::unique_ptr<SoftLandscape> in_kinematic_coordinates(std::unique_ptr<SoftLandscape> landscape, const KinematicMetric& metric);
// The landscape of soft particles on which a path runs, in kinematic coordinates.
std::unique_ptr<SoftLandscape> path_landscape(const SearchSetup& setup);

// Fills in what is summed along a path: its length, participation, histograms and lengths of particles.
void add_statistics(PathResult& result, const PathStatistics& statistics, const ParticleLayout& layout);
// Fills in the displacements of the particles and the widths of heterogeneity, from frames and lengths of particles.
void add_heterogeneity(PathResult& result, std::size_t species_count);

// Of the results from both ends of a pair, the one to keep.
PathResult shorter_way(PathResult forward, PathResult backward);

// The search for one path by some method.
class PathSearch : public ResumableWork {
 public:
  explicit PathSearch(const SearchSetup& setup);

  bool finished() const override { return outcome() != Outcome::running; }
  void advance(RunMonitor& monitor) override;
  bool save_due() const override { return steps() % (chunk_ * chunks_per_checkpoint) == 0; }
  // The path as far as it has come. Its frames of hard spheres are tested for overlaps again, without a list.
  PathResult result();

 protected:
  virtual Outcome outcome() const = 0;
  virtual std::uint64_t steps() const = 0;
  virtual double distance_left() const = 0;
  virtual const AlignedArray& position() const = 0;
  virtual const PathStatistics& statistics() const = 0;
  virtual const PathRecorder& recorder() const = 0;
  virtual void make_steps(std::uint64_t count) = 0;
  // Fills in what the finder and its stepper counted.
  virtual void add_counts(PathResult& result) = 0;

 private:
  static constexpr std::uint64_t chunks_per_checkpoint = 700;

  std::vector<Configuration> frames() const;

  SearchSetup setup_;
  std::uint64_t chunk_;  // steps between two calls of the monitor
};

// By the setup's method, with faithful or adaptive steps.
std::unique_ptr<PathSearch> begin_path(const SearchSetup& setup);

// PathSearch by a stepper on its landscape.
template <class Landscape, Stepper Method>
class StepperSearch final : public PathSearch {
 public:
  StepperSearch(const SearchSetup& setup, std::unique_ptr<Landscape> landscape, Method stepper)
      : PathSearch(setup),
        landscape_(std::move(landscape)),
        finder_(landscape_->algebra(), std::move(stepper), setup.start(), setup.goal(), setup.prepared.layout.size(),
                setup.finder_options()) {}

  void exchange(Archive& archive) override { finder_.exchange(archive); }

 protected:
  Outcome outcome() const override { return finder_.outcome(); }
  std::uint64_t steps() const override { return finder_.steps(); }
  double distance_left() const override { return finder_.distance_left(); }
  const AlignedArray& position() const override { return finder_.position(); }
  const PathStatistics& statistics() const override { return finder_.statistics(); }
  const PathRecorder& recorder() const override { return finder_.recorder(); }
  void make_steps(std::uint64_t count) override { finder_.advance(count); }
  void add_counts(PathResult& result) override {
    result.reason = finder_.reason();
    result.direct_steps = finder_.direct_steps();
    result.detour_steps = finder_.detour_steps();
    result.detour_length = finder_.detour_length();
    result.direct_length = result.length - result.detour_length;
    result.evaluations = finder_.stepper().evaluations();
    result.corrections = finder_.stepper().corrections();
    result.largest_violation = finder_.largest_violation();
    if constexpr (requires { finder_.stepper().histograms(); })
      for (StepHistogram& histogram : finder_.stepper().histograms()) result.histograms.push_back(std::move(histogram));
    if constexpr (requires { landscape_->violation(position()); })
      for (const AlignedArray& frame : finder_.recorder().frames())
        result.largest_violation = std::max(result.largest_violation, landscape_->violation(frame));
  }

 private:
  std::unique_ptr<Landscape> landscape_;
  PathFinder<Method> finder_;
};

template <class Landscape, Stepper Method>
std::unique_ptr<PathSearch> begin_search(const SearchSetup& setup, std::unique_ptr<Landscape> landscape, Method stepper) {
  return std::make_unique<StepperSearch<Landscape, Method>>(setup, std::move(landscape), std::move(stepper));
}

}  // namespace lanescape
