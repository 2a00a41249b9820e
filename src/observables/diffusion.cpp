#include "observables/diffusion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "observables/time_correlation.hpp"

namespace lanescape {
namespace {

constexpr std::uint64_t most_lags = 999, fewest_lags = 100;  // of the curves
constexpr std::uint64_t most_records = 1'000'000'000;        // far more than fits in memory

// Adds the squares of x[t + k] - x[t] to sum[k] for every origin t. The inner loop runs over lags, so each sum keeps its order and
// the compiler can vectorise.
void add_squared_displacements(const std::vector<double>& x, std::size_t origins, std::vector<double>& sum) {
  for (std::size_t t = 0; t < origins; ++t) {
    const double* from_origin = x.data() + t;
    for (std::size_t k = 0; k < sum.size(); ++k) {
      const double d = from_origin[k] - from_origin[0];
      sum[k] += d * d;
    }
  }
}

// Slope of the least-squares line through y[first], ..., y[end - 1], per point.
double fitted_slope(const double* y, std::size_t first, std::size_t end) {
  const double middle = 0.5 * static_cast<double>(first + end - 1);
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = first; i < end; ++i) {
    const double x = static_cast<double>(i) - middle;
    xx += x * x;
    xy += x * y[i];
  }
  return xy / xx;
}

}  // namespace

void DiffusionWindow::check() const {
  if (!(interval > 0.0) || !std::isfinite(interval))
    throw_bad_input(fmt::format("interval between records {} is not allowed: it must be finite and above 0", interval));
  if (lags == 0) throw_bad_input("window of 0 records is not allowed: at least 1");
  if (records <= lags) throw_bad_input(fmt::format("{} records are too few for a window of {}: more than that", records, lags));
  if (records > most_records) throw_bad_input(fmt::format("{} records are not allowed: at most {}", records, most_records));
  if (lags > most_lags && lags / stride() < fewest_lags)
    throw_bad_input(
        fmt::format("window of {} records is not allowed: at most {}, or a multiple of {} to {}, such as a round number", lags,
                    most_lags, fewest_lags, most_lags));
}

std::uint64_t DiffusionWindow::stride() const {
  std::uint64_t divisor = (lags + most_lags - 1) / most_lags;
  while (lags % divisor != 0) ++divisor;
  return divisor;
}

TrajectoryRecord::TrajectoryRecord(const ParticleLayout& layout, const DiffusionWindow& window)
    : window_(window), blocks_(layout.blocks()), slots_(layout.slots()), row_(3 * layout.size()) {
  window_.check();
  velocities_.reserve(row_ * window_.records);
  positions_.reserve(row_ * ((window_.records - 1) / window_.stride() + 1));
}

void TrajectoryRecord::record(const AlignedArray& velocity, const AlignedArray& position) {
  if (full()) throw Error(ErrorCode::internal, fmt::format("a trajectory of {} records is given one more", records_));
  const bool with_positions = records_ % window_.stride() == 0;
  for (const auto& block : blocks_)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t k = axis * slots_ + block.begin, end = k + block.count; k < end; ++k) {
        velocities_.push_back(static_cast<float>(velocity[k]));
        if (with_positions) positions_.push_back(position[k]);
      }
  ++records_;
}

void TrajectoryRecord::clear() {
  records_ = 0;
  velocities_.clear();
  positions_.clear();
}

DiffusionAccumulator::DiffusionAccumulator(const ParticleLayout& layout, const DiffusionWindow& window) : window_(window) {
  window_.check();
  points_ = window_.points();
  for (const auto& block : layout.blocks()) counts_.push_back(block.count);
}

void DiffusionAccumulator::add_trajectory(const TrajectoryRecord& record) {
  const DiffusionWindow& theirs = record.window_;
  bool fits = theirs.interval == window_.interval && theirs.lags == window_.lags && theirs.records == window_.records &&
              record.blocks_.size() == counts_.size();
  for (std::size_t s = 0; fits && s < counts_.size(); ++s) fits = record.blocks_[s].count == counts_[s];
  if (!fits || !record.full())
    throw Error(ErrorCode::internal,
                fmt::format("a trajectory is added that has another window or other particles, or {} of {} records",
                            record.records_, theirs.records));
  std::size_t column = 0;
  for (std::size_t s = 0; s < counts_.size(); ++s) {
    add_velocities(record, s, column);
    add_positions(record, s, column);
    column += 3 * counts_[s];
  }
}

