#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/archive.hpp"
#include "core/box.hpp"
#include "core/random.hpp"
#include "interaction/pair/probe_field.hpp"

// Putting particles where their energy has a given value: Delgado-Buscalioni and Coveney, J. Chem. Phys. 119, 978 (2003),
// doi 10.1063/1.1579475 ([U]).
namespace lanescape {

// How a place is searched for.
enum class InsertionMethod {
  usher,           // direct: an uphill move gives the trial up
  usher_indirect,  // an uphill move is followed by a line minimisation
  usher_near,      // the same where the energy is within |U0| of the target, else as usher
  screened,        // as usher, from places that no particle repels strongly, found by looking at distances only
  descent,         // [U]'s reference scheme: steepest descent by a fixed step, line minimisation, bracketing
};
const char* to_string(InsertionMethod method);
InsertionMethod parse_insertion_method(std::string_view word);  // throws Error(bad_input) naming the allowed words

// What the tolerance is of.
enum class ErrorMeasure {
  relative,      // |U - U0| / |U0| of each insertion
  absolute,      // |U - U0| of each insertion [epsilon]
  running_mean,  // the mean of |U - U0| / |U0| over this insertion and up to 29 before it
};
const char* to_string(ErrorMeasure measure);
ErrorMeasure parse_error_measure(std::string_view word);

// What keeps a search in its region.
enum class RegionWall {
  reflect,  // a step through a wall is reflected
  well,     // beyond a wall the force points back, and no place counts
};
const char* to_string(RegionWall wall);
RegionWall parse_region_wall(std::string_view word);

// A part of the box, faces parallel to its.
struct Region {
  std::array<double, 3> low{}, high{};  // [sigma]

  // Throws Error(bad_input) unless 0 <= low < high <= L along every axis.
  void check(const Box& box) const;
  bool contains(const std::array<double, 3>& position) const;
};

struct InsertionOptions {
  double target = 0.0;      // U0 [epsilon]
  double tolerance = 0.01;  // xi_max
  // Absolute for |U0| below 1e-6 whatever is said here: nothing is relative to zero.
  ErrorMeasure measure = ErrorMeasure::relative;
  InsertionMethod method = InsertionMethod::usher;
  std::optional<double> largest_step;  // ds_max [sigma]; by default 0.1 rho^(-3/2), of descent its step ds
  double traverse_step = 0.6;          // ds' of descent, after a line minimisation [sigma]
  double overlap_energy = 1e4;         // U_ov: above it a step goes to where contact ends [epsilon]
  double contact = 0.9;                // r_sigma [sigma of the largest pair]
  double clear_energy = 60.0;          // of screened: no particle's repulsion alone is above it at a start [epsilon]
  std::optional<std::uint64_t>
      most_iterations;                 // of a trial; by default four times the mean of those that ended well, at least 100
  std::uint64_t most_trials = 10'000;  // of an insertion
  std::optional<Region> region;        // by default the box
  RegionWall wall = RegionWall::reflect;
  std::uint64_t seed = 1;

  // Throws Error(bad_input) naming what is out of range.
  void check(const Box& box) const;
  ErrorMeasure measure_in_force() const;
};

struct Insertion {
  bool found = false;                // false: most_trials ended without a place
  std::array<double, 3> position{};  // in the box [sigma]
  double energy = 0.0;               // what the fluid's rises by [epsilon]
  double error = 0.0;                // in the measure: relative, with its sign, or absolute
  std::uint64_t evaluations = 0;     // of force and energy, of all trials, first probes included
  std::uint64_t trials = 0;
  std::uint64_t iterations = 0;  // evaluations of the last trial alone
  std::uint64_t candidates = 0;  // for starts, of screened: looked at, not evaluated
  double distance = 0.0;         // from the last trial's start to the place, the nearest image [sigma]
};

// What later insertions need to know of earlier ones.
class InsertionHistory {
 public:
  void add(const Insertion& insertion);
  // One search more, and its number.
  std::uint64_t next_search() { return searches_++; }

  // Iterations of the trial that ended well, over the last 100 insertions; 0 where there was none.
  double mean_iterations() const;
  // How far the next insertion may be off, relative to the target, so that the mean over it and up to 29 before it is within the
  // tolerance.
  double allowed_error(double tolerance) const;

  void exchange(Archive& archive);

 private:
  std::uint64_t searches_ = 0;
  std::vector<double> iterations_, errors_;  // the last ones, oldest first
};

// Looks for `count` places in a fluid that stays as it is: independent of each other. `threads`: no effect on any result.
std::vector<Insertion> find_places(const ProbeField& fluid, const InsertionOptions& options, std::size_t count,
                                   InsertionHistory& history, int threads);
// Looks for places one after the other, each particle put in where a place was found. Searches of a batch run at the same time; one
// whose place an earlier particle of the batch has come within reach of goes on from there.
std::vector<Insertion> insert_particles(ProbeField& fluid, const InsertionOptions& options, std::size_t count,
                                        InsertionHistory& history, int threads);

// A velocity from Maxwell's distribution about `mean`, for the particle of a search.
std::array<double, 3> maxwellian_velocity(const CounterRandom& random, std::uint64_t search, double temperature, double mass,
                                          const std::array<double, 3>& mean = {});

}  // namespace lanescape
