#pragma once

#include "flow/continuum_outside.hpp"

namespace lanescape::testing {

// A fluid in the place of the slab of particles, driven by demands as that is: the buffer's force, what is put in and taken out,
// and heat are fluxes through its ends.
class FluidSlab {
 public:
  explicit FluidSlab(const ContinuumOptions& options)
      : area_(options.area),
        solver_(options.equation(), grid(options), options.transport, [&options](double x) { return options.initial(x); }) {}

  Outside::Reports initial() const { return {report(0), report(1)}; }
  Outside::Reports run(const Outside::Demands& demands, double time) {
    Outside::Reports reports;
    CompressibleSolver::Ends ends;
    for (std::size_t face = 0; face < 2; ++face) ends[face] = flux(face, demands[face]);
    solver_.advance(time, ends);
    for (std::size_t face = 0; face < 2; ++face) {
      FaceReport& here = reports[face] = report(face);
      const Conserved& passed = solver_.passed()[face];
      const double sign = face == 0 ? 1.0 : -1.0;
      here.particles = area_ * passed[0];
      here.momentum = {area_ * passed[1], area_ * passed[2], area_ * passed[3]};
      here.energy = area_ * passed[4];
      here.heat = area_ * time * demands[face].heat_flux;
      here.impulse = {area_ * time * demands[face].pressure, sign * area_ * time * demands[face].shear[0],
                      sign * area_ * time * demands[face].shear[1]};
    }
    return reports;
  }
  const CompressibleSolver& solver() const { return solver_; }
  void exchange(Archive& archive) { solver_.exchange(archive); }

  // What crosses both faces in excess of what the fluid's motion carries, per area and time.
  double excess_momentum = 0.0, excess_energy = 0.0;

 private:
  static SolverGrid grid(const ContinuumOptions& options) {
    const double length = options.planes[1] - options.planes[0];
    return {options.planes[0], options.cell_width, static_cast<std::size_t>(std::lround(length / options.cell_width))};
  }
  const FlowState& cell(std::size_t face) const { return face == 0 ? solver_.flow().front() : solver_.flow().back(); }
  FaceReport report(std::size_t face) const {
    const FlowState& here = cell(face);
    FaceReport found;
    found.density = here.fluid.density;
    found.temperature = here.fluid.temperature;
    found.velocity = here.velocity;
    found.energy_per_particle = here.fluid.energy + 0.5 * dot(here.velocity, here.velocity);
    return found;
  }
  Conserved flux(std::size_t face, const FaceDemand& demand) const {
    const FlowState& here = cell(face);
    const bool enters = (demand.mass_flux >= 0.0) == (face == 0);
    const Point& v = enters ? demand.velocity : here.velocity;
    const double energy = enters ? 1.5 * demand.temperature + *demand.energy : here.fluid.energy;
    const double sign = face == 0 ? 1.0 : -1.0;
    const Point force{demand.pressure, sign * demand.shear[0], sign * demand.shear[1]};
    const double m = demand.mass_flux;
    return {m, force[0] + m * v[0] + excess_momentum, force[1] + m * v[1], force[2] + m * v[2],
            m * (energy + 0.5 * dot(v, v)) + dot(force, here.velocity) + demand.heat_flux + excess_energy};
  }

  double area_;
  CompressibleSolver solver_;
};

}  // namespace lanescape::testing
