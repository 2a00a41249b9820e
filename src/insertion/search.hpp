#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/random.hpp"
#include "insertion/insertion.hpp"
#include "interaction/pair/probe_field.hpp"

namespace lanescape {

// One search for a place, trial after trial.
class InsertionSearch {
 public:
  using Point = std::array<double, 3>;
  // Where a trial has been and what the energy was, evaluation by evaluation, for who wants to see how errors shrink.
  using Observer = std::function<void(std::uint64_t trial, const Point& position, double energy)>;

  // `allowed`: the largest |U - U0| [epsilon]; `number` tells searches of one seed apart. `fluid` and `options` must outlive this
  // object.
  InsertionSearch(const ProbeField& fluid, const InsertionOptions& options, std::uint64_t number, double allowed,
                  std::uint64_t most_iterations, Observer observer = {});

  // Trials until one ends at a place or there have been most_trials.
  void run();
  // After particles have been put into the fluid, whose constant() has grown: where one of them is within reach of the place found,
  // or the place will not do any more, the search goes on from there.
  void follow(const std::vector<Point>& put_in, double constant_growth);
  const Insertion& result() const { return result_; }

 private:
  // A position and what a probe feels there.
  struct Site {
    Point position{};
    double energy = 0.0;
    Point gradient{};
    double slope = 0.0;  // |gradient|
  };
  // The energy along a segment, of which both ends are known.
  struct Segment {
    Segment(const Site& a, const Site& b);
    Site from, to;
    Point along;  // from the one to the other
  };

  Site probe(const Point& position);
  Site step(const Site& from, double sign, double length);
  Point start_of(std::uint64_t trial);
  Point clear_start();
  Point in_region(const Point& fraction) const;
  void keep_inside(Point& position) const;
  bool accepted(const Site& site) const;
  bool can_go_on(const Site& site) const;
  double sign_at(const Site& site) const { return site.energy > options_->target ? 1.0 : -1.0; }
  double usher_length(const Site& site) const;
  // Whether a trial from `site` ends at a place, which it then is.
  bool usher_trial(Site& site);
  bool descent_trial(Site& site);
  Site at(const Segment& segment, double part);
  // The least of sign U on a segment that first falls and ends higher, or a place, or where the target has been crossed.
  Site line_minimum(const Segment& segment, double sign);
  // A place between two sites on either side of the target.
  Site bracketed(const Segment& segment, double sign);
  bool trial(Site& site) { return options_->method == InsertionMethod::descent ? descent_trial(site) : usher_trial(site); }
  void finish(const Site& site);
  bool is_near(const Point& a, const Point& b) const;

  const ProbeField* fluid_;
  const InsertionOptions* options_;
  CounterRandom random_;
  std::uint64_t number_, most_iterations_, spent_ = 0;  // spent: evaluations of the present trial
  double allowed_, largest_step_;
  std::vector<double> clearances_;
  Region region_;
  bool whole_box_;
  Observer observer_;
  Point start_{};
  Insertion result_;
};

}  // namespace lanescape
