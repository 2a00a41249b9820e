#include <algorithm>

#include "core/float_environment.hpp"
#include "interaction/pair/cluster_sums.hpp"
#include "interaction/pair/nearest_rows.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/pair_parameters.hpp"
#include "interaction/pair/pair_sums.hpp"

// Energies per particle.
namespace lanescape {
namespace {

// A list that is made at each call needs a skin only against rounding at the cutoff [reduced unit of length].
constexpr double spare_skin = 1e-3;

}  // namespace

void PairInteraction::energies(const AlignedArray& positions, AlignedArray& energies) {
  const FloatEnvironment environment;
  const AlignedArray& reduced = reduced_.of(positions);
  std::fill(energies.begin(), energies.end(), 0.0);
  if (auto* sums = dynamic_cast<ListSums*>(sums_.get()))
    sums->energies(reduced, energies);
  else if (clusters() != nullptr)
    clusters()->rows().energies(reduced, energies);
  else
    energies_without_list(reduced, energies);
  add_constants(energies);
}

void PairInteraction::energies_without_list(const AlignedArray& reduced, AlignedArray& energies) {
  const Box box = reduced_.box(box_);
  if (fits_list(model_, box, spare_skin, scale())) {
    if (!spare_) {
      spare_ = std::make_unique<ListSums>(model_, box, layout_, *table_, spare_skin, 1, Precision::double_precision);
      spare_->set_exclusions(exclusions_);
    }
    spare_->set_box(model_, box);
    spare_->list().forget();
    return spare_->energies(reduced, energies);
  }
  if (!nearest_) nearest_ = std::make_unique<NearestRows>(model_, layout_);
  const kernels::PairKernels& kernels = table_->pair_kernels(model_.kernel_form().kernel);
  for (std::size_t i = 0; i < layout_.size(); ++i) {
    others_.clear();
    const auto slot = layout_.slot_of(i);
    const auto excluded = exclusions_ ? exclusions_->of(slot) : std::span<const std::uint32_t>{};
    for (const auto& block : layout_.blocks())
      for (std::size_t other = block.begin; other < block.begin + block.count; ++other)
        if (other != slot && !std::binary_search(excluded.begin(), excluded.end(), other))
          others_.push_back(static_cast<std::uint32_t>(other));
    energies[slot] = kernels.list_energy(nearest_->row(reduced, box, slot, others_));
  }
}

void PairInteraction::add_constants(AlignedArray& energies) const {
  const auto& blocks = layout_.blocks();
  const double volume = reduced_.box(box_).volume();
  for (std::size_t s = 0; s < blocks.size(); ++s) {
    PairNumbers numbers = model_.numbers(model_.pair(s, s));
    double tail = 0.0;
    if (model_.truncation == Truncation::tail)
      for (std::size_t b = 0; b < blocks.size(); ++b)
        tail += static_cast<double>(blocks[b].count) * long_range(model_, s, b, volume).energy;
    Evaluation own;
    for (std::size_t slot = blocks[s].begin; slot < blocks[s].begin + blocks[s].count; ++slot) {
      if (model_.images == ImageRule::all && (model_.form->has_diameters || slot == blocks[s].begin)) {
        own = {};
        if (model_.form->has_diameters) numbers.sigma = layout_.diameters()[slot];
        add_images_of_one(numbers, 1.0, own);
      }
      energies[slot] += own.energy + tail;
    }
  }
}

}  // namespace lanescape
