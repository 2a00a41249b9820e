#pragma once

#include <memory>
#include <vector>

#include "configuration/lennard_jones_model.hpp"
#include "configuration/particle_layout.hpp"
#include "landscape/soft_landscape.hpp"

namespace lanescape {

// The same landscape in coordinates q = sqrt(m_j / <m>) r_j. Lengths in q are kinematic lengths, ds^2 = sum m_j dr_j^2 / <m>,
// and gradients in q are inverse-mass weighted, so that every finder stays Euclidean whatever the masses.
class KinematicLandscape final : public SoftLandscape {
 public:
  // `scale` per coordinate, as from kinematic_scale(); entries of padding are 1.
  KinematicLandscape(std::unique_ptr<SoftLandscape> inner, AlignedArray scale);

  std::size_t dimension() const override { return inner_->dimension(); }
  std::size_t particles() const override { return inner_->particles(); }
  const VectorAlgebra& algebra() const override { return inner_->algebra(); }
  double energy(const AlignedArray& position) override;
  double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) override;

 private:
  const AlignedArray& to_positions(const AlignedArray& q);

  std::unique_ptr<SoftLandscape> inner_;
  AlignedArray scale_, position_;
};

// sqrt(m_j / <m>) for every coordinate of the layout.
AlignedArray kinematic_scale(const LennardJonesModel& model, const ParticleLayout& layout);
bool has_equal_masses(const LennardJonesModel& model);

}  // namespace lanescape
