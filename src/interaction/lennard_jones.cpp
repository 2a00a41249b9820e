#include "interaction/lennard_jones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"

namespace lanescape {
namespace {

using kernels::ImageSearch;
using kernels::LengthUnit;

// Shifts by more than this many boxes bring no image of a nearest separation (|d| <= L/2) within the cutoff.
double shells(double length, double cutoff) { return std::ceil(cutoff / length - 0.5); }

bool is_cubic(const Box& box) { return box.length[0] == box.length[1] && box.length[0] == box.length[2]; }

}  // namespace

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

void check_cutoff(const LennardJonesModel& model, const Box& box) {
  if (model.images == ImageRule::minimum) return;
  const double cutoff = model.cutoff * *std::max_element(model.sigma.begin(), model.sigma.end());
  if (shells(box.shortest(), cutoff) > max_image_shells)
    throw_bad_input(
        fmt::format("cutoff {} reaches over more than {} images of the box, whose shortest edge is {}: at most {} is allowed",
                    cutoff, max_image_shells, box.shortest(), (max_image_shells + 0.5) * box.shortest()));
}

LennardJones::LennardJones(const LennardJonesModel& model, const Box& box, const ParticleLayout& layout,
                           const kernels::KernelTable& table)
    : table_(&table), blocks_(layout.blocks()), scratch_(layout.dimension(), 0.0) {
  check_cutoff(model, box);
  const std::size_t n = model.species.size();
  bool lattice = false;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      const double sigma = model.sigma[model.pair(a, b)], epsilon = model.epsilon[model.pair(a, b)];
      const double cutoff = model.cutoff * sigma;
      const double s6 = std::pow(sigma, 6), c12 = 4.0 * epsilon * s6 * s6, c6 = 4.0 * epsilon * s6;
      const double inverse6 = std::pow(cutoff, -6);
      const double shift = model.truncation == Truncation::shifted ? (c12 * inverse6 - c6) * inverse6 : 0.0;
      pairs_.push_back({c12, c6, cutoff * cutoff, shift, image_search(box, cutoff, model.images)});
      lattice = lattice || pairs_.back().images == ImageSearch::lattice;
      if (model.images == ImageRule::all)
        for (std::size_t axis = 0; axis < 3; ++axis)
          input_.shells[axis] = std::max(input_.shells[axis], static_cast<std::int32_t>(shells(box.length[axis], cutoff)));
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
  if (model.images == ImageRule::all) add_images_of_self(model, box);
  if (model.truncation == Truncation::tail) add_tail(model, box);
}

void LennardJones::add_images_of_self(const LennardJonesModel& model, const Box& box) {
  for (std::size_t s = 0; s < blocks_.size(); ++s) {
    const double sigma = model.sigma[model.pair(s, s)], epsilon = model.epsilon[model.pair(s, s)];
    const double cutoff = model.cutoff * sigma, s6 = std::pow(sigma, 6);
    const double at_cutoff = std::pow(sigma / cutoff, 6);
    const double shift = model.truncation == Truncation::shifted ? 4.0 * epsilon * at_cutoff * (at_cutoff - 1.0) : 0.0;
    const auto reach = [&](std::size_t axis) { return static_cast<int>(cutoff / box.length[axis]); };
    for (int a = -reach(0); a <= reach(0); ++a)
      for (int b = -reach(1); b <= reach(1); ++b)
        for (int c = -reach(2); c <= reach(2); ++c) {
          const std::array<double, 3> d = {a * box.length[0], b * box.length[1], c * box.length[2]};
          const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
          if (r2 == 0.0 || !(r2 < cutoff * cutoff)) continue;
          const double sixth = s6 / (r2 * r2 * r2);
          // Half of each: the pair of a particle and its image belongs to one particle only.
          const double weight = 0.5 * static_cast<double>(blocks_[s].count);
          const double virial = weight * 24.0 * epsilon * (2.0 * sixth - 1.0) * sixth;
          constants_.energy += weight * (4.0 * epsilon * (sixth - 1.0) * sixth - shift);
          constants_.virial += virial;
          constexpr std::size_t voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
          for (std::size_t k = 0; k < 6; ++k) constants_.virial_tensor[k] += virial * d[voigt[k][0]] * d[voigt[k][1]] / r2;
        }
  }
}

void LennardJones::add_tail(const LennardJonesModel& model, const Box& box) {
  // Sum over pairs of species of 2 pi N_a N_b / V times the integrals beyond r_c of r^2 u(r) and of -r^3 u'(r).
  for (std::size_t a = 0; a < blocks_.size(); ++a)
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const double sigma = model.sigma[model.pair(a, b)], x3 = std::pow(model.cutoff, -3), x9 = x3 * x3 * x3;
      const double pairs = static_cast<double>(blocks_[a].count) * static_cast<double>(blocks_[b].count);
      const double scale = 8.0 * std::numbers::pi * pairs / box.volume() * model.epsilon[model.pair(a, b)] * sigma * sigma * sigma;
      const double virial = scale * (12.0 * x9 / 9.0 - 6.0 * x3 / 3.0);
      constants_.energy += scale * (x9 / 9.0 - x3 / 3.0);
      constants_.virial += virial;
      for (std::size_t k = 0; k < 3; ++k) constants_.virial_tensor[k] += virial / 3.0;
    }
}

kernels::LjInput LennardJones::input(const AlignedArray& positions) {
  // The pointers are set at each call so that a LennardJones may be moved.
  kernels::LjInput in = input_;
  in.positions = positions.data();
  in.scratch = scratch_.data();
  in.blocks = blocks_.data();
  in.pairs = pairs_.data();
  return in;
}

LennardJones::Evaluation LennardJones::with_constants(const kernels::LjOutput& out) const {
  Evaluation e = constants_;
  e.energy += out.energy;
  e.virial += out.virial;
  return e;
}

double LennardJones::energy(const AlignedArray& positions) { return table_->lj_energy(input(positions)) + constants_.energy; }

LennardJones::Evaluation LennardJones::energy_and_gradient(const AlignedArray& positions, AlignedArray& gradient) {
  kernels::LjOutput out;
  table_->lj_gradient(input(positions), gradient.data(), out);
  return with_constants(out);
}

LennardJones::Evaluation LennardJones::energy_and_stress(const AlignedArray& positions, AlignedArray& gradient) {
  kernels::LjOutput out;
  table_->lj_stress(input(positions), gradient.data(), out);
  Evaluation e = with_constants(out);
  for (std::size_t k = 0; k < 6; ++k) e.virial_tensor[k] += out.virial_tensor[k];
  return e;
}

}  // namespace lanescape
