#pragma once

#include "dispatch/isa.hpp"
#include "interaction/state/state_mixture.hpp"
#include "landscape/soft_landscape.hpp"

namespace lanescape {

// The landscape of sites with states that depend on their surroundings, in a fixed box, R in the layout's order.
class StateMixtureLandscape final : public SoftLandscape {
 public:
  StateMixtureLandscape(StateMixtureParts parts, const Box& box, const ParticleLayout& layout, Isa isa,
                        const StateMixture::Options& options = {});
  StateMixtureLandscape(const StateMixtureModel& model, const Box& box, const ParticleLayout& layout, Isa isa,
                        const StateMixture::Options& options = {})
      : StateMixtureLandscape(make_parts(model), box, layout, isa, options) {}

  std::size_t dimension() const override { return dimension_; }
  std::size_t particles() const override { return particles_; }
  const VectorAlgebra& algebra() const override { return algebra_; }
  double energy(const AlignedArray& position) override { return interaction_.energy(position); }
  double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) override {
    return interaction_.energy_and_gradient(position, gradient).energy;
  }
  void exchange(Archive& archive) override { interaction_.exchange(archive); }

  // Overwrites `gradient`.
  StateMixture::Evaluation energy_and_virial(const AlignedArray& position, AlignedArray& gradient) {
    return interaction_.energy_and_gradient(position, gradient);
  }

  // Its states and densities are those of the last evaluation.
  const StateMixture& interaction() const { return interaction_; }

 private:
  std::size_t dimension_, particles_;
  VectorAlgebra algebra_;
  StateMixture interaction_;
};

}  // namespace lanescape
