#pragma once

#include <functional>
#include <optional>
#include <vector>

/// A plain path finder over any energy function, for judging the real one. Equations: PHYSICS 3.1-3.3.
namespace lanescape::reference {

using Energy = std::function<double(const std::vector<double>& positions)>;
/// Writes +dV/dR (3N) into its second argument, which arrives with the right size.
using Gradient = std::function<void(const std::vector<double>& positions, std::vector<double>& gradient)>;

enum class Method { contour, escape };
enum class Outcome { reached, step_limit, stalled };

struct GeodesicOptions {
  double step = 1e-3;                      // [sigma], delta_di, a length in 3N space
  double energy_tolerance = 1e-4;          // [epsilon], dV; the escape method allows V <= E_L + dV
  double contour_retreat = 1e-5;           // [sigma], added along -grad V for each failed contour trial
  std::optional<double> landscape_energy;  // [epsilon], E_L; max(V(R_i), V(R_f)) where not given
  long max_steps = 10'000'000;             // accepted steps
  long max_inner = 10'000;                 // trials of one contour step, iterations of one escape step
  long patience = 1000;                    // accepted steps without coming nearer to R_f
};

struct Geodesic {
  Outcome outcome = Outcome::reached;
  const char* reason = "";  // why it stalled
  double length = 0.0;      // [sigma], last hop to R_f included
  long direct_steps = 0;    // accepted steps by kind; the last hop is none of them
  long contour_steps = 0;
  long escape_steps = 0;          // one for each return to V <= E_L + dV, however many iterations it took
  double participation = 0.0;     // mean of (sum_j dr_j^2)^2 / sum_j dr_j^4 weighted with step length, [G] Eq. 4.17
  double landscape_energy = 0.0;  // [epsilon], E_L
  std::vector<double> end;        // where it is: R_f where reached
};

/// Path from `start` to `finish` (3N each, unwrapped [sigma]) with V(R) <= E_L (contour) or V(R) <= E_L + dV (escape).
///
/// Contour makes one energy evaluation per trial, direct or contour, and one gradient evaluation per contour step
/// ([C] Algorithm 1). Never hangs: every loop has a cap, and no progress, a vanishing gradient or a direction without
/// a tangential part end in Outcome::stalled. Throws std::invalid_argument where sizes or the step do not fit.
Geodesic find_geodesic(const std::vector<double>& start, const std::vector<double>& finish, const Energy& energy,
                       const Gradient& gradient, Method method, const GeodesicOptions& options = {});

}  // namespace lanescape::reference
