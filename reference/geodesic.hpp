#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

/// A plain path finder over any energy function, to check the one in src. Equations: PHYSICS 3.1-3.3.
namespace lanescape::reference {

using Energy = std::function<double(const std::vector<double>& positions)>;
/// Writes +dV/dR (3N) into `gradient`, which already has that size.
using Gradient = std::function<void(const std::vector<double>& positions, std::vector<double>& gradient)>;

enum class Method { contour, escape };
enum class Outcome { reached, step_limit, stalled };

struct GeodesicOptions {
  double step = 1e-3;                      // [sigma], delta_di, a length in 3N space
  double energy_tolerance = 1e-4;          // [epsilon], dV; the escape method allows V <= E_L + dV
  double contour_retreat = 1e-5;           // [sigma], added along -grad V for each failed contour trial
  std::optional<double> landscape_energy;  // [epsilon], E_L; default max(V(R_i), V(R_f))
  long max_steps = 10'000'000;             // accepted steps
  long max_inner = 10'000;                 // trials of one contour step, iterations of one escape step
  long patience = 1000;                    // accepted steps in which the distance to R_f does not decrease
  std::size_t record = 0;                  // number of accepted steps to keep
};

struct Geodesic {
  Outcome outcome = Outcome::reached;
  const char* reason = "";  // why it stalled
  double length = 0.0;      // [sigma], last hop to R_f included
  long direct_steps = 0;    // accepted steps by kind, without the last hop
  long contour_steps = 0;
  long escape_steps = 0;                      // one for each return to V <= E_L + dV, whatever the number of iterations
  double participation = 0.0;                 // mean of (sum_j dr_j^2)^2 / sum_j dr_j^4 weighted with step length, [G] Eq. 4.17
  double landscape_energy = 0.0;              // [epsilon], E_L
  std::vector<double> end;                    // the last configuration; R_f if reached
  std::vector<std::vector<double>> accepted;  // configurations after the first steps, at most `record` of them
};

/// Path from `start` to `finish` (3N each, unwrapped [sigma]) with V(R) <= E_L (contour) or V(R) <= E_L + dV (escape).
///
/// Contour makes one energy evaluation per trial, direct or contour, and one gradient evaluation per contour step
/// ([C] Algorithm 1). Every loop has a cap. The outcome is stalled if there is no progress, the gradient vanishes or the direction
/// has no tangential part. Throws std::invalid_argument if sizes differ or the step is not positive.
Geodesic find_geodesic(const std::vector<double>& start, const std::vector<double>& finish, const Energy& energy,
                       const Gradient& gradient, Method method, const GeodesicOptions& options = {});

}  // namespace lanescape::reference
