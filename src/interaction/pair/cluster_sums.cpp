#include "interaction/pair/cluster_sums.hpp"

#include <algorithm>
#include <cmath>

#include "interaction/pair/pair_parameters.hpp"
#include "neighbour/closed_gaps.hpp"

namespace lanescape {
namespace {

std::vector<double> cutoffs(const PairModel& model) {
  std::vector<double> cutoffs;
  for (std::size_t ab = 0; ab < model.sigma.size(); ++ab) cutoffs.push_back(model.cutoff_of(ab));
  return cutoffs;
}

}  // namespace

bool ClusterSums::can_hold(const PairModel& model, const Box& box, const ParticleLayout& layout, double skin) {
  // Coordinates are rounded to 2^-30 of eight to sixteen reaches: at this limit to half of what single precision loses anyway.
  constexpr double most_reach_per_size = 5.0;
  if (model.form->has_diameters || layout.size() == 0 || box.has_open_axis()) return false;
  const double reach = model.largest_cutoff() + ClusterList::outer_skin(skin);
  return reach <= most_reach_per_size * *std::min_element(model.sigma.begin(), model.sigma.end()) &&
         2.0 * reach <= box.shortest() && !is_sparse(box, layout.size(), reach);
}

ClusterSums::ClusterSums(const PairModel& model, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table,
                         double skin, int threads)
    : model_(model),
      box_(box),
      layout_(layout),
      table_(&table),
      skin_(skin),
      threads_(threads),
      kernels_(&table.pair_kernels(model.kernel_form().kernel)),
      list_(box, layout, cutoffs(model), ClusterList::outer_skin(skin), table, threads),
      pairs_(pair_parameters(model)),
      single_pairs_(single_pair_parameters(pairs_, list_.fixed_unit())),
      padding_(slots_without_particle(layout)) {}

kernels::ClusterInput ClusterSums::input(const kernels::ClusterLists& lists, std::size_t pair) const {
  const ClusterBlocks::SpeciesPair& species = list_.species_pairs()[pair];
  const std::size_t ab = species.rows * layout_.blocks().size() + species.neighbours;
  return {lists, list_.fixed_unit(), &pairs_[ab], &single_pairs_[ab]};
}

template <class Evaluate>
void ClusterSums::for_each_block(const AlignedArray& positions, Evaluate evaluate, const SlotWork& move) {
  list_.update(positions, move);
  const std::size_t pairs = list_.species_pairs().size();
  sums_.assign(list_.block_count() * pairs, {});
  list_.for_each_block([&](std::size_t block, std::size_t pair, const kernels::ClusterLists& lists, float* gradients) {
    evaluate(input(lists, pair), gradients, sums_[block * pairs + pair]);
  });
}

// Block after block, whoever summed them.
kernels::PairOutput ClusterSums::total() const {
  kernels::PairOutput total{};
  for (const kernels::PairOutput& sum : sums_) {
    total.energy += sum.energy;
    total.virial += sum.virial;
  }
  return total;
}

void ClusterSums::put_gradients(AlignedArray& gradient) {
  list_.put_gradients(list_.fixed_unit(), gradient);
  clear_slots(padding_, gradient);
}

double ClusterSums::energy(const AlignedArray& positions) {
  for_each_block(positions, [&](const kernels::ClusterInput& in, float*, kernels::PairOutput& sum) {
    sum.energy = kernels_->cluster_energy(in);
  });
  return total().energy;
}

void ClusterSums::gradient_only(const AlignedArray& positions, AlignedArray& gradient) { gradient_after({}, positions, gradient); }

void ClusterSums::gradient_after(const SlotWork& move, const AlignedArray& positions, AlignedArray& gradient) {
  const auto evaluate = [&](const kernels::ClusterInput& in, float* gradients, kernels::PairOutput&) {
    kernels_->cluster_force(in, gradients);
  };
  for_each_block(positions, evaluate, move);
  put_gradients(gradient);
}

void ClusterSums::gradient(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) {
  for_each_block(positions, [&](const kernels::ClusterInput& in, float* gradients, kernels::PairOutput& sum) {
    kernels_->cluster_gradient(in, gradients, sum);
  });
  put_gradients(gradient);
  out = total();
}

void ClusterSums::stress(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) {
  rows().stress(positions, gradient, out);
}

ListSums& ClusterSums::rows() {
  if (!rows_) rows_ = std::make_unique<ListSums>(model_, box_, layout_, *table_, skin_, threads_, Precision::mixed);
  return *rows_;
}

void ClusterSums::set_box(const PairModel& model, const Box& box) {
  box_ = box;
  list_.set_box(box);
  if (rows_) rows_->set_box(model, box);
}

void ClusterSums::exchange(Archive& archive) {
  list_.exchange(archive);
  // Whether or not a run was interrupted here, its next stress makes a new list of neighbours.
  rows_.reset();
}

}  // namespace lanescape
