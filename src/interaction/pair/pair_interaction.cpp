#include "interaction/pair/pair_interaction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "interaction/pair/pair_sums.hpp"
#include "neighbour/neighbour_list.hpp"

namespace lanescape {

using kernels::ImageSearch;

double image_shells(double length, double cutoff) { return std::ceil(cutoff / length - 0.5); }

ImageSearch image_search(const Box& box, double cutoff, ImageRule rule) {
  if (rule == ImageRule::minimum || 2.0 * cutoff <= box.shortest()) return ImageSearch::nearest;
  double least_edge_diagonal = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 3; ++a) {
    const double la = box.length[static_cast<std::size_t>(a)], lb = box.length[static_cast<std::size_t>((a + 1) % 3)];
    least_edge_diagonal = std::min(least_edge_diagonal, la * la + lb * lb);
  }
  const bool one_more_at_most = cutoff <= box.shortest() && 4.0 * cutoff * cutoff <= least_edge_diagonal;
  return one_more_at_most ? ImageSearch::two_nearest : ImageSearch::lattice;
}

void check_cutoff(const PairModel& model, const Box& box) {
  if (model.images == ImageRule::minimum) return;
  const double cutoff = model.largest_cutoff();
  if (image_shells(box.shortest(), cutoff) > max_image_shells)
    throw_bad_input(
        fmt::format("cutoff {} reaches over more than {} images of the box, whose shortest edge is {}: at most {} is allowed",
                    cutoff, max_image_shells, box.shortest(), (max_image_shells + 0.5) * box.shortest()));
}

PairTail long_range(const PairModel& model, std::size_t a, std::size_t b, double volume) {
  PairNumbers numbers = model.numbers(model.pair(a, b));
  numbers.epsilon *= 2.0 * std::numbers::pi / volume;  // the integrals are proportional to it
  return model.form->tail(numbers, model.cutoff);
}

const char* to_string(Precision precision) { return precision == Precision::mixed ? "mixed" : "double"; }

Precision parse_precision(std::string_view word) {
  for (const Precision precision : {Precision::double_precision, Precision::mixed})
    if (word == to_string(precision)) return precision;
  throw_bad_input(fmt::format("precision '{}' is not allowed: double or mixed", word));
}

bool fits_list(const PairModel& model, const Box& box, double skin) {
  if (model.images == ImageRule::all) return true;
  const double cutoff = model.largest_cutoff();
  return 2.0 * (cutoff + skin) <= box.shortest();
}

namespace {

void check_list(const PairModel& model, const Box& box, Precision precision, double skin) {
  if (fits_list(model, box, skin)) return;
  throw_bad_input(
      fmt::format("the minimum-image rule has no neighbour list{} in a box of shortest edge {}: at least twice the "
                  "cutoff and the skin is needed",
                  precision == Precision::mixed ? ", which mixed precision needs," : "", box.shortest()));
}

bool takes_list(const PairModel& model, const Box& box, std::size_t particles, const PairSearchOptions& options) {
  if (options.precision == Precision::mixed && options.search == PairSearch::all_pairs)
    throw_bad_input("mixed precision needs a neighbour list: over all pairs there is double precision only");
  switch (options.search) {
    case PairSearch::all_pairs:
      return false;
    case PairSearch::list:
      check_list(model, box, options.precision, options.skin);
      return true;
    case PairSearch::automatic:
      break;
  }
  if (options.precision == Precision::mixed) {
    check_list(model, box, options.precision, options.skin);
    return true;
  }
  return particles >= list_crossover && fits_list(model, box, options.skin);
}

}  // namespace

void check_precision(const PairModel& model, const Box& box, Precision precision, double skin) {
  if (precision == Precision::mixed) check_list(model, box, precision, skin);
}

PairInteraction::PairInteraction(const PairModel& model, const Box& box, const ParticleLayout& layout,
                                 const kernels::KernelTable& table, const PairSearchOptions& options)
    : blocks_(layout.blocks()) {
  check_cutoff(model, box);
  if (takes_list(model, box, layout.size(), options))
    sums_ = std::make_unique<ListSums>(model, box, layout, table, options.skin, useful_threads(layout.size(), options.threads),
                                       options.precision);
  else
    sums_ = std::make_unique<AllPairsSums>(model, box, layout, table);
  if (model.images == ImageRule::all) add_images_of_self(model, box);
  if (model.truncation == Truncation::tail) add_tail(model, box);
}

PairInteraction::PairInteraction(PairInteraction&&) noexcept = default;
PairInteraction& PairInteraction::operator=(PairInteraction&&) noexcept = default;
PairInteraction::~PairInteraction() = default;

void PairInteraction::add_images_of_self(const PairModel& model, const Box& box) {
  for (std::size_t s = 0; s < blocks_.size(); ++s) {
    const std::size_t pair = model.pair(s, s);
    const double cutoff = model.cutoff_of(pair);
    // Half of each: the pair of a particle and its image belongs to one particle only.
    const double weight = 0.5 * static_cast<double>(blocks_[s].count);
    const auto reach = [&](std::size_t axis) { return static_cast<int>(cutoff / box.length[axis]); };
    for (int a = -reach(0); a <= reach(0); ++a)
      for (int b = -reach(1); b <= reach(1); ++b)
        for (int c = -reach(2); c <= reach(2); ++c) {
          const std::array<double, 3> d = {a * box.length[0], b * box.length[1], c * box.length[2]};
          const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
          if (r2 == 0.0 || !(r2 < cutoff * cutoff)) continue;
          const PairDerivatives at = model.derivatives(pair, std::sqrt(r2));
          constants_.energy += weight * at.u;
          const double virial = -weight * at.first;
          constants_.virial += virial;
          constexpr std::size_t voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
          for (std::size_t k = 0; k < 6; ++k) constants_.virial_tensor[k] += virial * d[voigt[k][0]] * d[voigt[k][1]] / r2;
        }
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

double PairInteraction::energy(const AlignedArray& positions) { return sums_->energy(positions) + constants_.energy; }

void PairInteraction::gradient(const AlignedArray& positions, AlignedArray& gradient) { sums_->gradient_only(positions, gradient); }

PairInteraction::Evaluation PairInteraction::energy_and_gradient(const AlignedArray& positions, AlignedArray& gradient) {
  kernels::PairOutput out;
  sums_->gradient(positions, gradient, out);
  return with_constants(out);
}

PairInteraction::Evaluation PairInteraction::energy_and_stress(const AlignedArray& positions, AlignedArray& gradient) {
  kernels::PairOutput out;
  sums_->stress(positions, gradient, out);
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
