#include "interaction/pair/excluding_sums.hpp"

#include <array>
#include <utility>

namespace lanescape {

ExcludingSums::ExcludingSums(std::unique_ptr<PairSums> all, const PairModel& model, const Box& box, const ParticleLayout& layout,
                             const kernels::KernelTable& table, std::shared_ptr<const Exclusions> exclusions)
    : all_(std::move(all)),
      kernels_(&table.pair_kernels(model.kernel_form().kernel)),
      box_(box),
      nearest_(model, layout),
      exclusions_(std::move(exclusions)) {}

template <class Visit>
void ExcludingSums::for_each_row(const AlignedArray& positions, Visit visit) {
  for (std::size_t slot = 0; slot < exclusions_->slots(); ++slot)
    if (exclusions_->count(slot) > 0) visit(slot, nearest_.row(positions, box_, slot, exclusions_->of(slot)));
}

// The excluded sums are added up first: energies with and without gradient then have the same bits.
double ExcludingSums::energy(const AlignedArray& positions) {
  double excluded = 0.0;
  for_each_row(positions, [&](std::size_t, const kernels::PairListInput& row) { excluded += kernels_->list_energy(row); });
  return all_->energy(positions) - excluded;
}

void ExcludingSums::subtract(RowSum sum, const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) {
  kernels::PairOutput excluded{};
  for_each_row(positions, [&](std::size_t slot, const kernels::PairListInput& row) {
    alignas(kernels::array_alignment) std::array<double, kernels::point_width> own;
    kernels::PairOutput of_row{};
    sum(row, own.data(), of_row);
    for (std::size_t axis = 0; axis < 3; ++axis) gradient[axis * gradient.size() / 3 + slot] -= own[axis];
    excluded.energy += of_row.energy;
    excluded.virial += of_row.virial;
    for (std::size_t k = 0; k < 6; ++k) excluded.virial_tensor[k] += of_row.virial_tensor[k];
  });
  out.energy -= excluded.energy;
  out.virial -= excluded.virial;
  for (std::size_t k = 0; k < 6; ++k) out.virial_tensor[k] -= excluded.virial_tensor[k];
}

void ExcludingSums::gradient_only(const AlignedArray& positions, AlignedArray& gradient) {
  kernels::PairOutput unused{};
  ExcludingSums::gradient(positions, gradient, unused);
}

void ExcludingSums::gradient(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) {
  all_->gradient(positions, gradient, out);
  subtract(kernels_->list_gradient, positions, gradient, out);
}

void ExcludingSums::stress(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) {
  all_->stress(positions, gradient, out);
  subtract(kernels_->list_stress, positions, gradient, out);
}

void ExcludingSums::set_box(const PairModel& model, const Box& box) {
  box_ = box;
  all_->set_box(model, box);
}

}  // namespace lanescape
