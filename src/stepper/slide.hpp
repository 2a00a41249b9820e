#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/archive.hpp"
#include "core/step_histogram.hpp"
#include "landscape/contact_landscape.hpp"
#include "stepper/contact_projection.hpp"
#include "stepper/stepper.hpp"

namespace lanescape {

// Hard spheres in long steps without trials: a step wishes to go straight to the goal and is projected on what the contacts allow
// (ContactProjection). Spheres that meet slide along each other; the whole segment is free of overlaps, by construction.
//
// This is steepest descent of the distance to the goal, which can end where all contacts balance the pull. The pull then becomes
// w_j ~ |d_j|^(p-2) d_j with p = 4, 8, ... in place of 2, d_j the way of sphere j to its goal, so that spheres near their goals
// give way to those far from them, and it is turned a little, since exactly opposed spheres have no side to pass on. Once the
// distance is less than where the path was stuck, p is 2 again.
class SlideStepper {
 public:
  struct Options {
    // Of any sphere in a step [sigma]. As contacts curve they open by at most 3 of its squares over s.
    double largest_move = 0.1;
    double unit = 1.0;  // of length, to which tolerances are relative [sigma]
  };
  // What a landscape for these options needs [sigma].
  static double reach(const Options& options) { return 2.0 * most_move(options); }
  static double skin(const Options& options) { return 2.0 * options.largest_move; }

  SlideStepper(ContactLandscape& landscape, const Options& options);

  std::optional<StepKind> step(const PathPoint& at, AlignedArray& next);

  // Steps have no given length, and the last one reaches the goal.
  double step_length() const { return 1e-9 * options_.unit; }
  double monitored() const { return static_cast<double>(moved_); }  // spheres moved by the last step
  // No pair overlaps deeper along the last step [sigma].
  double violation() const { return violation_; }
  std::uint64_t evaluations() const { return evaluations_; }  // of the gaps of a whole configuration
  const std::string& failure() const { return failure_; }
  // How many slides took 1, 2, 3, ... rounds of the projection; the last entry counts all beyond.
  const std::vector<std::uint64_t>& corrections() const { return corrections_; }
  // How often the pull was sharpened, log2(p/2), over the length of steps.
  std::vector<StepHistogram> histograms() const;

  void exchange(Archive& archive, const AlignedArray& position);

 private:
  static double most_move(const Options& options) { return 1.25 * options.largest_move; }

  void set_pull(const PathPoint& at);
  void turn_pull();
  bool sharpen(double distance);
  bool project(const PathPoint& at, const std::vector<PairGap>& pairs, bool rebuilt);
  void guess_multipliers(const std::vector<PairGap>& pairs, bool rebuilt);
  void remember_multipliers(const std::vector<PairGap>& pairs);
  double limit_displacement();
  double deepest_overlap(const std::vector<PairGap>& pairs, double share) const;
  StepKind accept(const PathPoint& at, const std::vector<PairGap>& pairs, AlignedArray& next);

  ContactLandscape* landscape_;
  Options options_;
  ContactProjection projection_;
  AlignedArray zero_, way_;                               // way_ in q: the wish, then what the contacts leave of it
  AlignedArray displacement_;                             // the same in positions
  double wish_length_;                                    // of the next wish, in q
  double last_wish_ = 0.0;                                // of the wish that gave the multipliers
  std::vector<double> multipliers_;                       // per listed pair
  std::vector<std::pair<std::uint64_t, double>> acting_;  // the same by spheres, for another list
  std::uint64_t sharpened_ = 0, sharp_steps_ = 0;         // log2(p/2), and steps with it
  double stuck_distance_ = 0.0;
  std::uint64_t moved_ = 0;
  double violation_ = 0.0;
  std::uint64_t evaluations_ = 0;
  std::vector<std::uint64_t> corrections_;
  std::vector<double> sharpness_;
  std::string failure_;
};

}  // namespace lanescape
