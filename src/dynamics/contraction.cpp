#include "dynamics/contraction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "configuration/hard_sphere_model.hpp"
#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/option_checks.hpp"
#include "neighbour/cell_grid.hpp"

namespace lanescape {
namespace {

// Pairs are pushed slightly beyond contact: pushes to contact itself would converge without ending. Much smaller than the gaps
// between spheres in any fluid.
constexpr double push_margin = 1e-6;
// Gives about fifteen neighbours per sphere at liquid densities, and several moves of the usual size between rebuilds.
constexpr double skin_per_diameter = 0.5;

}  // namespace

SqueezedSpheres::SqueezedSpheres(const Configuration& start)
    : spheres_(start), positions_(start.size()), list_begin_(start.size() + 1, 0) {
  check_periodic(start.box, "hard spheres");
  spheres_.wrap();
  for (std::size_t i = 0; i < start.size(); ++i)
    positions_[i] = {spheres_.positions[3 * i], spheres_.positions[3 * i + 1], spheres_.positions[3 * i + 2]};
  skin_ = skin_per_diameter * 2.0 * *std::min_element(start.radii.begin(), start.radii.end());
}

double SqueezedSpheres::packing_fraction() const { return lanescape::packing_fraction(spheres_); }

Configuration SqueezedSpheres::configuration() const {
  Configuration now = spheres_;
  for (std::size_t i = 0; i < positions_.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) now.positions[3 * i + axis] = positions_[i][axis];
  now.wrap();
  return now;
}

double SqueezedSpheres::distance_squared(const Position& a, const Position& b) const {
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Both positions were in the box when the lists were built, so they differ by little more than one box edge.
    const double length = spheres_.box.length[axis], d = std::fabs(b[axis] - a[axis]), nearest = std::min(d, std::fabs(length - d));
    squared += nearest * nearest;
  }
  return squared;
}

void SqueezedSpheres::make_lists() {
  const double largest = 2.0 * *std::max_element(spheres_.radii.begin(), spheres_.radii.end());
  CellGrid grid(spheres_.box, largest + skin_, positions_.size());
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) positions_[i][axis] = spheres_.box.wrapped(axis, positions_[i][axis]);
    grid.insert(static_cast<std::int32_t>(i), positions_[i]);
  }
  lists_.clear();
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    list_begin_[i] = lists_.size();
    grid.for_each_near(positions_[i], [&](std::int32_t candidate) {
      const auto j = static_cast<std::size_t>(candidate);
      const double reach = spheres_.radii[i] + spheres_.radii[j] + skin_;
      if (j != i && distance_squared(positions_[i], positions_[j]) < reach * reach) lists_.push_back(static_cast<std::uint32_t>(j));
    });
  }
  list_begin_.back() = lists_.size();
  made_at_ = positions_;
  stale_ = false;
}

void SqueezedSpheres::place(std::size_t i, const Position& position) {
  positions_[i] = position;
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) squared += std::pow(position[axis] - made_at_[i][axis], 2);
  // Slightly less than (skin / 2)^2, because the displacement is rounded.
  stale_ = stale_ || squared > 0.249 * skin_ * skin_;
}

void SqueezedSpheres::scale_volume(double factor) {
  const double edge_factor = std::cbrt(factor);
  for (double& length : spheres_.box.length) length *= edge_factor;
  for (Position& position : positions_)
    for (double& x : position) x *= edge_factor;
  stale_ = true;
}

bool SqueezedSpheres::push_apart(std::uint64_t max_passes) {
  for (std::uint64_t pass = 0; pass < max_passes; ++pass)
    if (!push_pairs_apart()) return true;
  return false;
}

