#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/model.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/end_points.hpp"
#include "dynamics/hard_end_points.hpp"
#include "observables/diffusion.hpp"
#include "observables/relaxation.hpp"
#include "run/run_loop.hpp"

namespace lanescape {

// What is measured beside diffusion at lags spaced by factors.
struct RelaxationOptions {
  std::vector<double> wave_numbers;  // k of each species, or one for all [1/sigma]; default 7.25 over the largest sigma or diameter
  std::optional<double> overlap_length;  // [sigma]; default 0.3 of the largest sigma or diameter
  std::optional<std::uint64_t> records;  // of a trajectory, which goes on if these are more than the window's; default: those
};

struct DiffusionRunOptions {
  DiffusionWindow window;  // of hard spheres in units of sigma sqrt(m / k_B T)
  RelaxationOptions relaxation;
  std::uint64_t trajectories = 5;
  std::uint64_t between = 100'000;                      // steps or collisions between trajectories
  std::uint64_t equilibration_collisions = 10'000'000;  // hard spheres
  EndPointOptions equilibration;                        // soft: melting, cooling, check and settling as for end points
  std::uint64_t seed = 1;

  // Throws Error(bad_input) naming the option that is out of range.
  void check() const;
};

// The parameters at a packing fraction ([G] tables 4.3 and 4.5; PHYSICS misprints corrected): window, trajectories and
// collisions between them, for one species or several.
DiffusionRunOptions source_diffusion_options(std::size_t species, double packing_fraction);
// For soft models: a record every 10 steps of 0.001, t_max = 10, five trajectories of 100 time units.
DiffusionRunOptions soft_diffusion_options();

// The options with all defaults of a model. k = 7.25/sigma is the first peak of the structure factor of Kob and Andersen's A
// particles, at which they compare relaxation (doi 10.1103/PhysRevE.52.4134); dense simple liquids have theirs nearby. Throws
// Error(bad_input) for numbers out of range.
RelaxationWindow relaxation_window(const AnyModel& model, const DiffusionRunOptions& options);

struct DiffusionRunResult {
  DiffusionAccumulator diffusion;
  RelaxationAccumulator relaxation;
  bool interrupted = false, equilibrated = true;
  double compressibility = 0.0;  // hard, over all trajectories, 3N - 3 convention
  double pressure = 0.0;         // soft, mean over the trajectories [epsilon/sigma^3]
  double temperature = 0.0;      // soft, likewise, 3N convention
  double seconds = 0.0;
};

// Self-diffusion from `start`, equilibrated first. Resumes after the last finished trajectory, with the same bits as without an
// interruption. Throws Error(bad_input) for impossible options or overlapping particles.
DiffusionRunResult run_diffusion(const AnyModel& model, const Configuration& start, const DiffusionRunOptions& options, Isa isa,
                                 const CheckpointOptions& checkpoint, RunMonitor& monitor);

}  // namespace lanescape
