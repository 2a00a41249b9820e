#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "configuration/pair_model.hpp"
#include "core/archive.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/fluid_state.hpp"
#include "flow/beside_buffer.hpp"
#include "flow/face_exchange.hpp"
#include "flow/flow_profile.hpp"
#include "flow/outside.hpp"
#include "flow/slab_geometry.hpp"

namespace lanescape {

struct OpenSlabOptions {
  double buffer = 4.0;  // width of the buffers [sigma]
  double slice = 2.0;   // about, of profiles [sigma]
  double time_step = 0.002;
  std::uint64_t steps_per_exchange = 10;     // between exchanges of particles
  std::uint64_t exchanges_per_coupling = 5;  // between calls of the outside
  FaceExchangeOptions faces;
  Isa isa = Isa::sse2;
  int threads = 1;  // no effect on any result

  // Throws Error(bad_input) naming the option that is out of range in this box.
  void check(const PairModel& model, const Box& box) const;
};

// What is in a slab, what was in it at the start, and what passed its faces since.
struct FlowBalance {
  struct Content {
    double particles = 0.0, energy = 0.0;  // energy: kinetic and of pairs [epsilon]
    Point momentum{};
  };
  Content start, now, passed;
  std::array<FaceExchange::Counts, 2> faces{};

  // What the integrator's error and the truncation have made of the energy, per particle.
  double energy_error() const { return (now.energy - start.energy - passed.energy) / now.particles; }
};

// Molecular dynamics of a fluid of one species in a slab with open faces at x = 0 and x = L, periodic along y and z: velocity
// Verlet at constant energy, but for what passes the faces (Delgado-Buscalioni and Coveney, J. Chem. Phys. 119, 978 (2003), IV.B).
// Its bits depend on the start, the options and the instruction set.
class OpenSlab {
 public:
  // `start`: in a box that is open along x. The model and the outside must outlive this object. Throws what check() throws.
  OpenSlab(const PairModel& model, FluidState start, const OpenSlabOptions& options, Outside& outside);

  // Draws new thermal velocities, each with this probability; what all gain counts as passed. The momentum of all stays as it is.
  void thermalize(double temperature, double probability);
  // Another outside, from now on; the balance starts anew.
  void set_outside(Outside& outside);
  // Steps up to the next exchange with the outside, and that. Does nothing once it has failed.
  FlowOutcome advance();
  FlowOutcome outcome() const { return outcome_; }

  std::uint64_t steps() const { return exchanges_ * options_.steps_per_exchange; }
  double time() const { return static_cast<double>(steps()) * options_.time_step; }
  const FluidState& fluid() const { return fluid_; }
  const SlabGeometry& geometry() const { return geometry_; }
  // Means since its last clear().
  FlowSampler& sampler() { return sampler_; }
  // At the start of the last interval between exchanges.
  const FlowBalance& balance() const { return balance_; }
  const Outside::Demands& demands() const { return *demands_; }  // once there was a step
  const Outside::Reports& reports() const { return reports_; }   // of the last interval between calls of the outside
  // At a face, likewise.
  const std::vector<FlowInsertion>& insertions(std::size_t face) const { return faces_[face].insertions(); }
  double coupling_time() const { return static_cast<double>(options_.exchanges_per_coupling) * interval_time(); }

  // Between two calls of advance(), of a slab that has taken steps; the outside is part of it.
  void exchange(Archive& archive);

 private:
  struct Interval;  // between exchanges: its layout, landscape and dynamics

  // Means beside the buffers now.
  Outside::Reports look();
  double interval_time() const { return static_cast<double>(options_.steps_per_exchange) * options_.time_step; }
  FlowOutcome pass_interval(std::array<BesideBuffer, 2>& beside, bool with_energies);
  void observe(Interval& interval, std::array<BesideBuffer, 2>& beside, bool with_energies);
  void keep_balance(Interval& interval);
  std::vector<double> energies_of(Interval& interval);
  void take_motion(const Interval& interval);
  void add_reports(const Outside::Reports& passed);
  std::array<BesideBuffer, 2> beside_buffers() const;

  const PairModel* model_;
  OpenSlabOptions options_;
  Outside* outside_;
  SlabGeometry geometry_;
  FluidState fluid_;
  std::array<FaceExchange, 2> faces_;
  FlowSampler sampler_;
  std::optional<Outside::Demands> demands_;  // none before the first step
  Outside::Reports reports_{};
  FlowBalance::Content passed_;
  FlowBalance balance_;
  std::uint64_t exchanges_ = 0;
  double mean_energy_ = 0.0;  // potential, per particle between the buffers
  FlowOutcome outcome_ = FlowOutcome::followed;
};

}  // namespace lanescape
