#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "configuration/pair_model.hpp"
#include "core/archive.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/fluid_state.hpp"
#include "flow/outside.hpp"
#include "flow/slab_geometry.hpp"
#include "insertion/insertion.hpp"
#include "insertion/removal.hpp"

namespace lanescape {

// How particles pass the faces of a slab.
struct FaceExchangeOptions {
  // Particles are put in between these distances from the face, and taken out within the second [sigma]. Near the face the fluid is
  // thin, so that those which go have about the energy of those that come, and the force of the outside does the work p/rho on
  // each.
  double nearest = 0.5, farthest = 2.5;
  InsertionOptions insertion;  // its target and region are ignored; its largest step is by default that of the density at the face
  RemovalRule removal = RemovalRule::least_disturbance;
  double thermostat_rate = 0.0;  // per time, at which a particle of a buffer gets a new thermal velocity; 0: no thermostat
};

// An insertion and the fluid where it was searched for.
struct FlowInsertion {
  double time = 0.0, density = 0.0;  // density: in the region [sigma^-3]
  std::uint64_t evaluations = 0;
  double energy = 0.0, distance = 0.0;
};

// Why a slab could not follow its outside.
enum class FlowOutcome {
  followed,
  no_place,       // an insertion found no position within its limit of trials
  rate_too_high,  // more particles wait than may be put in at once
  no_particle,    // none is left to be taken out, or to bear the force of the outside
};
const char* to_string(FlowOutcome outcome);

// Particles and heat that pass one face of a slab of one species. Particles beyond the face are taken out. Then as many are put in,
// or taken out, as the net number through the face asks for: the integral of the mass flux, rounded down.
class FaceExchange {
 public:
  // `face`: 0 at x = 0, 1 at x = L. `model` must outlive this object. `threads` have no effect on any result.
  FaceExchange(const PairModel& model, const SlabGeometry& geometry, std::size_t face, const FaceExchangeOptions& options, Isa isa,
               int threads);

  // An exchange after an interval of `time`. `mean_energy`: potential energy per particle of the slab. Adds what passes to
  // `report`.
  FlowOutcome pass(FluidState& fluid, const FaceDemand& demand, double now, double time, double mean_energy, FaceReport& report);

  struct Counts {
    std::uint64_t left = 0, put_in = 0, taken_out = 0;
  };
  const Counts& counts() const { return counts_; }
  // Since the last call of forget_insertions().
  const std::vector<FlowInsertion>& insertions() const { return insertions_; }
  void forget_insertions() { insertions_.clear(); }

  // All but insertions().
  void exchange(Archive& archive);

 private:
  struct Neighbourhood;  // of the face

  double sign() const { return face_ == 0 ? 1.0 : -1.0; }  // of what enters the slab, in fluxes along +x
  double distance(double x) const { return face_ == 0 ? x : geometry_.length - x; }
  Region region(const Box& box) const;
  double volume() const;  // of the region
  // One per correlation volume and collision time.
  double insertion_rate(double density, double temperature) const;
  Neighbourhood neighbourhood(const FluidState& fluid) const;
  // What the buffer gains.
  double heat(FluidState& fluid, const Neighbourhood& near, const FaceDemand& demand, double time) const;
  // Puts in, or takes out, `owed` particles, or as many as may pass now.
  FlowOutcome settle(FluidState& fluid, Neighbourhood& near, const FaceDemand& demand, double owed, double now, double time,
                     double mean_energy, FaceReport& report);
  void take_out_left(FluidState& fluid, Neighbourhood& near, FaceReport& report);
  FlowOutcome put_in(FluidState& fluid, Neighbourhood& near, const FaceDemand& demand, std::uint64_t count, double target,
                     double now, FaceReport& report);
  void take_out(FluidState& fluid, Neighbourhood& near, std::uint64_t count, double target, FaceReport& report);
  void count_out(const FluidState& fluid, std::size_t particle, double energy, FaceReport& report);

  const PairModel* model_;
  SlabGeometry geometry_;
  std::size_t face_;
  FaceExchangeOptions options_;
  Isa isa_;
  int threads_;
  double mass_;
  double due_ = 0.0;      // particles into the slab, by the mass fluxes so far
  double passed_ = 0.0;   // those that went in, net
  double allowed_ = 0.0;  // insertions allowed and not used
  std::uint64_t exchanges_ = 0;
  Counts counts_;
  InsertionHistory history_;
  std::vector<FlowInsertion> insertions_;
};

}  // namespace lanescape
