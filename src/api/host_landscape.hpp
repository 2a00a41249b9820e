#pragma once

#include <lanescape/landscape.hpp>

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "configuration/mixture.hpp"
#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "landscape/soft_landscape.hpp"

namespace lanescape {

// Particles of which only the masses are known: one species for each mass.
struct MassMixture {
  // No masses: all are 1. Throws Error(bad_input) for a number that is not that of the particles, and masses not above 0.
  MassMixture(std::span<const double> masses, std::size_t particles);

  Mixture mixture;
  std::vector<int> species;
};

// A host's landscape as steppers and dynamics see it.
class HostLandscape final : public SoftLandscape {
 public:
  // Both must outlive this object.
  HostLandscape(Landscape& host, const ParticleLayout& layout, Isa isa);

  std::size_t dimension() const override { return layout_->dimension(); }
  std::size_t particles() const override { return layout_->size(); }
  const VectorAlgebra& algebra() const override { return algebra_; }
  double energy(const AlignedArray& position) override;
  // Throws Error(bad_input) where the host's gradient is not finite.
  double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) override;

 private:
  std::span<const double> to_host(const AlignedArray& position);
  [[noreturn]] void refuse_gradient() const;

  Landscape* host_;
  const ParticleLayout* layout_;
  VectorAlgebra algebra_;
  std::vector<double> positions_, gradient_;  // in the host's order
};

}  // namespace lanescape
