#pragma once

#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "landscape/soft_landscape.hpp"

namespace lanescape {

// The landscape of a mixture with a pair potential in a fixed box, R in the layout's order.
class PairLandscape final : public SoftLandscape {
 public:
  PairLandscape(const PairModel& model, const Box& box, const ParticleLayout& layout, Isa isa,
                const PairSearchOptions& options = {});

  std::size_t dimension() const override { return dimension_; }
  std::size_t particles() const override { return particles_; }
  const VectorAlgebra& algebra() const override { return algebra_; }
  double energy(const AlignedArray& position) override { return interaction_.energy(position); }
  double energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) override;
  void gradient(const AlignedArray& position, AlignedArray& gradient) override { interaction_.gradient(position, gradient); }
  void gradient_after(const SlotWork& move, const AlignedArray& position, AlignedArray& gradient) override {
    interaction_.gradient_after(move, position, gradient);
  }
  std::unique_ptr<SegmentBound> segment_bound(double longest) const override { return interaction_.segment_bound(longest); }
  bool has_history() const override { return interaction_.has_list(); }
  void pass_over(const AlignedArray& position) override { interaction_.pass_over(position); }
  void exchange(Archive& archive) override { interaction_.exchange(archive); }

  struct EnergyAndVirial {
    double energy, virial;  // V and sum r.f [epsilon]
  };
  // Overwrites `gradient`.
  EnergyAndVirial energy_and_virial(const AlignedArray& position, AlignedArray& gradient) {
    const PairInteraction::Evaluation e = interaction_.energy_and_gradient(position, gradient);
    return {e.energy, e.virial};
  }
  // Of each slot: half of each of its pairs [epsilon]; zero for padding. Costs an evaluation.
  void energies(const AlignedArray& position, AlignedArray& energies) { interaction_.energies(position, energies); }

 private:
  std::size_t dimension_, particles_;
  VectorAlgebra algebra_;
  PairInteraction interaction_;
};

}  // namespace lanescape
