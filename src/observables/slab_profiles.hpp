#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"
#include "interaction/state/state_mixture.hpp"

namespace lanescape {

// Profiles of sites in states along z, means over samples. z = 0 is the centre of the slab in each sample.
struct SlabProfiles {
  std::vector<double> z;                         // middle of each bin [sigma]
  std::vector<double> density;                   // [sigma^-3]
  std::vector<double> local_density;             // mean over the sites in the bin; 0 in an empty bin
  std::vector<std::vector<double>> probability;  // of each state, mean over the sites in the bin
  std::vector<double> sites;                     // counted in the bin, all samples together
  std::uint64_t samples = 0;
};

// Accumulates samples of a slab.
class SlabSampler {
 public:
  SlabSampler(const Box& box, std::size_t bins, std::size_t states);

  // `positions` are in the user's order and must be those of the last evaluation of `interaction`.
  void add(const std::vector<double>& positions, const ParticleLayout& layout, const StateMixture& interaction);
  std::uint64_t samples() const { return samples_; }
  SlabProfiles profiles() const;

  void exchange(Archive& archive);

 private:
  Box box_;
  std::size_t bins_, states_;
  std::uint64_t samples_ = 0;
  std::vector<double> sites_, local_density_, probability_;  // sums per bin; probability: states x bins
};

}  // namespace lanescape