// One pass over all pairs. Returns true if any pair overlapped.
bool SqueezedSpheres::push_pairs_apart() {
  if (stale_) make_lists();
  bool pushed = false;
  for (std::size_t i = 0; i < positions_.size(); ++i)
    for (std::size_t k = list_begin_[i]; k < list_begin_[i + 1]; ++k) {
      const std::size_t j = lists_[k];
      const double contact = spheres_.radii[i] + spheres_.radii[j];
      if (j < i || distance_squared(positions_[i], positions_[j]) >= contact * contact) continue;
      Position line{};
      double squared = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        line[axis] = spheres_.box.nearest_image(axis, positions_[j][axis] - positions_[i][axis]);
        squared += line[axis] * line[axis];
      }
      const double distance = std::sqrt(squared);
      if (!(distance > 0.0)) line = {1.0, 0.0, 0.0};  // coincident centres: any direction will separate them
      const double each = 0.5 * (contact * (1.0 + push_margin) - distance) / (distance > 0.0 ? distance : 1.0);
      Position a = positions_[i], b = positions_[j];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        a[axis] -= each * line[axis];
        b[axis] += each * line[axis];
      }
      place(i, a);
      place(j, b);
      pushed = true;
    }
  return pushed;
}

bool SqueezedSpheres::fits(std::size_t i, const Position& position) const {
  for (std::size_t k = list_begin_[i]; k < list_begin_[i + 1]; ++k) {
    const std::size_t j = lists_[k];
    const double contact = spheres_.radii[i] + spheres_.radii[j];
    if (distance_squared(position, positions_[j]) < contact * contact) return false;
  }
  return true;
}

std::size_t SqueezedSpheres::sweep(const CounterRandom& random, std::uint64_t sweep, double max_move) {
  std::size_t accepted = 0;
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    if (stale_) make_lists();
    const Position before = positions_[i];
    Position trial = before;
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      trial[axis] += max_move * (2.0 * random.uniform(sweep, static_cast<std::uint32_t>(i), axis) - 1.0);
    // An overlap found in the old lists is certain. So the lists are rebuilt, after a move beyond the skin, only for moves that
    // pass this first test.
    if (!fits(i, trial)) continue;
    place(i, trial);
    if (stale_) {
      make_lists();
      if (!fits(i, positions_[i])) {
        place(i, before);
        continue;
      }
    }
    ++accepted;
  }
  return accepted;
}

void ContractionOptions::check() const {
  if (!(volume_factor >= 0.9 && volume_factor < 1.0))
    throw_bad_input(fmt::format("volume factor {} is not allowed: at least 0.9 and below 1", volume_factor));
  if (!(max_move > 0.0 && max_move <= 1.0))
    throw_bad_input(fmt::format("largest move {} is not allowed: above 0 and at most 1 diameter of the smallest sphere", max_move));
  check_at_least_one("number of passes over overlapping pairs", max_passes);
}

std::optional<Configuration> contract(const Configuration& start, double fraction, const ContractionOptions& options,
                                      std::uint64_t seed, RunMonitor& monitor) {
  options.check();
  if (packing_fraction(start) >= fraction) return start;
  const CounterRandom random(seed, RandomStream::monte_carlo);
  const double max_move = options.max_move * 2.0 * *std::min_element(start.radii.begin(), start.radii.end());
  SqueezedSpheres spheres(start);
  std::uint64_t sweeps = 0;
  for (double now = spheres.packing_fraction(); now < fraction; now = spheres.packing_fraction()) {
    monitor.progress("contraction", now, fraction);
    spheres.scale_volume(options.volume_factor);
    if (!spheres.push_apart(options.max_passes))
      throw_bad_input(fmt::format("packing fraction {} is beyond what mechanical contraction reached for this composition ({:.4f})",
                                  fraction, now));
    for (std::uint64_t k = 0; k < options.sweeps; ++k) {
      if (monitor.stop_requested()) return std::nullopt;
      spheres.sweep(random, sweeps++, max_move);
    }
  }
  Configuration dense = spheres.configuration();
  const double edge = cube_edge(dense, fraction);
  // A larger box only moves periodic images further apart, so it causes no overlap.
  dense.box.length = {edge, edge, edge};
  return dense;
}

}  // namespace lanescape
