#include "interaction/pair/host_list_sums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "core/padded.hpp"
#include "core/parallel.hpp"
#include "interaction/pair/pair_parameters.hpp"

namespace lanescape {

void check_without_box(const PairModel& model) {
  if (model.form->has_diameters)
    throw_bad_input(fmt::format("model {} has diameters of particles: potentials without a box do not know them", model.name));
  if (model.truncation == Truncation::tail)
    throw_bad_input(
        fmt::format("model {} has truncation tail: without a box use plain, the host adds what the volume gives", model.name));
}

HostListSums::HostListSums(const PairModel& model, const kernels::KernelTable& table, Lists lists, int threads)
    : kernels_(&table.pair_kernels(model.kernel_form().kernel)),
      lists_(lists),
      threads_(threads),
      pairs_(pair_parameters(model)),
      species_(model.species.size()) {
  check_without_box(model);
  if (species_ > HostRows::most_species)
    throw_bad_input(
        fmt::format("{} species are not allowed over lists of a host: at most {} are", species_, HostRows::most_species));
  using enum HostRows::Ends;
  using enum HostRows::Partners;
  switch (lists) {
    case Lists::rows:
      parts_.push_back({HostRows(species_, listing, all), 1.0});
      break;
    case Lists::gradient:
      parts_.push_back({HostRows(species_, listing, with_list), 1.0});
      parts_.push_back({HostRows(species_, both, HostRows::Partners::ghosts), 0.5});
      break;
    case Lists::half:
      parts_.push_back({HostRows(species_, both, all), 1.0});
      break;
  }
}

void HostListSums::set_lists(const HostLists& lists) {
  size_ = 0;
  check_lists(lists, threads_);
  for (Part& part : parts_) part.rows.assign(lists, threads_);
  size_ = lists.species.size();
  points_.assign(kernels::point_width * size_, 0.0);
  std::vector<bool> has_list(size_, lists_ == Lists::half);
  for (const int row : lists.rows) has_list[static_cast<std::size_t>(row)] = true;
  ghosts_.clear();
  for (std::size_t k = 0; k < size_; ++k)
    if (!has_list[k]) ghosts_.push_back(static_cast<int>(k));
}

kernels::PairListInput HostListSums::input(const Part& part, std::size_t block) const {
  return {part.rows.rows_of(block, points_.data()), pairs_.data() + part.rows.species_of(block) * species_, nullptr};
}

double HostListSums::energy() {
  const FloatEnvironment environment;
  double energy = 0.0;
  for (const Part& part : parts_) {
    sums_.resize(part.rows.block_count());
    for_each_block(threads_, part.rows.block_count(),
                   [&](std::size_t b) { sums_[b].energy = kernels_->list_energy(input(part, b)); });
    double sum = 0.0;
    for (const kernels::PairOutput& of_block : sums_) sum += of_block.energy;
    energy += part.weight * sum;
  }
  return energy;
}

template <class Sum>
kernels::PairOutput HostListSums::sum_gradient(AlignedArray& gradient, const Sum& sum) {
  const FloatEnvironment environment;
  gradient.assign(points_.size(), 0.0);
  kernels::PairOutput total{};
  for (const Part& part : parts_) {
    sums_.assign(part.rows.block_count(), {});
    for_each_block(threads_, part.rows.block_count(), [&](std::size_t b) {
      alignas(kernels::array_alignment) std::array<double, kernels::point_width * HostRows::block_rows> records;
      const kernels::PairListInput in = input(part, b);
      sum(in, records.data(), sums_[b]);
      for (std::size_t k = 0; k < in.list.row_count; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
          gradient[in.list.rows[k] + axis] += part.weight * records[kernels::point_width * k + axis];
    });
    for (const kernels::PairOutput& of_block : sums_) {
      total.energy += part.weight * of_block.energy;
      total.virial += part.weight * of_block.virial;
      for (std::size_t k = 0; k < 6; ++k) total.virial_tensor[k] += part.weight * of_block.virial_tensor[k];
    }
  }
  return total;
}

void HostListSums::gradient(AlignedArray& gradient) {
  sum_gradient(gradient, [&](const auto& in, double* records, kernels::PairOutput&) { kernels_->list_force(in, records); });
}

kernels::PairOutput HostListSums::energy_and_gradient(AlignedArray& gradient) {
  return sum_gradient(gradient, kernels_->list_gradient);
}

kernels::PairOutput HostListSums::energy_and_stress(AlignedArray& gradient) {
  return sum_gradient(gradient, kernels_->list_stress);
}

void HostListSums::energies(AlignedArray& energies) {
  const FloatEnvironment environment;
  energies.assign(size_, 0.0);
  for (const Part& part : parts_)
    for_each_block(threads_, part.rows.block_count(), [&](std::size_t b) {
      kernels::PairListInput in = input(part, b);
      const std::size_t rows = in.list.row_count;
      in.list.row_count = 1;
      for (std::size_t k = 0; k < rows; ++k) {
        energies[*in.list.rows / kernels::point_width] += kernels_->list_energy(in);
        ++in.list.rows;
        for (std::size_t s = 0; s < in.list.species_count; ++s) in.list.neighbours += padded(*in.list.lengths++);
      }
    });
  for (const int ghost : ghosts_) energies[static_cast<std::size_t>(ghost)] = 0.0;
}

}  // namespace lanescape
