#pragma once

#include <cstddef>
#include <vector>

#include "reference/geodesic.hpp"
#include "reference/hard_sphere.hpp"

/// Plain path finders for hard spheres, to check those in src. Equations: PHYSICS 3.1, 3.4, 3.5.
namespace lanescape::reference {

enum class StepKind { direct, avoidance, away, last_hop };

struct AcceptedStep {
  StepKind kind = StepKind::direct;
  long trials = 0;                // trials of an avoidance step, with the accepted one; 0 for other kinds
  std::vector<double> positions;  // 3N, after the step
};

struct HardGeodesic {
  Outcome outcome = Outcome::reached;
  const char* reason = "";  // why it stalled
  double length = 0.0;      // [sigma], last hop to R_f included
  long direct_steps = 0;    // accepted steps by kind, without the last hop
  long avoidance_steps = 0;
  long away_steps = 0;
  std::vector<long> trials;            // trials[k]: number of avoidance steps whose k-th trial was accepted, k from 1
  double participation = 0.0;          // mean of (sum_j dr_j^2)^2 / sum_j dr_j^4 weighted with step length, [G] Eq. 4.17
  std::vector<double> end;             // the last configuration; R_f if reached
  std::vector<AcceptedStep> accepted;  // the first steps, at most `record` of them
};

struct AvoidanceOptions {
  double direct_step = 0.01;     // [sigma], delta_di, a length in 3N space
  double avoidance_step = 1e-4;  // [sigma], delta_ca, displacement of each particle that moves
  FictitiousPotential potential = FictitiousPotential::harmonic;
  long max_steps = 100'000'000;  // accepted steps
  long max_trials = 10'000;      // in one avoidance step
  long patience = 100'000;       // accepted steps in which the distance to R_f does not decrease
  std::size_t record = 0;        // number of accepted steps to keep
};

/// Path by direct and collision-avoidance steps, PHYSICS 3.4, [G] 3.2.2.2. start, finish: 3N each, unwrapped [sigma].
///
/// No accepted configuration has an overlap. The last hop to R_f is shorter than a direct step and is not checked, as in [G].
/// Every loop has a cap. The outcome is stalled if no trial is free of overlaps, if the forces of a failed trial cancel (further
/// trials would be equal), or if the distance to R_f no longer decreases. Throws std::invalid_argument if sizes differ, steps are
/// not positive, a number is not finite or an end point has an overlap. O(N^2) for each trial.
HardGeodesic find_avoidance_geodesic(const std::vector<double>& start, const std::vector<double>& finish,
                                     const std::vector<double>& radii, const Vector& box, const AvoidanceOptions& options = {});

struct AwayOptions {
  long max_steps = 100'000;  // direct and away steps
  long max_depth = 2000;     // length of a chain of spheres that push each other
  long max_moves = 100'000;  // moves of single spheres in one away step
  long patience = 10'000;    // steps in which the distance to R_f does not decrease
  std::size_t record = 0;    // number of accepted steps to keep
};

/// Path by flights to the first contact and away steps, PHYSICS 3.5, [G] 5.2. start, finish: 3N each, unwrapped [sigma].
///
/// A flight that starts in contact has no length and is not a step. Flights end in contact, away steps 1e-10 from it; no accepted
/// configuration has a gap below -1e-10. [G] does not say how pushing continues. Here the sphere that makes way moves first and
/// then pushes all spheres that its move would hit, including those that it has passed before. The outcome is stalled if the
/// pushing does not end, if spheres still overlap after it, or if the distance to R_f no longer decreases. Throws
/// std::invalid_argument if sizes differ, a number is not finite, an end point has an overlap, or a box edge does not exceed two of
/// the largest diameters.
HardGeodesic find_away_geodesic(const std::vector<double>& start, const std::vector<double>& finish,
                                const std::vector<double>& radii, const Vector& box, const AwayOptions& options = {});

}  // namespace lanescape::reference
