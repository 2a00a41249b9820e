#include "interaction/pair/pair_interaction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "interaction/pair/pair_parameters.hpp"
#include "interaction/pair/pair_sums.hpp"
#include "neighbour/neighbour_list.hpp"

namespace lanescape {

PairInteraction::PairInteraction(const PairModel& given, const Box& given_box, const ParticleLayout& given_layout,
                                 const kernels::KernelTable& table, const PairSearchOptions& options)
    : blocks_(given_layout.blocks()), reduced_(given.length_unit(diameter_scale(given, given_layout))) {
  const FloatEnvironment environment;
  check_cutoff(given, given_box, diameter_scale(given, given_layout));
  const PairModel model = given.in_unit(reduced_.unit());
  const Box box = reduced_.box(given_box);
  const ParticleLayout layout = given_layout.in_unit(reduced_.unit());
  const double scale = diameter_scale(model, layout);
  if (options.precision == Precision::mixed) check_single_precision(given, given_layout);
  if (takes_list(model, box, scale, layout.size(), options))
    sums_ = std::make_unique<ListSums>(model, box, layout, table, options.skin, useful_threads(layout.size(), options.threads),
                                       options.precision);
  else
    sums_ = std::make_unique<AllPairsSums>(model, box, layout, table);
  if (model.images == ImageRule::all) add_images_of_self(model, box, layout.diameters());
  if (model.truncation == Truncation::tail) add_tail(model, box);
}

PairInteraction::PairInteraction(PairInteraction&&) noexcept = default;
PairInteraction& PairInteraction::operator=(PairInteraction&&) noexcept = default;
PairInteraction::~PairInteraction() = default;

void PairInteraction::add_images_of_self(const PairModel& model, const Box& box, const AlignedArray& diameters) {
  for (std::size_t s = 0; s < blocks_.size(); ++s) {
    PairNumbers numbers = model.numbers(model.pair(s, s));
    if (!model.form->has_diameters) {
      add_images_of_one(model, numbers, static_cast<double>(blocks_[s].count), box);
      continue;
    }
    for (std::size_t slot = blocks_[s].begin; slot < blocks_[s].begin + blocks_[s].count; ++slot) {
      numbers.sigma = diameters[slot];
      add_images_of_one(model, numbers, 1.0, box);
    }
  }
}

void PairInteraction::add_images_of_one(const PairModel& model, const PairNumbers& numbers, double count, const Box& box) {
  const double cutoff = model.cutoff * numbers.sigma;
  // Half of each: the pair of a particle and its image belongs to one particle only.
  const double weight = 0.5 * count;
  const auto reach = [&](std::size_t axis) { return static_cast<int>(cutoff / box.length[axis]); };
  for (int a = -reach(0); a <= reach(0); ++a)
    for (int b = -reach(1); b <= reach(1); ++b)
      for (int c = -reach(2); c <= reach(2); ++c) {
        const std::array<double, 3> d = {a * box.length[0], b * box.length[1], c * box.length[2]};
        const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if (r2 == 0.0 || !(r2 < cutoff * cutoff)) continue;
        const PairDerivatives at = model.derivatives(numbers, std::sqrt(r2));
        constants_.energy += weight * at.u;
        const double virial = -weight * at.first;
        constants_.virial += virial;
        constexpr std::size_t voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
        for (std::size_t k = 0; k < 6; ++k) constants_.virial_tensor[k] += virial * d[voigt[k][0]] * d[voigt[k][1]] / r2;
      }
}

void PairInteraction::add_tail(const PairModel& model, const Box& box) {
  for (std::size_t a = 0; a < blocks_.size(); ++a)
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const double pairs = static_cast<double>(blocks_[a].count) * static_cast<double>(blocks_[b].count);
      const PairTail tail = long_range(model, a, b, box.volume());
      const double virial = pairs * tail.virial;
      constants_.energy += pairs * tail.energy;
      constants_.virial += virial;
      for (std::size_t k = 0; k < 3; ++k) constants_.virial_tensor[k] += virial / 3.0;
    }
}

PairInteraction::Evaluation PairInteraction::with_constants(const kernels::PairOutput& out) const {
  Evaluation e = constants_;
  e.energy += out.energy;
  e.virial += out.virial;
  return e;
}

double PairInteraction::energy(const AlignedArray& positions) {
  const FloatEnvironment environment;
  return sums_->energy(reduced_.of(positions)) + constants_.energy;
}

void PairInteraction::gradient(const AlignedArray& positions, AlignedArray& gradient) {
  const FloatEnvironment environment;
  sums_->gradient_only(reduced_.of(positions), gradient);
  reduced_.restore(gradient);
}

PairInteraction::Evaluation PairInteraction::energy_and_gradient(const AlignedArray& positions, AlignedArray& gradient) {
  const FloatEnvironment environment;
  kernels::PairOutput out;
  sums_->gradient(reduced_.of(positions), gradient, out);
  reduced_.restore(gradient);
  return with_constants(out);
}

PairInteraction::Evaluation PairInteraction::energy_and_stress(const AlignedArray& positions, AlignedArray& gradient) {
  const FloatEnvironment environment;
  kernels::PairOutput out;
  sums_->stress(reduced_.of(positions), gradient, out);
  reduced_.restore(gradient);
  Evaluation e = with_constants(out);
  for (std::size_t k = 0; k < 6; ++k) e.virial_tensor[k] += out.virial_tensor[k];
  return e;
}

void PairInteraction::exchange(Archive& archive) { sums_->exchange(archive); }

const NeighbourList* PairInteraction::list() const {
  const auto* sums = dynamic_cast<const ListSums*>(sums_.get());
  return sums == nullptr ? nullptr : &sums->list();
}

}  // namespace lanescape
