#include "interaction/pair/pair_moves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "configuration/particle_layout.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "interaction/pair/images.hpp"
#include "interaction/pair/pair_parameters.hpp"

namespace lanescape {
namespace {

double scale_of(const PairModel& model, const Configuration& configuration) {
  return diameter_scale(model, ParticleLayout::in_users_order(configuration, model.species.size()));
}

}  // namespace

PairMoves::PairMoves(const PairModel& model, const Configuration& configuration, const kernels::KernelTable& table)
    : box_(configuration.box, model.length_unit(scale_of(model, configuration))),
      kernels_(&table.pair_kernels(model.kernel_form().kernel)),
      species_(configuration.species.begin(), configuration.species.end()),
      positions_(configuration.positions),
      species_count_(model.species.size()) {
  const FloatEnvironment environment;
  const double scale = scale_of(model, configuration);
  check_cutoff(model, configuration.box, scale);
  box_.check(model, scale * model.largest_cutoff(), "moving single particles");
  put_pairs(model.in_unit(box_.unit()), model.form->has_diameters ? scale / box_.unit() : 1.0);
  put_particles(model, configuration);
}

void PairMoves::put_pairs(const PairModel& model, double scale) {
  const std::vector<kernels::PairParameters> pairs = pair_parameters(model);
  views_.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    views_[k].pair = pairs[k];
    views_[k].reach = scale * std::sqrt(pairs[k].cutoff_squared);
  }
}

void PairMoves::put_particles(const PairModel& model, const Configuration& configuration) {
  std::vector<std::vector<Point>> homes(species_count_);
  std::vector<std::vector<double>> diameters(species_count_);
  for (std::size_t i = 0; i < size(); ++i) {
    homes_.push_back(box_.home(configuration.position(i)));
    homes[species_[i]].push_back(homes_[i]);
    if (!model.form->has_diameters) continue;
    diameters_.push_back(configuration.diameters[i] / box_.unit());
    diameters[species_[i]].push_back(diameters_[i]);
  }
  for (std::size_t b = 0; b < species_count_; ++b) {
    double reach = 0.0;
    for (std::size_t a = 0; a < species_count_; ++a) reach = std::max(reach, views_[a * species_count_ + b].reach);
    cells_.emplace_back(box_.reduced(), reach, homes[b].size());
    cells_.back().assign(homes[b], diameters[b]);
    refresh(b);
  }
}

void PairMoves::refresh(std::size_t species) {
  for (std::size_t k = species; k < views_.size(); k += species_count_) cells_[species].put_points(views_[k]);
}

void PairMoves::lift(std::size_t particle) {
  if (particle == lifted_) return;
  if (lifted_ != none) {
    cells_[species_[lifted_]].insert(homes_[lifted_], diameter_of(lifted_));
    refresh(species_[lifted_]);
  }
  cells_[species_[particle]].remove(homes_[particle], diameter_of(particle));
  refresh(species_[particle]);
  lifted_ = particle;
  here_ = energy_at(homes_[particle]);
}

double PairMoves::energy_at(const Point& home) const {
  double energy = 0.0;
  kernels_->probe_energies({views_.data() + species_[lifted_] * species_count_, species_count_, diameter_of(lifted_)}, home.data(),
                           1, &energy);
  return energy;
}

double PairMoves::energy_change(std::size_t particle, const Point& to) {
  const FloatEnvironment environment;
  if (particle >= size())
    throw_bad_input(fmt::format("particle {} is not allowed: the last of {} particles is {}", particle, size(),
                                static_cast<std::ptrdiff_t>(size()) - 1));
  const Point home = box_.home(to);
  lift(particle);
  to_ = to;
  to_home_ = home;
  there_ = energy_at(home);
  return there_ - here_;
}

void PairMoves::accept() {
  if (lifted_ == none) throw_bad_input("no move to accept: ask for the energy change of one first");
  std::copy(to_.begin(), to_.end(), positions_.begin() + static_cast<std::ptrdiff_t>(3 * lifted_));
  homes_[lifted_] = to_home_;
  here_ = there_;
}

}  // namespace lanescape
