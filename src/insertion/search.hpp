#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/random.hpp"
#include "insertion/insertion.hpp"
#include "interaction/pair/probe_field.hpp"

namespace lanescape {

// A search for a position of the target energy, by up to most_trials trials.
class InsertionSearch {
 public:
  using Point = std::array<double, 3>;
  // Called at each evaluation, for studies of convergence.
  using Observer = std::function<void(std::uint64_t trial, const Point& position, double energy)>;

  // `allowed`: the largest |U - U0| [epsilon]. `number`: selects the random numbers of the seed. `fluid` and `options` must outlive
  // this object.
  InsertionSearch(const ProbeField& fluid, const InsertionOptions& options, std::uint64_t number, double allowed,
                  std::uint64_t most_iterations, Observer observer = {});

  // Runs trials until one succeeds or most_trials are done.
  void run();
  // Updates the result after particles were inserted at `inserted` and the fluid's constant() grew by `constant_growth`. If one of
  // them is within the cutoff of the result, or the result is no longer within the tolerance, the search continues from there.
  void follow(const std::vector<Point>& inserted, double constant_growth);
  const Insertion& result() const { return result_; }

 private:
  // A position with the energy and gradient of a probe there.
  struct Site {
    Point position{};
    double energy = 0.0;
    Point gradient{};
    double slope = 0.0;  // |gradient|
  };
  // A straight segment between two evaluated sites.
  struct Segment {
    Segment(const Site& a, const Site& b);
    Site from, to;
    Point along;  // to - from
  };

  Site probe(const Point& position);
  Site step(const Site& from, double sign, double length);
  Point start_of(std::uint64_t trial);
  Point clear_start();
  Point in_region(const Point& fraction) const;
  Point place_in_region() const;
  void keep_inside(Point& position) const;
  bool between_walls(const Point& position) const;
  bool accepted(const Site& site) const;
  bool can_go_on(const Site& site) const;
  double sign_at(const Site& site) const { return site.energy > options_->target ? 1.0 : -1.0; }
  double usher_length(const Site& site) const;
  // Run a trial from `site`. Return true if it succeeds; `site` is then the result.
  bool usher_trial(Site& site);
  bool descent_trial(Site& site);
  Site at(const Segment& segment, double part);
  // Minimises sign U on a segment on which it first falls and then rises. Stops early at an accepted site or beyond the target.
  Site line_minimum(const Segment& segment, double sign);
  // Finds an accepted site between two sites with energies on opposite sides of the target.
  Site bracketed(const Segment& segment, double sign);
  bool trial(Site& site) { return options_->method == InsertionMethod::descent ? descent_trial(site) : usher_trial(site); }
  void finish(const Site& site);
  bool is_near(const Point& a, const Point& b) const;

  const ProbeField* fluid_;
  const InsertionOptions* options_;
  CounterRandom random_;
  std::uint64_t number_, most_iterations_, spent_ = 0;  // spent: evaluations in the current trial
  double allowed_, largest_step_, traverse_step_;
  std::vector<double> clearances_;
  Region region_;
  std::array<bool, 3> has_walls_;  // along each axis
  bool whole_box_;                 // no walls at all
  Observer observer_;
  Point start_{};
  Insertion result_;
};

}  // namespace lanescape
