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

// Inserts particles at positions where their energy has a given value: Delgado-Buscalioni and Coveney, J. Chem. Phys. 119, 978
// (2003), doi 10.1063/1.1579475 ([U]).
namespace lanescape {

// How a search looks for a position.
enum class InsertionMethod {
  usher,           // direct: an uphill move ends the trial
  usher_indirect,  // a line minimisation follows an uphill move
  usher_near,      // usher_indirect where the energy is within |U0| of the target, usher elsewhere
  screened,        // usher, started where no particle repels strongly, which a test of distances ensures
  descent,         // [U]'s reference scheme: steepest descent with a fixed step, line minimisation, bracketing
};
const char* to_string(InsertionMethod method);
InsertionMethod parse_insertion_method(std::string_view word);  // throws Error(bad_input) that lists the allowed words

// What the tolerance limits.
enum class ErrorMeasure {
  relative,      // |U - U0| / |U0| of each insertion
  absolute,      // |U - U0| of each insertion [epsilon]
  running_mean,  // the mean of |U - U0| / |U0| over this insertion and up to 29 before it
};
const char* to_string(ErrorMeasure measure);
ErrorMeasure parse_error_measure(std::string_view word);

// What keeps a search in its region.
enum class RegionWall {
  reflect,  // steps through a wall are reflected
  well,     // outside the region the force points back, and no position is accepted
};
const char* to_string(RegionWall wall);
RegionWall parse_region_wall(std::string_view word);

// A cuboid with faces parallel to the box's. It is periodic with the box: it may lie across faces or in another image of the box,
// but along an open axis between the faces.
struct Region {
  std::array<double, 3> low{}, high{};  // [sigma]

  // Throws Error(bad_input) unless low < high <= low + L along every axis, not too many edges from the box, and in it along open
  // axes.
  void check(const Box& box) const;
  // Of this image of a position.
  bool contains(const std::array<double, 3>& position) const;
  // The image of a position that is nearest to the region's centre. It lies in the region if any image does.
  std::array<double, 3> image(const Box& box, std::array<double, 3> position) const;
};

struct InsertionOptions {
  double target = 0.0;      // U0 [epsilon]
  double tolerance = 0.01;  // xi_max
  // For |U0| below 1e-6 the error is always absolute.
  ErrorMeasure measure = ErrorMeasure::relative;
  InsertionMethod method = InsertionMethod::usher;
  // ds_max, or the step ds of descent [sigma]; default: 0.1 rho^(-3/2), with both in ProbeField::length_unit()
  std::optional<double> largest_step;
  std::optional<double> traverse_step;  // ds' of descent: step after a line minimisation [sigma]; default: 1.5 length units
  double overlap_energy = 1e4;          // U_ov: above it a step ends at the contact distance [epsilon]
  double contact = 0.9;                 // r_sigma, the contact distance [sigma of the largest pair]
  double clear_energy = 60.0;           // screened: limit of a single particle's r^-12 energy at a start [epsilon]
  // Limit per trial; default: four times the mean of successful trials, at least 100.
  std::optional<std::uint64_t> most_iterations;
  std::uint64_t most_trials = 10'000;  // limit per insertion
  std::optional<Region> region;        // default: the box, whose open faces are walls
  RegionWall wall = RegionWall::reflect;
  std::uint64_t seed = 1;

  // Throws Error(bad_input) that names the option out of range.
  void check(const Box& box) const;
  // `measure`, or absolute for |U0| below 1e-6.
  ErrorMeasure measure_in_force() const;
};

struct Insertion {
  bool found = false;                // false: most_trials ended without success
  std::array<double, 3> position{};  // in the box [sigma]
  double energy = 0.0;               // increase of the fluid's energy [epsilon]
  double error = 0.0;                // U - U0, or (U - U0) / |U0| if the measure is relative
  std::uint64_t evaluations = 0;     // of energy and force, over all trials, starts included
  std::uint64_t trials = 0;
  std::uint64_t iterations = 0;  // evaluations in the last trial
  std::uint64_t candidates = 0;  // screened: points tested as starts, without an evaluation
  double distance = 0.0;         // from the start of the last trial to `position`, nearest image [sigma]
};

// What later insertions use of earlier ones.
class InsertionHistory {
 public:
  void add(const Insertion& insertion);
  // Counts a search and returns its number.
  std::uint64_t next_search() { return searches_++; }

  // Mean iterations of the successful trials of the last 100 insertions; 0 if there are none.
  double mean_iterations() const;
  // The largest relative error of the next insertion that keeps the mean over it and up to 29 earlier ones within the tolerance.
  double allowed_error(double tolerance) const;

  void exchange(Archive& archive);

 private:
  std::uint64_t searches_ = 0;
  std::vector<double> iterations_, errors_;  // most recent insertions, oldest first
};

// Searches for `count` positions in a fluid that does not change, independently of each other. Results do not depend on `threads`.
std::vector<Insertion> find_places(const ProbeField& fluid, const InsertionOptions& options, std::size_t count,
                                   InsertionHistory& history, int threads);
// Inserts particles one after the other into the fluid. The searches of a batch run at the same time. If a particle inserted
// earlier in the batch lies within the cutoff of a search's result, the search continues from there. Results do not depend on
// `threads`.
std::vector<Insertion> insert_particles(ProbeField& fluid, const InsertionOptions& options, std::size_t count,
                                        InsertionHistory& history, int threads);

// A velocity from Maxwell's distribution around `mean`, for the particle of search number `search`.
std::array<double, 3> maxwellian_velocity(const CounterRandom& random, std::uint64_t search, double temperature, double mass,
                                          const std::array<double, 3>& mean = {});

}  // namespace lanescape
