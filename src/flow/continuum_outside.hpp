#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>

#include "flow/compressible_solver.hpp"
#include "flow/outside.hpp"

namespace lanescape {

// A wave of compression that goes to the right, with a density rho [1 + amplitude exp(-(x - centre)^2/(2 width^2))].
struct Pulse {
  double amplitude = 0.0;  // above -1; negative: of rarefaction
  double centre = 0.0;     // x [sigma]
  double width = 1.0;      // [sigma]
};

// Units of epsilon and sigma, particles of mass 1.
struct ContinuumOptions {
  // Of the fluid far away, and of all of it at the start but for the pulse.
  double density = 0.5, temperature = 2.5, velocity = 0.0;  // velocity: along x, below that of sound
  std::optional<double> cutoff{};                           // of the truncated and shifted potential; none: the whole one
  TransportCoefficients transport{};
  std::array<double, 2> planes{0.0, 1.0};  // x where the left region ends and the right one begins
  double area = 1.0;                       // of each plane, within the box
  std::size_t cells = 100;                 // of each region
  double cell_width = 1.0;
  double slice_distance = 0.5;  // from a plane to the middle of the slice of the slab that is reported
  double memory = 10.0;         // coupling intervals over which what particles carry is averaged; at least 1
  std::optional<Pulse> pulse{};

  // Throws Error(bad_input) that names the option out of range.
  void check() const;
  std::shared_ptr<const EquationOfState> equation() const;
  FlowState reservoir() const;
  // At the start.
  FlowState initial(double x) const;
  // Coupling intervals above this let the two sides of a plane oscillate: fluxes are constant during an interval.
  double longest_interval() const;
};

// The same equations in both regions and in the slab's place, in cells of about the same width: what a coupled run is compared
// with.
CompressibleSolver solver_alone(const ContinuumOptions& options);
std::vector<OutsideCell> cells_of(const CompressibleSolver& solver);

// Fluids on both sides of the slab that exchange fluxes with it, in the manner of [DC]. A region receives exactly what has passed
// its plane, so fluids and particles together conserve mass, momentum and energy to rounding. What shall pass next is the flux that
// the solver finds between the last cell and the slice of the slab beside the plane.
//
// Part of the momentum and energy is carried by particles, or is work of the buffer's force, and known only afterwards. It is
// expected to be that of the fluid, plus a mean over `memory` intervals of what it was in excess of that; pressure, shear and
// heat are asked for the rest. So what has passed in many intervals differs from the sum of the fluxes by at most `memory` times
// the change of this mean: the error of one interval is made good in the next ones.
class ContinuumOutside final : public Outside {
 public:
  explicit ContinuumOutside(const ContinuumOptions& options);

  // These throw Error(goal_not_reached) where the slab or the continuum leaves the equation of state, and advance() throws
  // Error(bad_input) for a time above longest_interval().
  Demands begin(const Reports& initial) override;
  Demands advance(const Reports& passed, double time) override;
  std::vector<OutsideCell> cells() const override;
  void exchange(Archive& archive) override;

  const CompressibleSolver& left() const { return left_; }
  const CompressibleSolver& right() const { return right_; }

 private:
  // Momentum along x, y, z and energy that particles and the work of forces carry through a face, per area and time.
  using Carried = std::array<double, 4>;
  struct Face {
    Carried expected{};  // of the fluid, in this interval
    Carried excess{};    // mean of what it was in excess of this
  };
  FlowState beside(std::size_t face, const FaceReport& report) const;
  FaceDemand demand(std::size_t face, const FaceReport& report);
  Demands demands(const Reports& reports);
  void learn(Face& face, const FaceReport& passed, double area_time) const;

  ContinuumOptions options_;
  std::shared_ptr<const EquationOfState> equation_;
  FlowState reservoir_;
  CompressibleSolver left_, right_;
  std::array<Face, 2> faces_;
};

}  // namespace lanescape
