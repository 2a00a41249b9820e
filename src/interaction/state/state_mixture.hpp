#pragma once

#include <array>
#include <memory>
#include <vector>

#include "configuration/model.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "interaction/reduced_positions.hpp"
#include "interaction/state/site_states.hpp"

namespace lanescape {

// mu_a p_a + T p_a ln p_a of each site.
struct OneBodyTerms {
  std::vector<double> mu;            // species x states [epsilon]; empty: none
  double entropy_temperature = 0.0;  // k_B T, an input [epsilon]; 0: no such term
};

// What an interaction is made of, each part independent of the others. Their lengths are in `length_unit`, a power of two.
struct StateMixtureParts {
  std::unique_ptr<OrderParameter> order_parameter;
  std::unique_ptr<StateResponse> response;
  std::vector<std::unique_ptr<StatePotential>> potentials;
  OneBodyTerms one_body;
  double length_unit = 1.0;  // [sigma]
};

// The parts that a model file describes, in the model's unit of length.
StateMixtureParts make_parts(const StateMixtureModel& model);

// Throws Error(bad_input) where some pair reaches over more images of the box than PairInteraction takes part in.
void check_cutoff(const StateMixtureModel& model, const Box& box);
// Throws Error(bad_input) naming the closest pair if any two particles are nearer than 0.3 of StateMixtureModel::size_of(), or the
// coordinate that is not finite. O(N).
void check_separations(const Configuration& configuration, const StateMixtureModel& model);

// The same for either kind of soft model; hard spheres are not looked at.
void check_soft_separations(const Configuration& configuration, const AnyModel& model);

// Energy, gradient and virial of sites whose states follow their surroundings, in passes over pairs that are never nested ([P]):
// order parameters; energy, forces at fixed p and dU/dp; forces by way of the order parameters. Coordinates are in the layout's
// order. All periodic images count. Each caller's thread needs its own.
class StateMixture {
 public:
  struct Options {
    int threads = 1;                       // that share the rows of the list; no effect on any result
    double skin = default_skin;            // [StateMixtureParts::length_unit]
    PairSearch search = PairSearch::list;  // or all_pairs, which is slow and misses nothing
  };
  StateMixture(StateMixtureParts parts, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table,
               const Options& options);
  StateMixture(const StateMixtureModel& model, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table,
               const Options& options)
      : StateMixture(make_parts(model), box, layout, table, options) {}

  // Takes another box [sigma], as PairInteraction::set_box(). Throws what check_cutoff() throws; nothing has then changed.
  void set_box(const Box& box);

  struct Evaluation {
    double energy = 0.0;           // all of U [epsilon]
    double one_body_energy = 0.0;  // what of it is no pair's [epsilon]
    double virial = 0.0;           // sum r.f [epsilon]
    std::array<double, 6> virial_tensor{};
  };
  double energy(const AlignedArray& positions);  // bit-equal to the others'
  Evaluation energy_and_gradient(const AlignedArray& positions, AlignedArray& gradient);
  Evaluation energy_and_stress(const AlignedArray& positions, AlignedArray& gradient);

  // Of each slot: its one-body terms, half of each of its pairs at the present probabilities, and all of an angle in whose middle
  // it is [epsilon]; zero for padding. Their sum is the energy up to rounding. Costs what a gradient does.
  void energies(const AlignedArray& positions, AlignedArray& energies);

  // Of the last evaluation.
  const SiteStates& states() const { return sites_.site_states(); }
  const AlignedArray& order_parameters() const { return values_; }  // per slot

  const NeighbourList& list() const { return sites_.list(); }
  void exchange(Archive& archive) { sites_.exchange(archive); }

 private:
  Evaluation evaluate(const AlignedArray& positions, AlignedArray& gradient, StateSums::Wanted wanted);
  // Moves sites, finds and stores their states; gives the one-body energy.
  double move_to(const AlignedArray& positions);
  bool by_order() const { return parts_.order_parameter && sites_.states() > 1; }
  // States, the one-body energy, and what it does to the multipliers.
  double find_states();
  void add_multipliers_of_potentials();

  StateMixtureParts parts_;
  ReducedPositions reduced_;
  Sites sites_;
  AlignedArray values_, multipliers_;  // of each slot: order parameter, dU/d(order parameter)
  AlignedArray slopes_;                // dU/dp
  AlignedArray probability_slopes_;    // dp/d(order parameter), slots x states
  AlignedArray unused_;                // gradient where only the energy is wanted
};

}  // namespace lanescape
