#include <algorithm>
#include <cmath>

#include "core/coordinate_checks.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/pair/pair_parameters.hpp"
#include "interaction/pair/pair_sums.hpp"

namespace lanescape {
namespace {

using kernels::ImageSearch;
using kernels::LengthUnit;

bool is_cubic(const Box& box) { return box.length[0] == box.length[1] && box.length[0] == box.length[2]; }
// In units of a larger box, sigma^12 and its inverse would leave the range of numbers.
constexpr double largest_box_unit = 1e6;

}  // namespace

AllPairsSums::AllPairsSums(const PairModel& model, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table)
    : kernels_(&table.pair_kernels(model.kernel_form().kernel)),
      blocks_(layout.blocks()),
      scratch_(layout.dimension(), 0.0),
      scale_(diameter_scale(model, layout)) {
  if (model.form->has_diameters) given_diameters_ = layout.diameters();
  input_.slots = layout.slots();
  input_.block_count = blocks_.size();
  set_box(model, box);
}

bool AllPairsSums::find_images(const PairModel& model, const Box& box) {
  images_.clear();
  for (std::int32_t& shells : input_.shells) shells = 0;
  for (std::size_t k = 0; k < model.sigma.size(); ++k) {
    const double cutoff = scale_ * model.cutoff_of(k);
    images_.push_back(image_search(box, cutoff, model.images));
    if (model.images == ImageRule::all)
      for (std::size_t axis = 0; axis < 3; ++axis)
        input_.shells[axis] = std::max(input_.shells[axis], static_cast<std::int32_t>(image_shells(box.length[axis], cutoff)));
  }
  return std::find(images_.begin(), images_.end(), ImageSearch::lattice) != images_.end();
}

void AllPairsSums::set_box(const PairModel& model, const Box& box) {
  const bool lattice = find_images(model, box);
  input_.unit = kernels_->in_box_units && is_cubic(box) && box.length[0] <= largest_box_unit && !lattice ? LengthUnit::box
                                                                                                         : LengthUnit::sigma;
  const double unit = input_.unit == LengthUnit::box ? box.length[0] : 1.0;
  put_pair_parameters(model, unit, pairs_);
  diameters_ = given_diameters_;
  for (double& diameter : diameters_) diameter /= unit;
  for (std::size_t k = 0; k < images_.size(); ++k) pairs_[k].images = images_[k];
  for (std::size_t axis = 0; axis < 3; ++axis) input_.box[axis] = box.length[axis];
}

kernels::PairInput AllPairsSums::input(const AlignedArray& positions) {
  // The pointers are set at each call so that an AllPairsSums may be moved.
  kernels::PairInput in = input_;
  in.positions = positions.data();
  in.scratch = scratch_.data();
  in.blocks = blocks_.data();
  in.pairs = pairs_.data();
  in.diameters = diameters_.size() == 0 ? nullptr : diameters_.data();
  return in;
}

namespace {

// A position that is not finite makes the energy NaN; overlapping particles may do so too.
double checked(double energy, const AlignedArray& positions) {
  if (std::isnan(energy)) check_finite(positions);
  return energy;
}

}  // namespace

double AllPairsSums::energy(const AlignedArray& positions) { return checked(kernels_->energy(input(positions)), positions); }

void AllPairsSums::gradient_only(const AlignedArray& positions, AlignedArray& gradient) {
  kernels::PairOutput out;
  AllPairsSums::gradient(positions, gradient, out);
}

void AllPairsSums::gradient(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) {
  kernels_->gradient(input(positions), gradient.data(), out);
  checked(out.energy, positions);
}

void AllPairsSums::stress(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) {
  kernels_->stress(input(positions), gradient.data(), out);
  checked(out.energy, positions);
}

}  // namespace lanescape
