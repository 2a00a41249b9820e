#pragma once

#include <algorithm>
#include <vector>

#include "dispatch/isa.hpp"
#include "interaction/sphere/hard_sphere_list.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"
#include "landscape/hard_landscape.hpp"

namespace lanescape {

// Hard spheres in a fixed box, R in the layout's order.
class HardSphereLandscape final : public HardLandscape {
 public:
  // In smallest diameters. The fastest value measured (docs/PERFORMANCE.md): with a smaller skin lists are rebuilt too often, with
  // a larger one they hold too many pairs.
  static constexpr double default_skin = 0.01;

  HardSphereLandscape(const Box& box, const ParticleLayout& layout, const std::vector<double>& radii, Isa isa,
                      double skin = default_skin)
      : dimension_(layout.dimension()),
        particles_(layout.size()),
        algebra_(kernel_table(isa)),
        spheres_(box, layout, radii, kernel_table(isa)),
        list_(spheres_, skin * 2.0 * *std::min_element(radii.begin(), radii.end())) {}
  // The list refers to the spheres.
  HardSphereLandscape(const HardSphereLandscape&) = delete;
  HardSphereLandscape& operator=(const HardSphereLandscape&) = delete;

  std::size_t dimension() const override { return dimension_; }
  std::size_t particles() const override { return particles_; }
  const VectorAlgebra& algebra() const override { return algebra_; }
  bool allowed(const AlignedArray& position) override { return !list_.any_overlap(position); }
  ContactPairs find_contacts(const AlignedArray& position) override { return list_.find_contacts(position); }
  void add_contact_forces(kernels::ContactPotential potential, AlignedArray& force) override {
    list_.add_contact_forces(potential, force);
  }
  std::size_t avoidance_trial(AlignedArray& trial, const AlignedArray& position, AlignedArray& sum, AlignedArray& force,
                              double step) const override {
    return list_.avoidance_trial(trial, position, sum, force, step);
  }
  double violation(const AlignedArray& position) override { return std::max(0.0, -spheres_.smallest_gap(position)); }

  const HardSphereList& list() const { return list_; }

 private:
  std::size_t dimension_, particles_;
  VectorAlgebra algebra_;
  HardSphereOverlap spheres_;
  HardSphereList list_;
};

}  // namespace lanescape
