#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"

namespace lanescape {

// g_ab(r) up to half the shortest edge of the box, averaged over the configurations added. O(N^2) per configuration.
class RadialDistribution {
 public:
  RadialDistribution(const Box& box, const ParticleLayout& layout, std::size_t bins);

  void add(const AlignedArray& position);

  std::size_t bins() const { return bins_; }
  std::size_t species() const { return blocks_.size(); }
  std::uint64_t samples() const { return samples_; }
  double radius(std::size_t bin) const { return (static_cast<double>(bin) + 0.5) * width_; }  // middle of the bin [sigma]
  // 0 where nothing was sampled or a species has no pairs.
  double value(std::size_t a, std::size_t b, std::size_t bin) const;

  void exchange(Archive& archive);

 private:
  Box box_;
  std::vector<kernels::SpeciesBlock> blocks_;
  std::size_t slots_, bins_;
  double width_;
  std::uint64_t samples_ = 0;
  std::vector<std::uint64_t> counts_;  // species x species x bins, pairs counted once with a <= b
};

}  // namespace lanescape
