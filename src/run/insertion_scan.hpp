#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"
#include "insertion/insertion.hpp"
#include "run/moving_fluid.hpp"
#include "run/run_loop.hpp"

namespace lanescape {

// The energy that the positions of a scan are to have.
enum class ScanTarget {
  mean_excess_energy,  // per particle, of each configuration
  chemical_potential,  // the excess part, from the scan's own probes of each configuration
  number,              // InsertionOptions::target
};

// The cost of insertion in fluids of several densities and temperatures. Every combination of method, tolerance and largest step
// searches the same configurations, which do not change.
struct InsertionScanOptions {
  struct State {
    double density, temperature;
  };
  std::vector<State> states;
  std::vector<InsertionMethod> methods;
  std::vector<double> tolerances;
  std::vector<std::optional<double>> largest_steps;  // empty: the method's default
  ScanTarget target = ScanTarget::mean_excess_energy;
  InsertionOptions insertion;  // everything else
  int species = 0;
  std::uint64_t particles = 1000, configurations = 5, count = 100;  // count: positions per configuration and combination
  std::uint64_t equilibration_steps = 10'000, between_steps = 2000;
  double time_step = 0.002;
  std::uint64_t widom_probes = 0;     // per configuration, for the chemical potential
  std::uint64_t holes = 0;            // per configuration
  std::vector<double> iso_energies;   // of holes [epsilon]
  std::uint64_t traced_searches = 0;  // per configuration, of direct USHER to the limit of precision
  std::uint64_t map_points = 0;       // along each edge of a map of a state's last configuration
  std::uint64_t seed = 1;
  int threads = 1;

  // Throws Error(bad_input) naming what is out of range.
  void check(const PairModel& model) const;
};

struct ScanCostRow {
  double density = 0.0, temperature = 0.0;  // the requested ones
  InsertionMethod method = InsertionMethod::usher;
  double tolerance = 0.0, largest_step = 0.0;                                      // 0: the method's default
  double target = 0.0;                                                             // mean over configurations [epsilon]
  double evaluations = 0.0, evaluations_error = 0.0, evaluations_deviation = 0.0;  // mean, its standard error, spread
  double trials = 0.0, candidates = 0.0;
  double distance = 0.0, largest_distance = 0.0;  // [sigma]
  double error = 0.0;                             // mean
  double failures = 0.0;
  double seconds = 0.0;  // per position
};

struct ScanStateRow {
  double density = 0.0, temperature = 0.0;
  double measured_temperature = 0.0, excess_energy = 0.0, pressure = 0.0;  // means over configurations
  double chemical_potential = 0.0, chemical_potential_error = 0.0;         // excess, by Widom's method; 0 without probes
};

// Medians over holes.
struct ScanHoleRow {
  double density = 0.0, temperature = 0.0, iso_energy = 0.0;
  double holes = 0.0;  // how many
  double mean_radius = 0.0, semi_minor = 0.0, semi_major = 0.0, anisotropy = 0.0, eccentricity = 0.0, open = 0.0;
};

// |xi| at one evaluation and at the next, of searches by direct USHER.
struct ScanErrorPair {
  double density, error, next_error;
};

// The energy of a probe at a point of the plane x = 0 ([U] figure 1).
struct ScanMapPoint {
  double density, temperature;
  double y, z;    // [sigma]
  double energy;  // [epsilon]
  double target;  // the configuration's mean excess energy per particle [epsilon]
};

struct InsertionScanResult {
  std::vector<ScanStateRow> states;
  std::vector<ScanCostRow> costs;
  std::vector<ScanHoleRow> holes;
  std::vector<ScanErrorPair> errors;
  std::vector<ScanMapPoint> map;
  bool interrupted = false;
  double seconds = 0.0;
};

InsertionScanResult run_insertion_scan(const PairModel& model, const InsertionScanOptions& options, Isa isa,
                                       const CheckpointOptions& checkpoint, RunMonitor& monitor);

}  // namespace lanescape
