#include "interaction/pair/probe_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/pair_parameters.hpp"
#include "interaction/reduced_positions.hpp"

namespace lanescape {
namespace {

constexpr double largest_edge = 1e7;  // [ProbeField::length_unit()]

// That of a particle's own images and its own long-range correction.
double energy_alone(const PairModel& model, const Box& box, int species, double diameter, const kernels::KernelTable& table) {
  Configuration alone{box, {species}, {0.0, 0.0, 0.0}};
  if (model.form->has_diameters) alone.diameters = {diameter};
  const ParticleLayout layout = ParticleLayout::in_users_order(alone, model.species.size());
  return PairInteraction(model, box, layout, table).energy(layout.to_slots(alone.positions));
}

}  // namespace

ProbeField::ProbeField(const PairModel& model, const Configuration& fluid, int species, const kernels::KernelTable& table,
                       double diameter)
    : table_(&table), model_(model), kernels_(&table.pair_kernels(model.kernel_form().kernel)), box_(fluid.box), species_(species) {
  const FloatEnvironment environment;
  double scale = model.form->has_diameters ? diameter : 1.0;
  for (const double d : fluid.diameters) scale = std::max(scale, d);
  unit_ = model.length_unit(scale);
  diameter_ = diameter / unit_;
  check_cutoff(model, box_, scale);
  const std::size_t count = model.species.size();
  if (species < 0 || static_cast<std::size_t>(species) >= count)
    throw_bad_input(fmt::format("species {} of an inserted particle is not allowed: the model has {}", species, count));
  for (const double edge : box_.length)
    if (edge > largest_edge * unit_)
      throw_bad_input(fmt::format(
          "insertion is not allowed in a box of edge {}: at most {} are, or coordinates in the box lose too many digits", edge,
          largest_edge * unit_));
  put_fluid(model.in_unit(unit_), fluid, model.form->has_diameters ? scale / unit_ : 1.0);
  if (model.images == ImageRule::minimum && 2.0 * largest_cutoff_ > box_.shortest())
    throw_bad_input(
        fmt::format("insertion under the minimum-image rule is not allowed in a box of shortest edge {}: at least twice the "
                    "cutoff, {}, is needed",
                    box_.shortest(), 2.0 * largest_cutoff_));
  own_ = energy_alone(model, box_, species, diameter, table);
  refresh();
}

void ProbeField::put_fluid(const PairModel& model, const Configuration& fluid, double scale) {
  const std::size_t count = model.species.size();
  const std::vector<kernels::PairParameters> all = pair_parameters(model);
  std::vector<std::vector<Point>> points(count);
  std::vector<std::vector<double>> diameters(count);
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    const auto s = static_cast<std::size_t>(fluid.species[i]);
    points[s].push_back(home(fluid.position(i)));
    if (!fluid.diameters.empty()) diameters[s].push_back(fluid.diameters[i] / unit_);
  }
  for (std::size_t b = 0; b < count; ++b) {
    const std::size_t ab = model.pair(static_cast<std::size_t>(species_), b);
    const double cutoff = scale * model.cutoff_of(ab);
    largest_cutoff_ = std::max(largest_cutoff_, cutoff * unit_);
    largest_sigma_ = std::max(largest_sigma_, model_.sigma[ab]);
    pairs_.push_back(all[ab]);
    cells_.emplace_back(ReducedPositions(unit_).box(box_), cutoff, points[b].size());
    cells_.back().assign(points[b], diameters[b]);
    tail_.push_back(model_.truncation == Truncation::tail
                        ? 2.0 * long_range(model_, static_cast<std::size_t>(species_), b, box_.volume()).energy
                        : 0.0);
    reaches_.push_back(scale * std::sqrt(all[ab].cutoff_squared));
  }
}

void ProbeField::refresh() {
  views_.clear();
  constant_ = own_;
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    views_.push_back(cells_[b].view());
    views_.back().pair = pairs_[b];
    views_.back().reach = reaches_[b];
    constant_ += tail_[b] * static_cast<double>(cells_[b].size());
  }
}

ProbeField::Point ProbeField::home(const Point& position) const {
  Point home{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double x = position[axis];
    if (!(x >= 0.0 && x < box_.length[axis])) {
      check_finite({&x, 1});
      x = box_.wrapped(axis, x);
    }
    home[axis] = x / unit_;
  }
  return home;
}

ProbeField::Sample ProbeField::sample(const Point& position) const {
  const FloatEnvironment environment;
  kernels::ProbeOutput out;
  const Point at = home(position);
  kernels_->probe({views_.data(), views_.size(), diameter_}, at.data(), out);
  return {out.energy + constant_, {out.gradient[0] / unit_, out.gradient[1] / unit_, out.gradient[2] / unit_}};
}

double ProbeField::energy(const Point& position) const {
  double energy = 0.0;
  energies(position, {&energy, 1});
  return energy;
}

void ProbeField::energies(std::span<const double> positions, std::span<double> out) const {
  const FloatEnvironment environment;
  std::vector<double> wrapped;
  wrapped.reserve(positions.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Point at = home(point_at(positions.data(), k));
    wrapped.insert(wrapped.end(), at.begin(), at.end());
  }
  kernels_->probe_energies({views_.data(), views_.size(), diameter_}, wrapped.data(), out.size(), out.data());
  for (double& energy : out) energy += constant_;
}

std::vector<double> ProbeField::clearances(double energy) const {
  std::vector<double> clearances;
  for (std::size_t b = 0; b < pairs_.size(); ++b)
    clearances.push_back(
        model_.form->repulsive_distance(model_.numbers(model_.pair(static_cast<std::size_t>(species_), b)), energy));
  return clearances;
}

std::size_t ProbeField::first_clear(std::span<const double> clearances, std::span<const double> positions) const {
  const FloatEnvironment environment;
  std::vector<double> reduced;
  if (unit_ != 1.0) {
    reduced.assign(clearances.begin(), clearances.end());
    reduced.insert(reduced.end(), positions.begin(), positions.end());
    for (double& length : reduced) length /= unit_;
    clearances = {reduced.data(), clearances.size()};
    positions = {reduced.data() + clearances.size(), positions.size()};
  }
  return table_->probe_first_clear({views_.data(), views_.size(), diameter_}, clearances.data(), positions.data(),
                                   positions.size() / 3);
}

void ProbeField::insert(const Point& position, int species) {
  cells_[static_cast<std::size_t>(species)].insert(home(position), diameter_);
  refresh();
}

bool ProbeField::remove(const Point& position, int species) {
  const bool removed = cells_[static_cast<std::size_t>(species)].remove(home(position));
  refresh();
  return removed;
}

std::size_t ProbeField::size() const {
  std::size_t size = 0;
  for (const ProbeCells& cells : cells_) size += cells.size();
  return size;
}

}  // namespace lanescape
