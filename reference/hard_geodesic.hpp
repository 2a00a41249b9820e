#pragma once

#include <cstddef>
#include <vector>

#include "reference/geodesic.hpp"
#include "reference/hard_sphere.hpp"

/// Plain path finders for hard spheres, for judging the real ones. Equations: PHYSICS 3.1, 3.4, 3.5.
namespace lanescape::reference {

enum class StepKind { direct, avoidance, away, last_hop };

struct AcceptedStep {
  StepKind kind = StepKind::direct;
  long trials = 0;                // of an avoidance step, the accepted one included; else 0
  std::vector<double> positions;  // 3N, where it led
};

struct HardGeodesic {
  Outcome outcome = Outcome::reached;
  const char* reason = "";  // why it stalled
  double length = 0.0;      // [sigma], last hop to R_f included
  long direct_steps = 0;    // accepted steps by kind; the last hop is none of them
  long avoidance_steps = 0;
  long away_steps = 0;
  std::vector<long> trials;            // trials[k]: avoidance steps whose k-th trial was accepted, k from 1
  double participation = 0.0;          // mean of (sum_j dr_j^2)^2 / sum_j dr_j^4 weighted with step length, [G] Eq. 4.17
  std::vector<double> end;             // where it is: R_f where reached
  std::vector<AcceptedStep> accepted;  // the first ones, as many as asked for
};

struct AvoidanceOptions {
  double direct_step = 0.01;     // [sigma], delta_di, a length in 3N space
  double avoidance_step = 1e-4;  // [sigma], delta_ca, of each particle that moves
  FictitiousPotential potential = FictitiousPotential::harmonic;
  long max_steps = 100'000'000;  // accepted steps
  long max_trials = 10'000;      // of one avoidance step
  long patience = 100'000;       // accepted steps without coming nearer to R_f
  std::size_t record = 0;        // accepted configurations to keep
};

/// Path by direct and collision-avoidance steps, PHYSICS 3.4, [G] 3.2.2.2. start, finish: 3N each, unwrapped [sigma].
///
/// No accepted configuration has an overlap. The hop to R_f, shorter than a direct step, is not looked at, as in the source.
/// Every loop is capped. Stalls where no trial is free of overlaps, where the forces of a failed trial cancel (they could
/// never change), and where nothing nearer to R_f is found. Throws std::invalid_argument where sizes, steps or numbers do
/// not fit, or an end has an overlap. O(N^2) for each trial.
HardGeodesic find_avoidance_geodesic(const std::vector<double>& start, const std::vector<double>& finish,
                                     const std::vector<double>& radii, const Vector& box, const AvoidanceOptions& options = {});

struct AwayOptions {
  long max_steps = 100'000;  // direct and away steps
  long max_depth = 2000;     // spheres pushed one by the other
  long max_moves = 100'000;  // of single spheres in one away step
  long patience = 10'000;    // steps without coming nearer to R_f
  std::size_t record = 0;    // accepted configurations to keep
};

/// Path by flights to the first contact and away steps, PHYSICS 3.5, [G] 5.2. start, finish: 3N each, unwrapped [sigma].
///
/// A flight that starts in contact has no length and is no step. Spheres are brought into contact or, by an away step, to
/// 1e-10 from it; accepted configurations have no gap below -1e-10. The source leaves open how the pushing goes on; here
/// the sphere that makes way moves first and pushes what its move would run into, those it has passed before as well. Stalls
/// where the pushing finds no end, a sphere is left overlapping another, or nothing nearer to R_f is found. Throws
/// std::invalid_argument where sizes or numbers do not fit, an end has an overlap, or the box does not exceed two of the
/// largest diameters.
HardGeodesic find_away_geodesic(const std::vector<double>& start, const std::vector<double>& finish,
                                const std::vector<double>& radii, const Vector& box, const AwayOptions& options = {});

}  // namespace lanescape::reference
