#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/archive.hpp"
#include "core/point.hpp"
#include "flow/slab_geometry.hpp"

namespace lanescape {

// Means of a slab over some time, a number per slice.
struct FlowProfile {
  std::vector<double> x;            // middles [sigma]
  std::vector<double> density;      // [sigma^-3]
  std::vector<Point> velocity;      // of the centre of mass
  std::vector<double> temperature;  // of the motion about that velocity
  std::vector<double> energy;       // per particle: kinetic, that of the mean velocity included, and half of its pairs
  std::vector<double> mass_flux;    // particles per area and time through the planes on either side
  std::vector<double> pressure;  // normal, of the planes on either side of the slice: momentum that passes and forces across, less
                                 // rho u^2
};

// Sums for a FlowProfile.
class FlowSampler {
 public:
  FlowSampler(const SlabGeometry& geometry, double mass);

  // Of one configuration: positions and velocities x0 y0 z0 x1 ...; `forces_across` as BufferLandscape gives them.
  void add_motion(std::span<const double> positions, std::span<const double> velocities, std::span<const double> forces_across);
  // The energies of its particles, in some of the configurations.
  void add_energies(std::span<const double> positions, std::span<const double> energies);
  // What passed planes in some time.
  void add_passages(std::span<const double> particles, std::span<const double> momentum, double time);

  bool empty() const { return samples_ == 0; }
  FlowProfile profile() const;
  void clear();
  void exchange(Archive& archive);

 private:
  double plane_pressure(std::size_t plane) const;

  SlabGeometry geometry_;
  double mass_;
  std::uint64_t samples_ = 0;
  double time_ = 0.0;
  // Sums per slice; momentum: three numbers each.
  std::vector<double> count_, momentum_, kinetic_, energy_count_, potential_;
  std::vector<double> across_, passed_, passed_particles_;  // per plane beyond a slice
};

}  // namespace lanescape
