#pragma once

#include <array>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/lennard_jones_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/box.hpp"
#include "kernel_table.hpp"

namespace lanescape {

// Which image search a cutoff needs in a box (docs/ARCHITECTURE.md, "Small boxes"); lengths in the same unit.
kernels::ImageSearch image_search(const Box& box, double cutoff, ImageRule rule);

// Largest number of periodic images per direction that the rule `all` takes part in.
inline constexpr int max_image_shells = 8;
// Throws Error(bad_input) where some pair's cutoff reaches further than that.
void check_cutoff(const LennardJonesModel& model, const Box& box);

// Throws Error(bad_input) naming the closest pair if any two particles are nearer than 0.3 sigma_ab, where r^-12 has lost all
// meaning, or the coordinate that is not finite. O(N).
void check_separations(const Configuration& configuration, const LennardJonesModel& model);

// Energy, gradient and virial of one mixture in one box, all pairs, by the kernels of one instruction set. Holds the scratch
// memory of an evaluation, so that each thread needs its own. Coordinates are in the layout's order.
class LennardJones {
 public:
  // Throws what check_cutoff() throws.
  LennardJones(const LennardJonesModel& model, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table);

  struct Evaluation {
    double energy = 0.0;                    // [epsilon]
    double virial = 0.0;                    // sum r.f [epsilon]
    std::array<double, 6> virial_tensor{};  // sum r_a f_b, Voigt xx yy zz yz xz xy; from energy_and_stress only
  };

  double energy(const AlignedArray& positions);
  Evaluation energy_and_gradient(const AlignedArray& positions, AlignedArray& gradient);
  Evaluation energy_and_stress(const AlignedArray& positions, AlignedArray& gradient);

 private:
  // What does not depend on the positions: own images of a particle and long-range corrections.
  void add_images_of_self(const LennardJonesModel& model, const Box& box);
  void add_tail(const LennardJonesModel& model, const Box& box);
  kernels::LjInput input(const AlignedArray& positions);
  Evaluation with_constants(const kernels::LjOutput& out) const;

  const kernels::KernelTable* table_;
  std::vector<kernels::SpeciesBlock> blocks_;
  std::vector<kernels::LjPair> pairs_;
  AlignedArray scratch_;
  kernels::LjInput input_{};
  Evaluation constants_;
};

}  // namespace lanescape
