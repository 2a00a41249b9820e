#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lanescape/model.hpp>
#include <lanescape/owned.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// What the outside of a slab asks of one of its faces, x = 0 or x = L, for the next interval. Fluxes count along +x at both faces.
struct FlowDemand {
  double pressure = 0.0;             // the buffer at this face gets the total force p A, towards the slab
  std::array<double, 2> shear{};     // and this force per area along y and z
  double mass_flux = 0.0;            // particles through the face per area and time
  std::array<double, 3> velocity{};  // mean of particles that are put in
  double temperature = 1.0;          // of these
  std::optional<double> energy{};    // potential energy at which they are put in; none: the slab's mean per particle
  double heat_flux = 0.0;            // per area and time, to or from the thermal motion in the buffer
};

// What has passed a face in an interval, in total, and the fluid beside its buffer.
struct FlowReport {
  double particles = 0.0;            // net number
  std::array<double, 3> momentum{};  // impulse of the buffer's force and momenta of particles put in and taken out
  std::array<double, 3> impulse{};   // of this force alone
  double energy = 0.0;               // work of that force, energies of particles put in and taken out, and heat
  double heat = 0.0;                 // of which heat
  // Means over the interval in a slice next to the buffer.
  double density = 0.0, temperature = 0.0;
  double energy_per_particle = 0.0;  // total, that of the mean motion included
  std::array<double, 3> velocity{};
  double filling = 0.0;  // particles in the buffer, over those that it would hold at this density; about 0.7 in equilibrium
};

// What lies beyond the open faces of a slab: a continuum solver, a reservoir. Implement it to couple a host to particles. Calls
// come from the thread that calls the slab. Exceptions pass through.
class LANESCAPE_API FlowOutside {
 public:
  using Demands = std::array<FlowDemand, 2>;  // at x = 0 and x = L
  using Reports = std::array<FlowReport, 2>;
  virtual ~FlowOutside() = default;
  // The demands for the first interval; only the means of the reports are set.
  virtual Demands begin(const Reports& initial) = 0;
  // Takes what passed in an interval that lasted `time`, and gives the demands for the next one of the same length.
  virtual Demands advance(const Reports& passed, double time) = 0;
};

// Means along a slab, a number per slice; not a number where there is none.
struct FlowProfiles {
  std::vector<double> x;            // middles
  std::vector<double> density;      // particles per volume
  std::vector<double> velocity;     // three numbers per slice
  std::vector<double> temperature;  // of the motion about that velocity
  std::vector<double> energy;       // per particle: kinetic, and half of its pairs
  std::vector<double> mass_flux;    // particles per area and time through the planes on either side
  std::vector<double> pressure;     // normal, by the method of planes
};

// Molecular dynamics of particles of one species in a slab with open faces at x = 0 and x = L, periodic along y and z: buffers bear
// the outside's pressure, what leaves is taken out, particles are inserted and removed as the outside's mass flux asks.
// Delgado-Buscalioni and Coveney, doi 10.1063/1.1579475, IV.B. For models of one species with a pair potential, without long-range
// corrections.
class LANESCAPE_API OpenFlow {
 public:
  struct Options {
    double buffer = 4.0;                       // width of the buffers
    double slice = 2.0;                        // about, of the slices of profiles
    double nearest = 0.5, farthest = 2.5;      // distances from a face between which particles are put in
    double tolerance = 0.1;                    // of the energy of inserted particles, relative
    double thermostat_rate = 0.0;              // at which particles in the buffers get new thermal velocities, per time
    double time_step = 0.002;                  // of velocity Verlet
    std::uint64_t steps_per_exchange = 10;     // between exchanges of particles
    std::uint64_t exchanges_per_coupling = 5;  // between calls of the outside
    std::uint64_t seed = 1;                    // of places and velocities
    int threads = 1;                           // no effect on any result
    std::string instruction_set = "auto";      // or a name of instruction_sets()
  };

  // `positions` and `velocities` 3N, x from 0 to L. Throws Error(bad_input). The outside must outlive this object.
  OpenFlow(const Model& model, std::span<const double> positions, std::span<const double> velocities,
           const std::array<double, 3>& box, FlowOutside& outside);
  OpenFlow(const Model& model, std::span<const double> positions, std::span<const double> velocities,
           const std::array<double, 3>& box, FlowOutside& outside, const Options& options);
  ~OpenFlow();
  OpenFlow(OpenFlow&&) noexcept;
  OpenFlow& operator=(OpenFlow&&) noexcept;

  // Steps up to the next call of the outside, and that. Throws Error(goal_not_reached) where the slab cannot follow the outside,
  // which the message explains; particles stay as they are then.
  void advance();

  std::uint64_t steps() const;
  double time() const;
  std::size_t particles() const;
  // 3N, in an order that changes at every exchange.
  std::vector<double> positions() const;
  std::vector<double> velocities() const;
  // Means since the last call, or the start; at least one advance() lies between.
  FlowProfiles profiles();
  // Energy stored since the start less what passed the faces, per particle: the integrator's error.
  double energy_error() const;

 private:
  struct Implementation;
  detail::Owned<Implementation> implementation_;
};

LANESCAPE_ABI_END
}  // namespace lanescape
