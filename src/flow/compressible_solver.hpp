#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <variant>
#include <vector>

#include "core/archive.hpp"
#include "flow/riemann_flux.hpp"

namespace lanescape {

// The defaults are for the Lennard-Jones fluid near density 0.5 and T = 2.5. Its shear viscosity is that of Galliero, Boned and
// Baylaucq, Ind. Eng. Chem. Res. 44, 6963 (2005), doi 10.1021/ie050154t; the other two are of the right magnitude and no more.
struct TransportCoefficients {
  double shear_viscosity = 0.68;   // eta [sqrt(m epsilon)/sigma^2]
  double bulk_viscosity = 0.3;     // zeta
  double heat_conductivity = 3.0;  // kappa [k_B sqrt(epsilon/m)/sigma^2]

  // Throws Error(bad_input) unless all are finite and at least 0.
  void check() const;
  // The larger of the diffusivities of momentum along x and of heat.
  double largest_diffusivity(const ThermodynamicState& fluid) const;
};

struct SolverGrid {
  double left = 0.0;        // x of the left end [sigma]
  double cell_width = 1.0;  // [sigma]
  std::size_t cells = 100;

  // Throws Error(bad_input) unless there are cells, at most 1e7 of them, of a positive width.
  void check() const;
  double centre(std::size_t cell) const { return left + (static_cast<double>(cell) + 0.5) * cell_width; }
};

// The compressible Navier-Stokes equations in one dimension, with velocities along all axes, by finite volumes ([TO], chapters 13
// and 14): linear reconstruction of density, velocity, pressure and internal energy with the monotonized central limiter, the HLLC
// flux, central viscous terms, and the strong-stability-preserving Runge-Kutta method of second order ([GST]). What leaves a cell
// enters the next: only what passes the ends changes the totals.
class CompressibleSolver {
 public:
  enum class Side { left, right };
  // What holds an end: a constant flux through it, or a reservoir in this state beyond it. Sound that comes to a reservoir in a
  // state near its own leaves without an echo.
  using End = std::variant<Conserved, FlowState>;
  using Ends = std::array<End, 2>;  // left, right

  // `initial` gives the state at a position. Throws Error(bad_input) for options out of range and unstable fluids.
  CompressibleSolver(std::shared_ptr<const EquationOfState> equation, const SolverGrid& grid,
                     const TransportCoefficients& transport, const std::function<FlowState(double)>& initial);

  // By a time [sigma sqrt(m/epsilon)], in as many steps as stability asks for. Throws Error(goal_not_reached) where a cell leaves
  // the equation of state or becomes unstable; this object is of no further use then.
  void advance(double time, const Ends& ends);
  // What has passed the left and the right end in the last advance(), per area.
  const std::array<Conserved, 2>& passed() const { return passed_; }
  // In the whole grid, per area.
  Conserved total() const;

  // The flux through an end to or from a fluid of this state, whose middle is at `distance` from the end.
  Conserved flux_between(Side side, const FlowState& beyond, double distance) const;

  const SolverGrid& grid() const { return grid_; }
  const std::vector<FlowState>& flow() const { return flow_; }  // of the cells

  // The whole state. Reading throws Error(bad_input) for one of another grid.
  void exchange(Archive& archive);

 private:
  // What is reconstructed: density, three velocities, pressure, internal energy per volume.
  using Primitive = std::array<double, 6>;
  static Primitive primitive(const FlowState& state);
  static FaceSide side_of_cell(const FlowState& cell, const Primitive& slope, double towards);
  void look();
  void look_from_here();
  void step(double time, const Ends& ends);
  double stable_step() const;
  static Primitive limited_slope(const Primitive& before, const Primitive& after);
  Primitive slope(std::size_t cell, const Ends& ends) const;
  Conserved viscous_flux(const FlowState& left, const FlowState& right, double distance) const;
  Conserved end_flux(Side side, const FlowState& beyond, double distance, const Primitive& slope) const;
  void find_fluxes(const Ends& ends);

  std::shared_ptr<const EquationOfState> equation_;
  SolverGrid grid_;
  TransportCoefficients transport_;
  std::vector<double> densities_;  // five per cell
  std::vector<double> start_;      // the temperatures at which the last search for those of the cells started
  std::array<Conserved, 2> passed_{};
  // These follow from what is above.
  std::vector<FlowState> flow_;
  std::vector<Primitive> slope_;
  std::vector<Conserved> flux_;  // through the faces, from the left end on
  std::vector<double> before_;
};

}  // namespace lanescape