void DiffusionAccumulator::add_velocities(const TrajectoryRecord& record, std::size_t species, std::size_t column) {
  const SeriesView series{record.velocities_.data(), window_.records, record.row_, column, 3 * counts_[species]};
  std::vector<double> vacf = full_window_correlation(series, window_.lags);
  const double samples = static_cast<double>(window_.origins()) * std::max(1.0, static_cast<double>(counts_[species]));
  for (double& c : vacf) c /= samples;
  const std::vector<double> running = running_simpson(vacf, window_.interval);
  for (std::size_t k = 0; k < vacf.size(); k += window_.stride()) {
    curves_[correlation].push_back(vacf[k]);
    curves_[integral].push_back(running[k] / 3.0);
  }
}

void DiffusionAccumulator::add_positions(const TrajectoryRecord& record, std::size_t species, std::size_t column) {
  const std::size_t origins = (window_.origins() - 1) / window_.stride() + 1;
  std::vector<double> x(record.positions_.size() / record.row_), sum(points_, 0.0);
  for (std::size_t c = column; c < column + 3 * counts_[species]; ++c) {
    for (std::size_t t = 0; t < x.size(); ++t) x[t] = record.positions_[t * record.row_ + c];
    add_squared_displacements(x, origins, sum);
  }
  const double samples = static_cast<double>(origins) * std::max(1.0, static_cast<double>(counts_[species]));
  for (const double squares : sum) curves_[displacement].push_back(squares / samples);
}

double DiffusionAccumulator::time(std::size_t point) const {
  return static_cast<double>(point * window_.stride()) * window_.interval;
}

const double* DiffusionAccumulator::curve(Curve which, std::size_t trajectory, std::size_t species) const {
  return curves_[which].data() + (trajectory * counts_.size() + species) * points_;
}

template <class Value>
Estimate DiffusionAccumulator::over_trajectories(Value value) const {
  std::vector<double> values(trajectories());
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = value(k);
  return estimate_mean(values);
}

Estimate DiffusionAccumulator::at(Curve which, std::size_t species, std::size_t point) const {
  return over_trajectories([&](std::size_t b) { return curve(which, b, species)[point]; });
}

Estimate DiffusionAccumulator::msd_diffusion(std::size_t species) const {
  return over_trajectories([&](std::size_t b) {
    const double* end = curve(displacement, b, species) + points_;
    const double difference = points_ < 3 ? end[-1] - end[-2] : 1.5 * end[-1] - 2.0 * end[-2] + 0.5 * end[-3];
    return difference / time(1) / 6.0;
  });
}

Estimate DiffusionAccumulator::long_time_diffusion(std::size_t species) const {
  return over_trajectories(
      [&](std::size_t b) { return fitted_slope(curve(displacement, b, species), (points_ - 1) / 2, points_) / time(1) / 6.0; });
}

double DiffusionAccumulator::displacement_exponent(std::size_t species) const {
  const double squared = squared_displacement(species, points_ - 1).value;
  return squared > 0.0 ? 6.0 * msd_diffusion(species).value * window_.longest_time() / squared : 0.0;
}

DiffusionRegime DiffusionAccumulator::regime(std::size_t species, double length_unit) const {
  const double exponent = displacement_exponent(species);
  if (exponent > 1.2) return DiffusionRegime::ballistic;
  const bool moved = squared_displacement(species, points_ - 1).value >= 0.1 * length_unit * length_unit;
  return moved && exponent >= 0.9 ? DiffusionRegime::diffusive : DiffusionRegime::caged;
}

void DiffusionAccumulator::exchange(Archive& archive) {
  archive.enter("diffusion");
  archive.field("velocity_correlation", curves_[correlation]);
  archive.field("diffusion_integral", curves_[integral]);
  archive.field("squared_displacement", curves_[displacement]);
  archive.leave();
  for (const auto& values : curves_)
    if (values.size() != curves_[0].size() || values.size() % (counts_.size() * points_) != 0)
      throw_bad_input("the archive's diffusion curves have another window or other species: it must be that of the same run");
}

}  // namespace lanescape
