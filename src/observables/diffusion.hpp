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

// Which part of a trajectory is correlated: M equally spaced records, lags up to n records. The origins are the first M - n
// records, the same for every lag, so each origin has its full window.
struct DiffusionWindow {
  double interval = 0.0;      // dt, between records [sigma sqrt(m/epsilon)]
  std::uint64_t lags = 0;     // n; at most 999, or a number with a divisor that leaves 100 to 999 of them for the curves
  std::uint64_t records = 0;  // M > n

  // Throws Error(bad_input), which names the value out of range.
  void check() const;
  std::uint64_t origins() const { return records - lags; }
  double longest_time() const { return static_cast<double>(lags) * interval; }  // t_max = n dt
  // Records between stored positions, and between the points of the curves: the smallest divisor of n that leaves at most 999 lags.
  std::uint64_t stride() const;
  std::size_t points() const { return static_cast<std::size_t>(lags / stride()) + 1; }
};

// One trajectory in memory: velocities as floats (12 M N bytes; their rounding changes C by 3e-10 C(0) at M = 10^5), positions as
// doubles at every stride().
class TrajectoryRecord {
 public:
  // Checks the window.
  TrajectoryRecord(const ParticleLayout& layout, const DiffusionWindow& window);

  // Adds a record, in the layout's order, with unwrapped positions; neither array may have a drift of the centre of mass. There are
  // M records; one more throws Error(internal).
  void record(const AlignedArray& velocity, const AlignedArray& position);
  bool full() const { return records_ == window_.records; }
  std::uint64_t records() const { return records_; }
  // Resets the object for another trajectory; keeps its memory.
  void clear();

 private:
  friend class DiffusionAccumulator;
  DiffusionWindow window_;
  std::vector<kernels::SpeciesBlock> blocks_;
  std::size_t slots_;
  std::size_t row_ = 0;  // 3 N
  std::uint64_t records_ = 0;
  std::vector<float> velocities_;  // a row of 3 N per record: species after species, of each all x, all y, all z
  std::vector<double> positions_;  // such rows at every stride()
};

// Whether t_max is long enough to obtain the diffusion coefficient from the mean squared displacement.
enum class DiffusionRegime {
  diffusive,
  ballistic,  // displacement_exponent() > 1.2: with an exponential memory, t_max is below six times its time
  caged,      // displacement_exponent() < 0.9, or the mean squared displacement at t_max is below 0.1 length_unit^2
};

// Diffusion coefficients per species (index: that of the layout's blocks) from trajectories of equal length. Units: D
// [sigma sqrt(epsilon/m)], t [sigma sqrt(m/epsilon)], C [epsilon/m]. A species without particles has zeros everywhere.
class DiffusionAccumulator {
 public:
  // Checks the window.
  DiffusionAccumulator(const ParticleLayout& layout, const DiffusionWindow& window);

  // The record must be full and have the same layout and window, else Error(internal). Cost: 3 N Fourier transforms of M complex
  // doubles and M n/stride()^2 displacements of every particle.
  void add_trajectory(const TrajectoryRecord& record);

  std::uint64_t trajectories() const { return curves_[0].size() / (counts_.size() * points_); }
  std::size_t species() const { return counts_.size(); }
  const DiffusionWindow& window() const { return window_; }

  // Estimates are means over trajectories, each of which is one independent value. A single trajectory gives no error: it has too
  // few parts as long as a window, and shorter parts share most of their windows.

  // Curves at times 0, ..., t_max: C(t) = <v(0).v(t)>, D(t) = (1/3) int_0^t C dt' by Simpson's rule over every record, and <|r(t) -
  // r(0)|^2> with origins at multiples of stride().
  std::size_t points() const { return points_; }
  double time(std::size_t point) const;
  Estimate velocity_correlation(std::size_t species, std::size_t point) const { return at(correlation, species, point); }
  Estimate diffusion_integral(std::size_t species, std::size_t point) const { return at(integral, species, point); }
  Estimate squared_displacement(std::size_t species, std::size_t point) const { return at(displacement, species, point); }

  // D(t_max).
  Estimate vacf_diffusion(std::size_t species) const { return diffusion_integral(species, points_ - 1); }
  // The slope of the mean squared displacement at t_max, over 6, by the three-point backward difference. (A line through the last
  // tenth has the slope at 0.95 t_max; its smaller scatter comes no closer to D(t_max).) A small difference from D(t_max) remains,
  // because the origins of (1/3) <v(t_max).(r(t_max) - r(0))> extend one window further than those of C.
  Estimate msd_diffusion(std::size_t species) const;
  // Slope of the line through the mean squared displacement in [t_max/2, t_max], over 6.
  Estimate long_time_diffusion(std::size_t species) const;

  // d ln <|dr|^2>/d ln t at t_max: 2 in free flight, 1 in diffusion, less in a cage, 0 if nothing moves.
  double displacement_exponent(std::size_t species) const;
  // `length_unit`: of the model [sigma].
  DiffusionRegime regime(std::size_t species, double length_unit = 1.0) const;

  // All trajectories so far. Reading data of another window or other species throws Error(bad_input) if their curves differ in
  // length; the caller stores window and layout as well.
  void exchange(Archive& archive);

 private:
  enum Curve : std::size_t { correlation, integral, displacement, curve_count };

  void add_velocities(const TrajectoryRecord& record, std::size_t species, std::size_t column);
  void add_positions(const TrajectoryRecord& record, std::size_t species, std::size_t column);
  const double* curve(Curve which, std::size_t trajectory, std::size_t species) const;
  template <class Value>
  Estimate over_trajectories(Value value) const;
  Estimate at(Curve which, std::size_t species, std::size_t point) const;

  DiffusionWindow window_;
  std::vector<std::size_t> counts_;  // particles per species
  std::size_t points_;
  std::array<std::vector<double>, curve_count> curves_;  // trajectories x species x points
};

}  // namespace lanescape
