#include "reference/geodesic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reference/path_sum.hpp"

namespace lanescape::reference {
namespace {

class Finder {
 public:
  Finder(const Point& start, const Point& finish, const Energy& energy, const Gradient& gradient, Method method,
         const GeodesicOptions& options)
      : start_(start), finish_(finish), energy_(energy), gradient_(gradient), method_(method), options_(options) {}

  Geodesic run() {
    path_.landscape_energy = options_.landscape_energy ? *options_.landscape_energy : std::max(energy_(start_), energy_(finish_));
    allowed_ = path_.landscape_energy + (method_ == Method::escape ? options_.energy_tolerance : 0.0);
    path_.end = start_;
    double nearest = std::numeric_limits<double>::infinity();
    long since_nearest = 0;
    for (;;) {
      const Point to_finish = combine(finish_, -1.0, path_.end);
      const double distance = std::sqrt(dot(to_finish, to_finish));
      if (distance < options_.step) break;
      if (distance < nearest - 1e-6 * options_.step) {  // a decrease by rounding is no progress
        nearest = distance;
        since_nearest = 0;
      } else if (++since_nearest >= options_.patience) {
        return stop(Outcome::stalled, "no progress towards the end point");
      }
      if (path_.direct_steps + path_.contour_steps + path_.escape_steps >= options_.max_steps) return stop(Outcome::step_limit, "");

      const Point d = combine(Point(to_finish.size(), 0.0), 1.0 / distance, to_finish);
      Point trial = combine(path_.end, options_.step, d);  // [G] Eq. 3.10, [C] Eq. 1
      const double trial_energy = energy_(trial);
      long* steps = &path_.direct_steps;
      if (!(trial_energy <= allowed_)) {
        steps = method_ == Method::contour ? &path_.contour_steps : &path_.escape_steps;
        const char* failure = method_ == Method::contour ? contour(d, trial) : escape(trial_energy, trial);
        if (failure != nullptr) return stop(Outcome::stalled, failure);
      }
      advance(trial);
      ++*steps;
    }
    advance(finish_);
    return stop(Outcome::reached, "");
  }

 private:
  /// A step along the level set of V through the retreat point, [C] Eqs. 4-7, 11-15. Null, or why there is no step.
  const char* contour(const Point& d, Point& trial) {
    Point n(d.size());
    gradient_(path_.end, n);
    const double norm = std::sqrt(dot(n, n));
    if (!(norm > 0.0) || !std::isfinite(norm)) return "the gradient is zero or not finite";
    for (double& component : n) component /= norm;
    const Point f = combine(d, -dot(d, n), n);
    const double f_norm = std::sqrt(dot(f, f));
    if (f_norm < 1e-12) return "the direction to the end point is parallel to the gradient";  // rounding of |d| = 1
    const Point tangent = combine(path_.end, options_.step / f_norm, f);
    for (long k = 0; k < options_.max_inner; ++k) {
      trial = combine(tangent, -options_.contour_retreat * static_cast<double>(k), n);
      if (energy_(trial) <= allowed_) return nullptr;
    }
    return "no contour trial is allowed";
  }

  /// Newton steps towards V = E_L until V <= E_L + dV, [G] Eq. 3.11. Null, or why there is no step.
  const char* escape(double trial_energy, Point& trial) {
    Point gradient(trial.size());
    for (long k = 0; k < options_.max_inner; ++k) {
      gradient_(trial, gradient);
      const double squared = dot(gradient, gradient);
      if (!(squared > 0.0) || !std::isfinite(squared)) return "the gradient is zero or not finite";
      trial = combine(trial, -(trial_energy - path_.landscape_energy) / squared, gradient);
      trial_energy = energy_(trial);
      if (trial_energy <= allowed_) return nullptr;
    }
    return "the escape does not return to the allowed region";
  }

  void advance(const Point& next) {
    sum_.add(combine(next, -1.0, path_.end));
    path_.end = next;
    if (path_.accepted.size() < options_.record) path_.accepted.push_back(next);
  }

  Geodesic stop(Outcome outcome, const char* reason) {
    path_.outcome = outcome;
    path_.reason = reason;
    path_.length = sum_.length();
    path_.participation = sum_.participation();
    return path_;
  }

  const Point& start_;
  const Point& finish_;
  const Energy& energy_;
  const Gradient& gradient_;
  Method method_;
  GeodesicOptions options_;
  Geodesic path_;
  double allowed_ = 0.0;  // [epsilon], a configuration up to this energy is accepted
  PathSum sum_;
};

}  // namespace

Geodesic find_geodesic(const std::vector<double>& start, const std::vector<double>& finish, const Energy& energy,
                       const Gradient& gradient, Method method, const GeodesicOptions& options) {
  if (start.size() != finish.size() || start.size() % 3 != 0)
    throw std::invalid_argument("find_geodesic: both ends need the same number of coordinates, three per particle");
  if (!(options.step > 0.0)) throw std::invalid_argument("find_geodesic: the step must be positive");
  return Finder(start, finish, energy, gradient, method, options).run();
}

}  // namespace lanescape::reference
