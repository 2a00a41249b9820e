#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"

namespace lanescape {

// g_ab(r) averaged over the configurations added.
class RadialDistribution {
 public:
  // Up to this many particles g(r) extends to half the shortest edge of the box, at O(N^2) per configuration. For more particles it
  // extends by default to at most 5 sigma, where g(r) of a liquid has converged, at O(N).
  static constexpr std::size_t most_for_half_the_box = 5'000;
  static constexpr double range_of_large_systems = 5.0;  // [length_unit]
  static double default_range(const Box& box, std::size_t particles, double length_unit = 1.0);

  // `range`: at most half the shortest edge [sigma].
  RadialDistribution(const Box& box, const ParticleLayout& layout, std::size_t bins, double range);
  RadialDistribution(const Box& box, const ParticleLayout& layout, std::size_t bins)
      : RadialDistribution(box, layout, bins, default_range(box, layout.size())) {}

  void add(const AlignedArray& position);

  std::size_t bins() const { return bins_; }
  double range() const { return range_; }  // [sigma]
  std::size_t species() const { return blocks_.size(); }
  std::uint64_t samples() const { return samples_; }
  double radius(std::size_t bin) const { return (static_cast<double>(bin) + 0.5) * width_; }  // middle of the bin [sigma]
  // 0 if nothing was sampled or a species has no pairs.
  double value(std::size_t a, std::size_t b, std::size_t bin) const;

  void exchange(Archive& archive);

 private:
  Box box_;
  std::vector<kernels::SpeciesBlock> blocks_;
  std::size_t slots_, bins_;
  double range_, width_;
  std::uint64_t samples_ = 0;
  std::vector<std::uint64_t> counts_;  // species x species x bins, pairs counted once with a <= b
};

}  // namespace lanescape
