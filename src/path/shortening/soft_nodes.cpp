#include "path/shortening/soft_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "path/segment_energies.hpp"

namespace lanescape {
namespace {

constexpr int most_corrections = 60;
// Of all landscapes of a path together: half a gigabyte of lists.
constexpr std::size_t most_listed_particles = 1'000'000;

}  // namespace

SoftNodes::SoftNodes(const SoftLandscapeMaker& make_landscape, std::size_t nodes, int threads)
    : blocks_(nodes, threads), scratch_(NodeBlocks::count) {
  landscapes_.push_back(make_landscape());
  const SoftLandscape& first = *landscapes_.front();
  has_one_per_node_ = first.has_history() && nodes * first.particles() <= most_listed_particles;
  while (landscapes_.size() < (has_one_per_node_ ? nodes : NodeBlocks::count)) landscapes_.push_back(make_landscape());
  for (Block& block : scratch_) {
    block.position.assign(first.dimension(), 0.0);
    block.gradient = block.position;
  }
}

std::uint64_t SoftNodes::evaluations() const {
  std::uint64_t sum = 0;
  for (const Block& block : scratch_) sum += block.evaluations;
  return sum;
}

void SoftNodes::evaluate_node(Field& field, std::size_t k, std::size_t block) {
  AlignedArray& normal = field.normals[k];
  ++scratch_[block].evaluations;
  field.energies[k] = landscape(k, block).energy_and_gradient(field.nodes[k], normal);
  field.slopes[k] = algebra().norm(normal);
  // A flat point has no normal. Its node is free: nothing is divided by its slope.
  const double scale = field.slopes[k] > 0.0 ? 1.0 / field.slopes[k] : 0.0;
  for (double& component : normal) component *= scale;
}

void SoftNodes::evaluate(Field& field) {
  for (const std::size_t end : {std::size_t{0}, field.nodes.size() - 1}) evaluate_node(field, end, 0);
  blocks_.for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) evaluate_node(field, k, block);
  });
}

bool SoftNodes::restore_node(Field& field, std::size_t k, std::size_t block, double level, double longest_correction) {
  for (int correction = 0; correction < most_corrections; ++correction) {
    const double excess = field.energies[k] - level;
    if (excess <= 0.0) return true;
    if (!std::isfinite(excess) || !(field.slopes[k] > 0.0)) return false;
    // Slightly beyond the level, so that rounding does not leave the node above it.
    const double step = std::min(1.000001 * excess / field.slopes[k] + 1e-12 * longest_correction, longest_correction);
    algebra().axpy(field.nodes[k], field.nodes[k], -step, field.normals[k]);
    evaluate_node(field, k, block);
  }
  return field.energies[k] <= level;
}

bool SoftNodes::restore(Field& field, const std::vector<double>& levels, double longest_correction) {
  std::atomic<bool> restored = true;
  blocks_.for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (!restore_node(field, k, block, levels[k], longest_correction)) restored = false;
  });
  return restored;
}

bool SoftNodes::move(Field& field, const Field& from, const Polyline& steps, const std::vector<double>& levels,
                     double longest_correction) {
  std::atomic<bool> moved = true;
  blocks_.for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      algebra().axpy(field.nodes[k], from.nodes[k], 1.0, steps[k]);
      evaluate_node(field, k, block);
      if (!restore_node(field, k, block, levels[k], longest_correction)) moved = false;
    }
  });
  return moved;
}

void SoftNodes::add_curvature(const Field& field, std::size_t k, std::size_t block, const AlignedArray& direction, double factor,
                              double displacement, AlignedArray& out) {
  const double length = factor > 0.0 ? algebra().norm(direction) : 0.0;
  if (!(length > 0.0)) return;
  Block& scratch = scratch_[block];
  const double scale = displacement / length;
  algebra().axpy(scratch.position, field.nodes[k], scale, direction);
  ++scratch.evaluations;
  landscape(k, block).gradient(scratch.position, scratch.gradient);
  algebra().combine(out, out, factor / scale, scratch.gradient, -factor / scale * field.slopes[k], field.normals[k]);
}

std::vector<double> SoftNodes::segment_energies(const Field& field, std::size_t samples) {
  std::vector<double> largest(field.nodes.size() - 1);
  const auto energy = [&](std::size_t segment, std::size_t block) {
    SegmentEnergies energies(landscape(segment, block), samples);
    largest[segment] =
        energies.largest(field.nodes[segment], field.energies[segment], field.nodes[segment + 1], field.energies[segment + 1]);
    scratch_[block].evaluations += samples + 1;
  };
  energy(0, 0);
  blocks_.for_each_block([&](std::size_t block, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) energy(k, block);
  });
  return largest;
}

void SoftNodes::exchange(Archive& archive) {
  for (std::size_t b = 0; b < NodeBlocks::count; ++b)
    archive.field(fmt::format("evaluations{:02}", b + 1), scratch_[b].evaluations);
  for (std::size_t k = 0; k < landscapes_.size(); ++k) {
    archive.enter(fmt::format("landscape{:04}", k + 1));
    landscapes_[k]->exchange(archive);
    archive.leave();
  }
}

}  // namespace lanescape
