#include <array>
#include <cmath>

#include "core/padded.hpp"
#include "core/parallel.hpp"
#include "interaction/pair/pair_parameters.hpp"
#include "interaction/pair/pair_sums.hpp"

namespace lanescape {
namespace {

std::vector<double> cutoffs(const std::vector<kernels::PairParameters>& pairs, double scale) {
  std::vector<double> cutoffs;
  for (const auto& pair : pairs) cutoffs.push_back(scale * std::sqrt(pair.cutoff_squared));
  return cutoffs;
}

}  // namespace

std::vector<std::size_t> slots_without_particle(const ParticleLayout& layout) {
  std::vector<std::size_t> slots;
  for (std::size_t b = 0; b < layout.blocks().size(); ++b) {
    const std::size_t end = b + 1 < layout.blocks().size() ? layout.blocks()[b + 1].begin : layout.slots();
    for (std::size_t slot = layout.blocks()[b].begin + layout.blocks()[b].count; slot < end; ++slot) slots.push_back(slot);
  }
  return slots;
}

void clear_slots(const std::vector<std::size_t>& slots, AlignedArray& gradient) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const std::size_t slot : slots) gradient[axis * gradient.size() / 3 + slot] = 0.0;
}

ListSums::ListSums(const PairModel& model, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table,
                   double skin, int threads, Precision precision)
    : kernels_(&table.pair_kernels(model.kernel_form().kernel)),
      precision_(precision),
      pairs_(pair_parameters(model)),
      list_(box, layout, cutoffs(pairs_, diameter_scale(model, layout)), skin, table, threads,
            precision == Precision::mixed ? NeighbourList::Coordinates::floating_and_fixed : NeighbourList::Coordinates::floating) {
  sums_.resize(list_.block_count());
  if (precision == Precision::mixed) single_pairs_ = single_pair_parameters(pairs_, list_.fixed_unit());
  if (model.form->has_diameters) diameters_ = layout.diameters();
  padding_ = slots_without_particle(layout);
}

template <class Evaluate>
void ListSums::for_each_block(const AlignedArray& positions, Evaluate evaluate, const SlotWork& move) {
  list_.update(positions, move);
  if (diameters_.size() > 0 && diameters_at_ != list_.rebuilds()) {
    list_.set_values(diameters_, 1);
    diameters_at_ = list_.rebuilds();
  }
  const std::size_t species = list_.species();
  lanescape::for_each_block(list_.threads(), list_.parts(), [&](std::size_t part) {
    alignas(kernels::array_alignment) std::array<double, kernels::point_width * NeighbourList::block_rows> records;
    for (std::size_t b = list_.first_block(part); b < list_.first_block(part + 1); ++b)
      evaluate(b,
               kernels::PairListInput{list_.rows_of(b), pairs_.data() + list_.species_of(b) * species,
                                      single_pairs_.empty() ? nullptr : single_pairs_.data() + list_.species_of(b) * species},
               records.data());
  });
}

void ListSums::put_gradient(std::size_t block, const double* records, AlignedArray& gradient) const {
  const std::size_t slots = gradient.size() / 3;
  const kernels::NeighbourRows rows = list_.rows_of(block);
  for (std::size_t k = 0; k < rows.row_count; ++k) {
    double* g = gradient.data() + list_.slot_at(rows.rows[k]);
    g[0] = records[kernels::point_width * k];
    g[slots] = records[kernels::point_width * k + 1];
    g[2 * slots] = records[kernels::point_width * k + 2];
  }
}

// Block after block, whoever summed them.
kernels::PairOutput ListSums::total() const {
  kernels::PairOutput total{};
  for (const kernels::PairOutput& sum : sums_) {
    total.energy += sum.energy;
    total.virial += sum.virial;
    for (std::size_t k = 0; k < 6; ++k) total.virial_tensor[k] += sum.virial_tensor[k];
  }
  return total;
}

double ListSums::energy(const AlignedArray& positions) {
  const auto sum = precision_ == Precision::mixed ? kernels_->list_energy_mixed : kernels_->list_energy;
  for_each_block(positions, [&](std::size_t b, const kernels::PairListInput& in, double*) { sums_[b].energy = sum(in); });
  double energy = 0.0;  // block after block, as in total()
  for (const kernels::PairOutput& of_block : sums_) energy += of_block.energy;
  return energy;
}

void ListSums::energies(const AlignedArray& positions, AlignedArray& energies) {
  const auto sum = precision_ == Precision::mixed ? kernels_->list_energy_mixed : kernels_->list_energy;
  for_each_block(positions, [&](std::size_t, kernels::PairListInput in, double*) {
    const std::size_t rows = in.list.row_count;
    in.list.row_count = 1;
    for (std::size_t k = 0; k < rows; ++k) {
      energies[list_.slot_at(*in.list.rows)] = sum(in);
      ++in.list.rows;
      for (std::size_t s = 0; s < in.list.species_count; ++s) in.list.neighbours += padded(*in.list.lengths++);
    }
  });
}

void ListSums::gradient_only(const AlignedArray& positions, AlignedArray& gradient) { gradient_after({}, positions, gradient); }

void ListSums::gradient_after(const SlotWork& move, const AlignedArray& positions, AlignedArray& gradient) {
  const auto sum = precision_ == Precision::mixed ? kernels_->list_force_mixed : kernels_->list_force;
  const auto evaluate = [&](std::size_t b, const kernels::PairListInput& in, double* records) {
    sum(in, records);
    put_gradient(b, records, gradient);
  };
  for_each_block(positions, evaluate, move);
  clear_slots(padding_, gradient);
}

void ListSums::gradient(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) {
  std::fill(sums_.begin(), sums_.end(), kernels::PairOutput{});  // a stress may have been summed before
  const auto sum = precision_ == Precision::mixed ? kernels_->list_gradient_mixed : kernels_->list_gradient;
  for_each_block(positions, [&](std::size_t b, const kernels::PairListInput& in, double* records) {
    sum(in, records, sums_[b]);
    put_gradient(b, records, gradient);
  });
  clear_slots(padding_, gradient);
  out = total();
}

void ListSums::stress(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) {
  for_each_block(positions, [&](std::size_t b, const kernels::PairListInput& in, double* records) {
    kernels_->list_stress(in, records, sums_[b]);
    put_gradient(b, records, gradient);
  });
  clear_slots(padding_, gradient);
  out = total();
}

}  // namespace lanescape
