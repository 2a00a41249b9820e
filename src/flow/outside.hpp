#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/archive.hpp"
#include "core/point.hpp"

namespace lanescape {

// What lies beyond the two open faces of a slab, x = 0 and x = L. Lengths in sigma, energies in epsilon, time in sigma
// sqrt(m/epsilon). Fluxes count along +x at both faces.

// What the outside asks of a face during the next interval.
struct FaceDemand {
  double pressure = 0.0;           // the buffer at this face gets the total force p A, towards the slab [epsilon/sigma^3]
  std::array<double, 2> shear{};   // and this force per area along y and z [epsilon/sigma^3]
  double mass_flux = 0.0;          // particles through the face per area and time
  Point velocity{};                // mean of particles that are put in
  double temperature = 1.0;        // of particles that are put in
  std::optional<double> energy{};  // potential energy at which they are put in [epsilon]; none: the slab's mean per particle
  double heat_flux = 0.0;          // what the buffer's thermal motion gains (at x = 0) or loses (at x = L) per area and time
};

// What has passed a face in an interval, and the fluid beside its buffer.
struct FaceReport {
  double particles = 0.0;  // net number; fluxes count along +x
  Point momentum{};        // impulse of the buffer's force and momenta of particles put in and taken out
  double energy = 0.0;     // work of that force, energies of particles put in and taken out, and heat
  double heat = 0.0;       // of which heat
  Point impulse{};         // of the buffer's force: a part of `momentum`
  // Means over the interval in the slice next to the buffer.
  double density = 0.0, temperature = 0.0, energy_per_particle = 0.0;  // energy: total, that of the mean motion included
  Point velocity{};
  // Particles in the buffer, over those that it would hold at this density.
  double filling = 0.0;
};

// What an outside may show of itself.
struct OutsideCell {
  double x = 0.0;  // middle [sigma]
  double density = 0.0, velocity = 0.0, temperature = 0.0;
};

// Of a buffer at rest.
inline constexpr double usual_filling = 0.7;

// By how much an outside should raise the pressure of a face, relatively, so that its buffer neither empties nor overflows. Nothing
// else holds the number of particles in it: where those that leave count as part of the pressure, a fuller buffer loses more of
// them and bears less force. In the mean it is zero.
inline double filling_correction(double filling) {
  constexpr double stiffness = 0.5;
  return stiffness * (filling - usual_filling);
}

// A host code implements this, or takes one of the two in this folder.
class Outside {
 public:
  using Demands = std::array<FaceDemand, 2>;  // at x = 0 and x = L
  using Reports = std::array<FaceReport, 2>;
  virtual ~Outside() = default;

  // The demands for the first interval.
  virtual Demands begin(const Reports& initial) = 0;
  // Takes what passed in an interval that lasted `time` and gives the demands for the next one of the same length.
  virtual Demands advance(const Reports& passed, double time) = 0;
  // Cells beyond the faces, in the order of x, for a record; none by default.
  virtual std::vector<OutsideCell> cells() const { return {}; }
  // The whole state.
  virtual void exchange(Archive& archive) = 0;
};

}  // namespace lanescape
