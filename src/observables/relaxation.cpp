#include "observables/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/option_checks.hpp"

namespace lanescape {
namespace {

constexpr double lags_per_decade = 16.0;
constexpr std::uint64_t most_origins = 100;
constexpr std::uint64_t most_records = 1'000'000'000'000;  // so many intervals are counted exactly in a double

// Where `value` is largest inside of 0 ... count - 1.
template <class Value>
std::optional<std::size_t> inner_peak(std::size_t count, Value value) {
  std::size_t best = 0;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k)
    if (const double of_point = value(k); of_point > largest) {
      largest = of_point;
      best = k;
    }
  if (best == 0 || best + 1 == count) return std::nullopt;
  return best;
}

}  // namespace

void RelaxationWindow::check() const {
  check_positive("interval between records", interval);
  if (records < 2 || records > most_records)
    throw_bad_input(fmt::format("{} records for relaxation are not allowed: from 2 to {}", records, most_records));
  for (const double k : wave_numbers) check_positive("wave number", k);
  check_positive("overlap length", overlap_length);
}

std::vector<std::uint64_t> RelaxationWindow::lags() const {
  std::vector<std::uint64_t> lags;
  for (double power = 0.0;; ++power) {
    const auto lag = static_cast<std::uint64_t>(std::llround(std::pow(10.0, power / lags_per_decade)));
    if (lag > records / 2) return lags;
    if (lags.empty() || lag > lags.back()) lags.push_back(lag);
  }
}

std::uint64_t RelaxationWindow::origin_spacing() const { return (records + most_origins - 1) / most_origins; }

RelaxationAccumulator::RelaxationAccumulator(const ParticleLayout& layout, const RelaxationWindow& window)
    : window_(window), blocks_(layout.blocks()), slots_(layout.slots()) {
  window_.check();
  if (window_.wave_numbers.size() != blocks_.size())
    throw_bad_input(fmt::format("{} wave numbers are given for {} species", window_.wave_numbers.size(), blocks_.size()));
  lags_ = window_.lags();
  current_.assign(trajectory_size(), 0.0);
}

void RelaxationAccumulator::record(const AlignedArray& position) {
  for (std::size_t o = 0; o < origins_.size(); ++o) {
    std::size_t& next = next_point_[o];
    if (next == points() || records_ != o * window_.origin_spacing() + lags_[next]) continue;
    add_displacements(origins_[o], position, next++);
  }
  if (records_ % window_.origin_spacing() == 0) {
    origins_.push_back(position);
    next_point_.push_back(0);
  }
  if (++records_ == window_.records) end_trajectory();
}

void RelaxationAccumulator::add_displacements(const AlignedArray& from, const AlignedArray& to, std::size_t point) {
  const double a2 = window_.overlap_length * window_.overlap_length;
  for (std::size_t s = 0; s < blocks_.size(); ++s) {
    const double k = window_.wave_numbers[s];
    Moments sum{};
    for (std::size_t i = blocks_[s].begin; i < blocks_[s].begin + blocks_[s].count; ++i) {
      double r2 = 0.0;
      for (std::size_t c = i; c < 3 * slots_; c += slots_) r2 += (to[c] - from[c]) * (to[c] - from[c]);
      const double kr = k * std::sqrt(r2);
      sum[squared] += r2;
      sum[fourth] += r2 * r2;
      sum[scattering] += kr > 0.0 ? std::sin(kr) / kr : 1.0;
      sum[overlap] += r2 < a2 ? 1.0 : 0.0;
    }
    sum[overlap_squared] = sum[overlap] * sum[overlap];
    for (std::size_t m = 0; m < moment_count; ++m) current_[index(s, point, static_cast<Moment>(m))] += sum[m];
  }
}

