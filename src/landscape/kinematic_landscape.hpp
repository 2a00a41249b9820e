#pragma once

#include <memory>
#include <span>
#include <vector>

#include "configuration/mixture.hpp"
#include "configuration/particle_layout.hpp"
#include "landscape/soft_landscape.hpp"

namespace lanescape {

// Converts between positions r and kinematic coordinates q = sqrt(m_j / <m>) r_j. With equal masses both are the same.
class KinematicMetric {
 public:
  KinematicMetric(const Mixture& model, const ParticleLayout& layout);

  bool is_euclidean() const { return scale_.empty(); }
  void to_kinematic(AlignedArray& positions) const;
  void to_positions(AlignedArray& q) const;
  // Of 3N positions in the user's order.
  AlignedArray coordinates(const ParticleLayout& layout, std::span<const double> positions) const;
  // Turns dV/dr into dV/dq.
  void gradient_to_kinematic(AlignedArray& gradient) const { to_positions(gradient); }
  AlignedArray inverse_masses(const ParticleLayout& layout) const;  // <m>/m_j per slot, 1 for padding

 private:
  AlignedArray scale_;  // sqrt(m_j / <m>) per coordinate, 1 for padding
};

// A landscape in coordinates q = sqrt(m_j / <m>) r_j. Lengths in q are kinematic lengths, ds^2 = sum m_j dr_j^2 / <m>, and
// gradients in q are weighted by inverse masses. So finders can use the Euclidean metric for any masses.
class KinematicLandscape final : public SoftLandscape {
 public:
  KinematicLandscape(std::unique_ptr<SoftLandscape> inner, KinematicMetric metric);

  std::size_t dimension() const override { return inner_->dimension(); }
  std::size_t particles() const override { return inner_->particles(); }
  const VectorAlgebra& algebra() const override { return inner_->algebra(); }
  double energy(const AlignedArray& position) override;
  double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) override;
  void gradient(const AlignedArray& position, AlignedArray& gradient) override;
  void exchange(Archive& archive) override { inner_->exchange(archive); }

 private:
  const AlignedArray& position_of(const AlignedArray& q);

  std::unique_ptr<SoftLandscape> inner_;
  KinematicMetric metric_;
  AlignedArray position_;
};

}  // namespace lanescape
