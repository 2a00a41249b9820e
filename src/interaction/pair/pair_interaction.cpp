#include "interaction/pair/pair_interaction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "interaction/pair/cluster_sums.hpp"
#include "interaction/pair/excluding_sums.hpp"
#include "interaction/pair/nearest_rows.hpp"
#include "interaction/pair/pair_parameters.hpp"
#include "interaction/pair/pair_segment_bound.hpp"
#include "interaction/pair/pair_sums.hpp"
#include "neighbour/neighbour_list.hpp"

namespace lanescape {

PairInteraction::PairInteraction(const PairModel& model, const Box& box, const ParticleLayout& layout,
                                 const kernels::KernelTable& table, const PairSearchOptions& options)
    : box_(box),
      reduced_(model.length_unit(diameter_scale(model, layout))),
      model_(model.in_unit(reduced_.unit())),
      layout_(layout.in_unit(reduced_.unit())),
      table_(&table),
      options_(options) {
  const FloatEnvironment environment;
  check_cutoff(model, box, diameter_scale(model, layout));
  if (options.precision == Precision::mixed) check_single_precision(model, layout);
  sums_ = make_sums(reduced_.box(box));
  find_constants();
}

double PairInteraction::scale() const { return diameter_scale(model_, layout_); }

std::unique_ptr<PairSums> PairInteraction::make_sums(const Box& box) const {
  if (!wants_list(box)) {
    auto all = std::make_unique<AllPairsSums>(model_, box, layout_, *table_);
    if (!exclusions_) return all;
    return std::make_unique<ExcludingSums>(std::move(all), model_, box, layout_, *table_, exclusions_);
  }
  const int threads = useful_threads(layout_.size(), options_.threads);
  if (wants_clusters(box)) return std::make_unique<ClusterSums>(model_, box, layout_, *table_, options_.skin, threads);
  auto sums = std::make_unique<ListSums>(model_, box, layout_, *table_, options_.skin, threads, options_.precision);
  sums->set_exclusions(exclusions_);
  return sums;
}

bool PairInteraction::wants_list(const Box& box) const {
  return takes_list(model_, box, scale(), layout_.size(), options_) ||
         (exclusions_ && options_.search == PairSearch::automatic && fits_list(model_, box, options_.skin, scale()));
}

bool PairInteraction::wants_clusters(const Box& box) const {
  if (options_.precision != Precision::mixed || !wants_list(box)) return false;
  const bool can = !exclusions_ && ClusterSums::can_hold(model_, box, layout_, options_.skin);
  if (options_.search != PairSearch::clusters)
    return can && options_.search == PairSearch::automatic && layout_.size() >= ClusterSums::crossover(layout_.blocks().size());
  if (!can)
    throw_bad_input(
        "clusters of particles are not allowed with these: no exclusions and no diameters, a periodic box of twice the cutoff and "
        "the skin or more, and at most five diameters of cutoff and skin are");
  return true;
}

void PairInteraction::set_box(const Box& box) {
  const FloatEnvironment environment;
  check_cutoff(model_, box, scale() * reduced_.unit());
  const Box reduced = reduced_.box(box);
  if (wants_list(reduced) == has_list() && wants_clusters(reduced) == (clusters() != nullptr))
    sums_->set_box(model_, reduced);
  else
    sums_ = make_sums(reduced);
  box_ = box;
  find_constants();
}

PairInteraction::PairInteraction(PairInteraction&&) noexcept = default;
PairInteraction& PairInteraction::operator=(PairInteraction&&) noexcept = default;
PairInteraction::~PairInteraction() = default;

void PairInteraction::find_constants() {
  constants_ = {};
  if (model_.images == ImageRule::all) add_images_of_self();
  if (model_.truncation == Truncation::tail) add_tail();
}

void PairInteraction::add_images_of_self() {
  const auto& blocks = layout_.blocks();
  for (std::size_t s = 0; s < blocks.size(); ++s) {
    PairNumbers numbers = model_.numbers(model_.pair(s, s));
    if (!model_.form->has_diameters) {
      add_images_of_one(numbers, static_cast<double>(blocks[s].count), constants_);
      continue;
    }
    for (std::size_t slot = blocks[s].begin; slot < blocks[s].begin + blocks[s].count; ++slot) {
      numbers.sigma = layout_.diameters()[slot];
      add_images_of_one(numbers, 1.0, constants_);
    }
  }
}

void PairInteraction::add_images_of_one(const PairNumbers& numbers, double count, Evaluation& sum) const {
  const Box box = reduced_.box(box_);
  const double cutoff = model_.cutoff * numbers.sigma;
  // Half of each: the pair of a particle and its image belongs to one particle only.
  const double weight = 0.5 * count;
  const auto reach = [&](std::size_t axis) { return box.periodic[axis] ? static_cast<int>(cutoff / box.length[axis]) : 0; };
  for (int a = -reach(0); a <= reach(0); ++a)
    for (int b = -reach(1); b <= reach(1); ++b)
      for (int c = -reach(2); c <= reach(2); ++c) {
        const std::array<double, 3> d = {a * box.length[0], b * box.length[1], c * box.length[2]};
        const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if (r2 == 0.0 || !(r2 < cutoff * cutoff)) continue;
        const PairDerivatives at = model_.derivatives(numbers, std::sqrt(r2));
        sum.energy += weight * at.u;
        const double virial = -weight * at.first;
        sum.virial += virial;
        constexpr std::size_t voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
        for (std::size_t k = 0; k < 6; ++k) sum.virial_tensor[k] += virial * d[voigt[k][0]] * d[voigt[k][1]] / r2;
      }
}

void PairInteraction::add_tail() {
  const auto& blocks = layout_.blocks();
  const double volume = reduced_.box(box_).volume();
  for (std::size_t a = 0; a < blocks.size(); ++a)
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const double pairs = static_cast<double>(blocks[a].count) * static_cast<double>(blocks[b].count);
      const PairTail tail = long_range(model_, a, b, volume);
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

void PairInteraction::gradient_after(const SlotWork& move, const AlignedArray& positions, AlignedArray& gradient) {
  const FloatEnvironment environment;
  if (reduced_.unit() != 1.0) {
    for_all_slots(options_.threads, layout_.slots(), move);
    return this->gradient(positions, gradient);
  }
  sums_->gradient_after(move, positions, gradient);
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

std::unique_ptr<SegmentBound> PairInteraction::segment_bound(double longest) const {
  // Only double precision gives what the bound's rounding allows for, excluded pairs are subtracted, and the bound has all images.
  if (options_.precision == Precision::mixed || exclusions_ || box_.has_open_axis()) return nullptr;
  const FloatEnvironment environment;
  return PairSegmentBound::make(model_.in_unit(1.0 / reduced_.unit()), box_, layout_, longest);
}

void PairInteraction::pass_over(const AlignedArray& positions) {
  const FloatEnvironment environment;
  sums_->pass_over(reduced_.of(positions));
}

void PairInteraction::exchange(Archive& archive) { sums_->exchange(archive); }

void PairInteraction::set_exclusions(std::span<const std::array<std::size_t, 2>> pairs) {
  const FloatEnvironment environment;
  exclusions_ = pairs.empty() ? nullptr : std::make_shared<const Exclusions>(pairs, layout_);
  spare_.reset();
  sums_ = make_sums(reduced_.box(box_));
}

ClusterSums* PairInteraction::clusters() const { return dynamic_cast<ClusterSums*>(sums_.get()); }

bool PairInteraction::has_list() const { return list() != nullptr || clusters() != nullptr; }

std::uint64_t PairInteraction::rebuilds() const {
  if (const ClusterSums* sums = clusters()) return sums->list().rebuilds();
  return list() == nullptr ? 0 : list()->rebuilds();
}

std::size_t PairInteraction::list_memory() const {
  if (const ClusterSums* sums = clusters()) return sums->list().memory();
  return list() == nullptr ? 0 : list()->memory();
}

const NeighbourList* PairInteraction::list() const {
  const auto* sums = dynamic_cast<const ListSums*>(sums_.get());
  return sums == nullptr ? nullptr : &sums->list();
}

}  // namespace lanescape
