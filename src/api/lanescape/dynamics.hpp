#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <lanescape/landscape.hpp>
#include <lanescape/model.hpp>
#include <lanescape/owned.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// Called now and then by long work with the part done, 0 ... 1; returning false ends the work early.
using Progress = std::function<bool(double)>;

// Newton's equations on a landscape by the velocity Verlet algorithm (doi 10.1063/1.442716). Unwrapped positions.
class LANESCAPE_API MolecularDynamics {
 public:
  // Starts at rest. `masses`: one per particle, or empty for 1. The landscape must outlive this object.
  MolecularDynamics(Landscape& landscape, std::span<const double> masses, std::span<const double> positions, double time_step);
  ~MolecularDynamics();
  MolecularDynamics(MolecularDynamics&&) noexcept;
  MolecularDynamics& operator=(MolecularDynamics&&) noexcept;

  // Velocities from Maxwell's distribution without total momentum, scaled so that sum m v^2 / 2 = (3/2) N T.
  void draw_velocities(double temperature, std::uint64_t seed);
  void set_velocities(std::span<const double> velocities);
  // Throws Error(bad_input) where the landscape's gradient is not finite. After an exception, of the landscape too, the object
  // stands within a step: restore() a state before going on.
  void run(std::uint64_t steps);

  std::uint64_t steps() const;
  double temperature() const;  // 2 K / (3 N)
  double kinetic_energy() const;
  double potential_energy();
  std::vector<double> positions() const;
  std::vector<double> velocities() const;
  // The state as bytes, and back: positions, velocities, counters. On one instruction set the trajectory goes on with the same bits
  // if the landscape's energies depend on nothing but positions. Bytes that were changed, or are of another number of particles,
  // throw Error(bad_input) and leave the object as it is.
  std::string state() const;
  void restore(const std::string& state);

 private:
  struct Implementation;
  detail::Owned<Implementation> implementation_;
};

// Hard spheres: free flight between elastic collisions, event by event. Time in sigma sqrt(m / k_B T), with T = 1.
class LANESCAPE_API EventDrivenDynamics {
 public:
  // `masses`: one per particle, or empty for 1. Spheres must not overlap by more than rounding, 1e-12 of their distance at contact;
  // edges are at least 2.05 of the largest diameter.
  EventDrivenDynamics(std::span<const double> radii, std::span<const double> masses, std::span<const double> positions,
                      const std::array<double, 3>& box, const std::string& instruction_set = "auto");
  ~EventDrivenDynamics();
  EventDrivenDynamics(EventDrivenDynamics&&) noexcept;
  EventDrivenDynamics& operator=(EventDrivenDynamics&&) noexcept;

  void draw_velocities(std::uint64_t seed);  // at T = 1
  void set_velocities(std::span<const double> velocities);
  // Throws Error(goal_not_reached) if ten million events pass without a collision, as when spheres fly side by side.
  void collide(std::uint64_t collisions);
  void advance_to(double time);

  std::uint64_t collisions() const;
  double time() const;
  double kinetic_energy() const;
  double compressibility() const;         // Z = p V / (N k_B T) since the start; not a number before any time has passed
  std::vector<double> positions() const;  // unwrapped
  std::vector<double> velocities() const;
  // The state as bytes, and back. All spheres are brought to one time first: the trajectory goes on with other bits than without.
  std::string state();
  void restore(const std::string& state);

 private:
  struct Implementation;
  detail::Owned<Implementation> implementation_;
};

// A configuration that the library made.
struct Start {
  std::vector<int> species{};       // of each particle
  std::vector<double> positions{};  // 3N
  std::array<double, 3> box{};
  std::vector<double> diameters{};  // of each particle, where the model has them or is made of hard spheres
};

// A lattice at a number density, species at random in the model's proportions; for hard spheres a packing fraction takes the place
// of the density.
LANESCAPE_API Start make_start(const Model& model, std::size_t particles, double density, std::uint64_t seed = 1);

// Two configurations of one trajectory, unwrapped, 3N each.
struct EndPoints {
  std::vector<double> start, finish;
  double distance = 0.0;    // in 3N space, the motion of the centre of mass removed
  std::uint64_t steps = 0;  // from start to finish; collisions of hard spheres
  double time = 0.0;        // likewise
};

// The protocol that makes end points: melt, cool, check the temperature, settle, and follow the trajectory over a distance; hard
// spheres: equilibrate and follow. Counts are steps, or collisions of hard spheres; 0 stands for the library's own, `quick` for
// shorter ones.
struct EndPointSettings {
  double temperature = 1.0;  // of soft models
  double distance = 0.0;     // 0: 108 at N = 108, else 10 sqrt(N), in the model's unit of length
  std::size_t pairs = 1;     // to make, one after the other on one trajectory
  bool quick = false;
  std::uint64_t equilibration = 0;  // steps of melting, cooling, checking and settling each; collisions of hard spheres
  std::uint64_t between = 0;        // from the end of one pair to the start of the next
  std::uint64_t seed = 1;
  int threads = 1;                       // no effect on any result
  std::string precision = "double";      // or mixed
  std::string instruction_set = "auto";  // or a name of instruction_sets()
  Progress progress{};
};

// Throws Error(goal_not_reached) if the temperature does not hold or the distance is not reached, Error(interrupted) if `progress`
// returns false.
LANESCAPE_API std::vector<EndPoints> make_end_points(const Model& model, const Start& start, const EndPointSettings& settings);

LANESCAPE_ABI_END
}  // namespace lanescape
