#include "interaction/state/local_density.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "interaction/state/state_block.hpp"

namespace lanescape {
namespace {

UniformSpline spline_in_square(const std::function<double(double r)>& w, double cutoff, std::size_t intervals) {
  const double spacing = cutoff * cutoff / static_cast<double>(intervals);
  std::vector<double> values;
  for (std::size_t k = 0; k < intervals; ++k) values.push_back(w(std::sqrt(static_cast<double>(k) * spacing)));
  values.push_back(0.0);
  return {0.0, spacing, values, std::nullopt, 0.0};
}

}  // namespace

SwitchingFunction::SwitchingFunction(const std::function<double(double r)>& w, double cutoff, std::size_t intervals)
    : cutoff_(cutoff), spline_(spline_in_square(w, cutoff, intervals)) {
  for (std::size_t k = 0; k < intervals; ++k) records_.insert(records_.end(), spline_.piece(k).begin(), spline_.piece(k).end());
  records_.resize(records_.size() + kernels::point_width, 0.0);
}

SwitchingFunction SwitchingFunction::tapered_tanh(double threshold, double width, double cutoff) {
  const auto w = [=](double r) {
    const double s = std::max(0.0, (r - 0.8 * cutoff) / (0.2 * cutoff));
    return 0.5 * (1.0 - std::tanh((r - threshold) / width)) * (1.0 - s * s * s * (10.0 - s * (15.0 - 6.0 * s)));
  };
  return {w, cutoff};
}

kernels::SwitchingSpline SwitchingFunction::view() const {
  return {{records_.data(), 1.0 / spline_.spacing(), static_cast<double>(spline_.intervals())}, cutoff_ * cutoff_};
}

LocalDensity::LocalDensity(std::vector<SwitchingFunction> switching, std::vector<double> filter)
    : switching_(std::move(switching)),
      species_(static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(filter.size()))))),
      filter_(std::move(filter)),
      filter_back_(filter_.size()) {
  for (std::size_t s = 0; s < species_; ++s)
    for (std::size_t t = 0; t < species_; ++t) filter_back_[s * species_ + t] = filter_[t * species_ + s];
}

std::vector<double> LocalDensity::reaches() const {
  std::vector<double> reaches(filter_.size(), 0.0);
  for (std::size_t k = 0; k < filter_.size(); ++k) {
    if (filter_[k] != 0.0) reaches[k] = of(k / species_).cutoff();
    if (filter_back_[k] != 0.0) reaches[k] = std::max(reaches[k], of(k % species_).cutoff());
  }
  return reaches;
}

void LocalDensity::evaluate(Sites& sites, AlignedArray& values) {
  const auto& list = sites.list();
  const auto scratch = [] { return std::array<double, NeighbourList::block_rows>(); };
  sites.for_each_block(scratch, [&](std::size_t b, const kernels::NeighbourRows& rows, auto& densities) {
    const std::size_t species = list.species_of(b);
    const Sites::Near near = sites.near(b);
    sites.kernels().state_densities({rows, of(species).view(), filter_.data() + species * species_, near.reaches_squared,
                                     near.places, near.lengths, near.slopes},
                                    densities.data());
    for_each_row(list, rows, [&](std::size_t row, std::size_t slot) { values[slot] = densities[row]; });
  });
  sites.use_near();
}

void LocalDensity::add_gradient(Sites& sites, const AlignedArray& multipliers, StateSums& sums) {
  const auto& list = sites.list();
  std::vector<kernels::SwitchingSpline> switchings;
  for (std::size_t s = 0; s < species_; ++s) switchings.push_back(of(s).view());
  std::vector<kernels::PairOutput> blocks(list.block_count());
  const bool stress = sums.wanted == StateSums::Wanted::stress;
  const auto gradient = stress ? sites.kernels().state_density_stress : sites.kernels().state_density_gradient;
  sites.put_values(multipliers);
  const auto scratch = [] { return BlockScratch(0); };
  sites.for_each_block(scratch, [&](std::size_t b, const kernels::NeighbourRows& rows, BlockScratch& own) {
    const std::size_t species = list.species_of(b), first = species * species_;
    gradient(
        {rows, switchings[species], switchings.data(), filter_.data() + first, filter_back_.data() + first, sites.near(b).slopes},
        own.records.data(), blocks[b]);
    blocks[b].energy = 0.0;
    add_rows(sites, rows, own.records.data(), sums.gradient);
  });
  add_blocks(blocks, sums);
}

TanhCascade::TanhCascade(std::vector<std::vector<Step>> of_species) : steps_(std::move(of_species)), states_(1) {
  for (const auto& steps : steps_) states_ = std::max(states_, steps.size() + 1);
}

void TanhCascade::evaluate(std::size_t species, double value, std::span<StateProbability> states) const {
  // The probability left after the states before.
  StateProbability rest{1.0, 0.0, 0.0};
  std::size_t a = 0;
  for (const Step& step : steps_[species]) {
    // ln above - ln below = 2x: the larger of the two is never the logarithm of a small number, and gives the other.
    const double x = (value - step.threshold) / step.width, small = std::exp(-2.0 * std::abs(x));
    const double major = 1.0 / (1.0 + small), minor = small * major, log_major = std::log(major);
    const double above = x > 0.0 ? major : minor, below = x > 0.0 ? minor : major;
    const double log_above = x > 0.0 ? log_major : 2.0 * x + log_major, slope = 2.0 * major * minor / step.width;
    states[a++] = {rest.p * above, rest.slope * above + rest.p * slope, rest.logarithm + log_above};
    rest = {rest.p * below, rest.slope * below - rest.p * slope, rest.logarithm + log_above - 2.0 * x};
  }
  states[a++] = rest;
  for (; a < states.size(); ++a) states[a] = {};
}

void FixedProbabilities::evaluate(std::size_t species, double, std::span<StateProbability> states) const {
  for (std::size_t a = 0; a < states.size(); ++a) {
    const double p = p_[species][a];
    states[a] = {p, 0.0, p > 0.0 ? std::log(p) : 0.0};
  }
}

}  // namespace lanescape
