#include "interaction/pair/probe_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/pair_parameters.hpp"

namespace lanescape {
namespace {

double largest_diameter(const PairModel& model, const Configuration& fluid, double diameter) {
  double largest = model.form->has_diameters ? diameter : 1.0;
  for (const double d : fluid.diameters) largest = std::max(largest, d);
  return largest;
}

// That of a particle's own images and its own long-range correction.
double energy_alone(const PairModel& model, const Box& box, int species, double diameter, const kernels::KernelTable& table) {
  Configuration alone{box, {species}, {0.0, 0.0, 0.0}};
  // There are no own images under this rule, and in a box with open axes it asks for room for a list.
  if (model.images == ImageRule::minimum) alone.box.periodic = {true, true, true};
  if (model.form->has_diameters) alone.diameters = {diameter};
  const ParticleLayout layout = ParticleLayout::in_users_order(alone, model.species.size());
  return PairInteraction(model, alone.box, layout, table).energy(layout.to_slots(alone.positions));
}

}  // namespace

ProbeField::ProbeField(const PairModel& model, const Configuration& fluid, int species, const kernels::KernelTable& table,
                       double diameter)
    : table_(&table),
      model_(model),
      kernels_(&table.pair_kernels(model.kernel_form().kernel)),
      species_(species),
      box_(fluid.box, model.length_unit(largest_diameter(model, fluid, diameter))),
      diameter_(diameter / box_.unit()) {
  const FloatEnvironment environment;
  const double scale = largest_diameter(model, fluid, diameter);
  check_cutoff(model, fluid.box, scale);
  const std::size_t count = model.species.size();
  if (species < 0 || static_cast<std::size_t>(species) >= count)
    throw_bad_input(fmt::format("species {} of an inserted particle is not allowed: the model has {}", species, count));
  put_fluid(model.in_unit(box_.unit()), fluid, model.form->has_diameters ? scale / box_.unit() : 1.0);
  box_.check(model, largest_cutoff_, "insertion");
  own_ = energy_alone(model, fluid.box, species, diameter, table);
  refresh();
}

void ProbeField::put_fluid(const PairModel& model, const Configuration& fluid, double scale) {
  const std::size_t count = model.species.size();
  const std::vector<kernels::PairParameters> all = pair_parameters(model);
  std::vector<std::vector<Point>> points(count);
  std::vector<std::vector<double>> diameters(count);
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    const auto s = static_cast<std::size_t>(fluid.species[i]);
    points[s].push_back(box_.home(fluid.position(i)));
    if (!fluid.diameters.empty()) diameters[s].push_back(fluid.diameters[i] / box_.unit());
  }
  for (std::size_t b = 0; b < count; ++b) {
    const std::size_t ab = model.pair(static_cast<std::size_t>(species_), b);
    const double cutoff = scale * model.cutoff_of(ab);
    largest_cutoff_ = std::max(largest_cutoff_, cutoff * box_.unit());
    largest_sigma_ = std::max(largest_sigma_, model_.sigma[ab]);
    pairs_.push_back(all[ab]);
    cells_.emplace_back(box_.reduced(), cutoff, points[b].size());
    cells_.back().assign(points[b], diameters[b]);
    tail_.push_back(model_.truncation == Truncation::tail
                        ? 2.0 * long_range(model_, static_cast<std::size_t>(species_), b, box_.box().volume()).energy
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

ProbeField::Sample ProbeField::sample(const Point& position) const {
  const FloatEnvironment environment;
  kernels::ProbeOutput out;
  const Point at = box_.home(position);
  kernels_->probe({views_.data(), views_.size(), diameter_}, at.data(), out);
  return {out.energy + constant_, {out.gradient[0] / box_.unit(), out.gradient[1] / box_.unit(), out.gradient[2] / box_.unit()}};
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
    const Point at = box_.home(point_at(positions.data(), k));
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
  if (box_.unit() != 1.0) {
    reduced.assign(clearances.begin(), clearances.end());
    reduced.insert(reduced.end(), positions.begin(), positions.end());
    for (double& length : reduced) length /= box_.unit();
    clearances = {reduced.data(), clearances.size()};
    positions = {reduced.data() + clearances.size(), positions.size()};
  }
  return table_->probe_first_clear({views_.data(), views_.size(), diameter_}, clearances.data(), positions.data(),
                                   positions.size() / 3);
}

void ProbeField::insert(const Point& position, int species) {
  cells_[static_cast<std::size_t>(species)].insert(box_.home(position), diameter_);
  refresh();
}

bool ProbeField::remove(const Point& position, int species) {
  const bool removed = cells_[static_cast<std::size_t>(species)].remove(box_.home(position));
  refresh();
  return removed;
}

std::size_t ProbeField::size() const {
  std::size_t size = 0;
  for (const ProbeCells& cells : cells_) size += cells.size();
  return size;
}

}  // namespace lanescape