void RelaxationAccumulator::end_trajectory() {
  for (std::size_t s = 0; s < blocks_.size(); ++s)
    for (std::size_t p = 0; p < points(); ++p) {
      const std::uint64_t origins = (window_.records - 1 - lags_[p]) / window_.origin_spacing() + 1;
      const double particles = std::max(1.0, static_cast<double>(blocks_[s].count));
      for (std::size_t m = 0; m < moment_count; ++m) {
        const double samples = static_cast<double>(origins) * (m < overlap ? particles : 1.0);
        sums_.push_back(current_[index(s, p, static_cast<Moment>(m))] / samples);
      }
    }
  current_.assign(trajectory_size(), 0.0);
  origins_.clear();
  next_point_.clear();
  records_ = 0;
}

double RelaxationAccumulator::mean(std::size_t without, std::size_t species, std::size_t point, Moment moment) const {
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < trajectories(); ++k) {
    if (k == without) continue;
    sum += sums_[k * trajectory_size() + index(species, point, moment)];
    ++count;
  }
  return count > 0.0 ? sum / count : 0.0;
}

double RelaxationAccumulator::non_gaussian_of(std::size_t without, std::size_t species, std::size_t point) const {
  const double r2 = mean(without, species, point, squared);
  return r2 > 0.0 ? 0.6 * mean(without, species, point, fourth) / (r2 * r2) - 1.0 : 0.0;
}

double RelaxationAccumulator::susceptibility_of(std::size_t without, std::size_t species, std::size_t point) const {
  const double q = mean(without, species, point, overlap), particles = static_cast<double>(blocks_[species].count);
  return particles > 0.0 ? (mean(without, species, point, overlap_squared) - q * q) / particles : 0.0;
}

double RelaxationAccumulator::relaxation_time_of(std::size_t without, std::size_t species) const {
  constexpr double level = 1.0 / std::numbers::e;
  double before = mean(without, species, 0, scattering);
  for (std::size_t p = 1; p < points() && before > level; ++p) {
    const double after = mean(without, species, p, scattering);
    if (after <= level) return time(p - 1) * std::pow(time(p) / time(p - 1), (before - level) / (before - after));
    before = after;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Estimate RelaxationAccumulator::squared_displacement(std::size_t species, std::size_t point) const {
  return jackknife(trajectories(), [&](std::size_t without) { return mean(without, species, point, squared); });
}

Estimate RelaxationAccumulator::intermediate_scattering(std::size_t species, std::size_t point) const {
  return jackknife(trajectories(), [&](std::size_t without) { return mean(without, species, point, scattering); });
}

Estimate RelaxationAccumulator::non_gaussian(std::size_t species, std::size_t point) const {
  return jackknife(trajectories(), [&](std::size_t without) { return non_gaussian_of(without, species, point); });
}

Estimate RelaxationAccumulator::susceptibility(std::size_t species, std::size_t point) const {
  return jackknife(trajectories(), [&](std::size_t without) { return susceptibility_of(without, species, point); });
}

std::optional<Estimate> RelaxationAccumulator::relaxation_time(std::size_t species) const {
  Estimate time = jackknife(trajectories(), [&](std::size_t without) { return relaxation_time_of(without, species); });
  if (!std::isfinite(time.value)) return std::nullopt;
  if (time.error && !std::isfinite(*time.error)) time.error.reset();
  return time;
}

std::optional<std::size_t> RelaxationAccumulator::non_gaussian_peak(std::size_t species) const {
  return inner_peak(points(), [&](std::size_t p) { return non_gaussian_of(trajectories(), species, p); });
}

std::optional<std::size_t> RelaxationAccumulator::susceptibility_peak(std::size_t species) const {
  return inner_peak(points(), [&](std::size_t p) { return susceptibility_of(trajectories(), species, p); });
}

void RelaxationAccumulator::exchange(Archive& archive) {
  archive.enter("relaxation");
  archive.field("moments", sums_);
  archive.leave();
  if (sums_.size() % trajectory_size() != 0)
    throw_bad_input("the archive's relaxation curves have another window or other species: it must be that of the same run");
}

}  // namespace lanescape
