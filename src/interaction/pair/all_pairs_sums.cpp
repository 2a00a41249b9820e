#include <algorithm>
#include <cmath>

#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/pair_parameters.hpp"
#include "interaction/pair/pair_sums.hpp"

namespace lanescape {
namespace {

using kernels::ImageSearch;
using kernels::LengthUnit;

bool is_cubic(const Box& box) { return box.length[0] == box.length[1] && box.length[0] == box.length[2]; }

}  // namespace

std::vector<kernels::LjPair> pair_parameters(const PairModel& model) {
  std::vector<kernels::LjPair> pairs;
  for (std::size_t k = 0; k < model.sigma.size(); ++k) {
    const double sigma = model.sigma[k], epsilon = model.epsilon[k], cutoff = model.cutoff * sigma;
    const double s6 = std::pow(sigma, 6), c12 = 4.0 * epsilon * s6 * s6, c6 = 4.0 * epsilon * s6;
    const double inverse6 = std::pow(cutoff, -6);
    const double shift = model.truncation == Truncation::shifted ? (c12 * inverse6 - c6) * inverse6 : 0.0;
    pairs.push_back({c12, c6, cutoff * cutoff, shift, ImageSearch::nearest});
  }
  return pairs;
}

AllPairsSums::AllPairsSums(const PairModel& model, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table)
    : table_(&table), blocks_(layout.blocks()), pairs_(pair_parameters(model)), scratch_(layout.dimension(), 0.0) {
  bool lattice = false;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const double cutoff = model.cutoff * model.sigma[k];
    pairs_[k].images = image_search(box, cutoff, model.images);
    lattice = lattice || pairs_[k].images == ImageSearch::lattice;
    if (model.images == ImageRule::all)
      for (std::size_t axis = 0; axis < 3; ++axis)
        input_.shells[axis] = std::max(input_.shells[axis], static_cast<std::int32_t>(image_shells(box.length[axis], cutoff)));
  }
  input_.unit = is_cubic(box) && !lattice ? LengthUnit::box : LengthUnit::sigma;
  if (input_.unit == LengthUnit::box)
    for (auto& pair : pairs_) {
      pair.c12 *= std::pow(box.length[0], -12);
      pair.c6 *= std::pow(box.length[0], -6);
      pair.cutoff_squared /= box.length[0] * box.length[0];
    }
  for (std::size_t axis = 0; axis < 3; ++axis) input_.box[axis] = box.length[axis];
  input_.slots = layout.slots();
  input_.block_count = blocks_.size();
}

kernels::LjInput AllPairsSums::input(const AlignedArray& positions) {
  // The pointers are set at each call so that an AllPairsSums may be moved.
  kernels::LjInput in = input_;
  in.positions = positions.data();
  in.scratch = scratch_.data();
  in.blocks = blocks_.data();
  in.pairs = pairs_.data();
  return in;
}

double AllPairsSums::energy(const AlignedArray& positions) { return table_->lj_energy(input(positions)); }

void AllPairsSums::gradient_only(const AlignedArray& positions, AlignedArray& gradient) {
  kernels::PairOutput out;
  table_->lj_gradient(input(positions), gradient.data(), out);
}

void AllPairsSums::gradient(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) {
  table_->lj_gradient(input(positions), gradient.data(), out);
}

void AllPairsSums::stress(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) {
  table_->lj_stress(input(positions), gradient.data(), out);
}

}  // namespace lanescape
