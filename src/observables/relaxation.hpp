#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/archive.hpp"
#include "observables/statistics.hpp"

namespace lanescape {

// What relaxation is measured with: M equally spaced records, and lags spaced by factors.
struct RelaxationWindow {
  double interval = 0.0;             // dt, between records [sigma sqrt(m/epsilon)]
  std::uint64_t records = 0;         // M >= 2, of a trajectory
  std::vector<double> wave_numbers;  // k of each species [1/sigma]
  double overlap_length = 0.0;       // a: a particle that moved less overlaps with its old place [sigma]

  // Throws Error(bad_input), which names the value out of range.
  void check() const;
  // In records: about 16 in a factor of ten, each once, from 1 to half of M.
  std::vector<std::uint64_t> lags() const;
  // Records between origins: every one is the first of a series of lags. At most 100 origins, so that memory does not grow with M.
  std::uint64_t origin_spacing() const;
};

// How particles leave their places, per species (index: that of the layout's blocks), from displacements dr over a lag t. Every lag
// has all origins from which it ends within the trajectory: at least half of them.
//   F_s(k, t) = <sin(k |dr|)/(k |dr|)>: the mean of exp(i k.dr) over all directions of k. Positions are not wrapped into the box,
//   so
//               that any k is allowed.
//   alpha_2(t) = (3/5) <|dr|^4>/<|dr|^2>^2 - 1, 0 for Gaussian displacements.
//   chi_4(t) = (<Q^2> - <Q>^2)/N, Q the number of the N particles of the species that moved less than a, over origins and
//               trajectories: the self part of doi 10.1063/1.1605094 without its factor volume/(k_B T), so that it counts
//               particles. At constant energy and composition it is smaller than at constant temperature (doi 10.1063/1.2721554).
// Estimates are functions of means over trajectories, with the jackknife's errors; a single trajectory gives no error. A species
// without particles has zeros everywhere.
class RelaxationAccumulator {
 public:
  // Checks the window, which has a k for each species.
  RelaxationAccumulator(const ParticleLayout& layout, const RelaxationWindow& window);

  // Adds a record to the current trajectory, which ends with its record M: positions in the layout's order, unwrapped, without a
  // drift of the centre of mass. Memory: 100 positions of all particles.
  void record(const AlignedArray& position);
  std::uint64_t records() const { return records_; }  // of the current trajectory, 0 ... M - 1
  std::uint64_t trajectories() const { return sums_.size() / trajectory_size(); }
  std::size_t species() const { return blocks_.size(); }
  const RelaxationWindow& window() const { return window_; }

  std::size_t points() const { return lags_.size(); }
  double time(std::size_t point) const { return static_cast<double>(lags_[point]) * window_.interval; }
  Estimate squared_displacement(std::size_t species, std::size_t point) const;
  Estimate intermediate_scattering(std::size_t species, std::size_t point) const;
  Estimate non_gaussian(std::size_t species, std::size_t point) const;
  Estimate susceptibility(std::size_t species, std::size_t point) const;

  // tau_alpha: the first time at which F_s is 1/e, by a line in ln t between two points; nothing if it stays above or begins below.
  // No error if this holds without one of the trajectories.
  std::optional<Estimate> relaxation_time(std::size_t species) const;
  // The point where alpha_2 or chi_4 is largest; nothing if that is the first or the last one.
  std::optional<std::size_t> non_gaussian_peak(std::size_t species) const;
  std::optional<std::size_t> susceptibility_peak(std::size_t species) const;

  // All finished trajectories. Reading data of another window or other species throws Error(bad_input) if they differ in length;
  // the caller stores window and layout as well.
  void exchange(Archive& archive);

 private:
  enum Moment : std::size_t { squared, fourth, scattering, overlap, overlap_squared, moment_count };
  using Moments = std::array<double, moment_count>;

  std::size_t trajectory_size() const { return blocks_.size() * lags_.size() * moment_count; }
  std::size_t index(std::size_t species, std::size_t point, Moment moment) const {
    return (species * lags_.size() + point) * moment_count + moment;
  }
  void add_displacements(const AlignedArray& from, const AlignedArray& to, std::size_t point);
  void end_trajectory();
  // Over all trajectories but one, or over all where there is none of that number.
  double mean(std::size_t without, std::size_t species, std::size_t point, Moment moment) const;
  double non_gaussian_of(std::size_t without, std::size_t species, std::size_t point) const;
  double susceptibility_of(std::size_t without, std::size_t species, std::size_t point) const;
  double relaxation_time_of(std::size_t without, std::size_t species) const;  // NaN if there is none

  RelaxationWindow window_;
  std::vector<kernels::SpeciesBlock> blocks_;
  std::size_t slots_;
  std::vector<std::uint64_t> lags_;
  std::uint64_t records_ = 0;
  std::vector<AlignedArray> origins_;    // positions at multiples of origin_spacing()
  std::vector<std::size_t> next_point_;  // of each origin: points() when all of its lags are done
  std::vector<double> current_;          // sums of the current trajectory, of its origins
  std::vector<double> sums_;             // trajectories x species x points x moments, means over origins
};

}  // namespace lanescape
