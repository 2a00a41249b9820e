#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

/// Pair potentials without truncation, one struct each, written from the formulas.
///
/// To add a form: a struct with the members of LennardJones, its name in PairForm and its line in pair_form().
namespace lanescape::reference {

/// u(r) and its derivatives, and what rounding in them scales with.
struct PairValue {
  double u = 0.0;          // [epsilon]
  double slope = 0.0;      // [epsilon/sigma], du/dr
  double curvature = 0.0;  // [epsilon/sigma^2]
  // The same with every term taken absolute. Times the machine epsilon this is the error of a careful evaluation, up to a factor
  // that grows with the exponents.
  double u_magnitude = 0.0;
  double slope_magnitude = 0.0;

  PairValue& operator+=(const PairValue& other) {
    u += other.u;
    slope += other.slope;
    curvature += other.curvature;
    u_magnitude += other.u_magnitude;
    slope_magnitude += other.slope_magnitude;
    return *this;
  }
  friend PairValue operator+(PairValue a, const PairValue& b) { return a += b; }
};

/// A term whose rounding error is relative to itself.
inline PairValue term(double u, double slope, double curvature) { return {u, slope, curvature, std::abs(u), std::abs(slope)}; }

/// factor (sigma/r)^n; n may be negative.
inline PairValue power(double factor, double sigma, double n, double r) {
  const double u = factor * std::pow(sigma / r, n);
  return term(u, -n * u / r, n * (n + 1.0) * u / (r * r));
}

/// Integral of r^2 factor (sigma/r)^n from r_c to infinity; n > 3.
inline double power_tail(double factor, double sigma, double n, double r_c) {
  if (!(n > 3.0)) throw std::invalid_argument("pair potential: the long-range integral of r^-n needs n > 3");
  return factor * std::pow(sigma / r_c, n) * std::pow(r_c, 3) / (n - 3.0);
}

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// 4 epsilon [(sigma/r)^12 - (sigma/r)^6]
struct LennardJones {
  double epsilon = 1.0;  // [epsilon]
  double sigma = 1.0;    // [sigma]

  PairValue at(double r) const { return power(4.0 * epsilon, sigma, 12.0, r) + power(-4.0 * epsilon, sigma, 6.0, r); }
  /// The potential is zero from here on [sigma].
  double range() const { return unlimited; }
  /// Integral of r^2 u from r_c to infinity [epsilon sigma^3].
  double tail(double r_c) const {
    return power_tail(4.0 * epsilon, sigma, 12.0, r_c) + power_tail(-4.0 * epsilon, sigma, 6.0, r_c);
  }
  /// Throws std::invalid_argument for parameters that are not allowed; sigma is checked elsewhere.
  void check() const {}
};

/// C epsilon [(sigma/r)^n - (sigma/r)^m], C = n/(n-m) (n/m)^(m/(n-m)), so that the minimum is -epsilon; n > m >= 2, even.
struct Mie {
  double epsilon = 1.0;
  double sigma = 1.0;
  int n = 12;
  int m = 6;

  double factor() const {
    const double repulsive = n, attractive = m, difference = n - m;
    return repulsive / difference * std::pow(repulsive / attractive, attractive / difference) * epsilon;
  }
  PairValue at(double r) const { return power(factor(), sigma, n, r) + power(-factor(), sigma, m, r); }
  double range() const { return unlimited; }
  double tail(double r_c) const { return power_tail(factor(), sigma, n, r_c) + power_tail(-factor(), sigma, m, r_c); }
  void check() const {
    if (m < 2 || n <= m || m % 2 != 0 || n % 2 != 0) throw std::invalid_argument("mie: n > m >= 2 and both even are needed");
  }
};

/// epsilon (sigma/r)^n, n an even integer from 2 to 64
struct InversePower {
  double epsilon = 1.0;
  double sigma = 1.0;
  int n = 12;

  PairValue at(double r) const { return power(epsilon, sigma, n, r); }
  double range() const { return unlimited; }
  double tail(double r_c) const { return power_tail(epsilon, sigma, n, r_c); }
  void check() const {
    if (n < 2 || n > 64 || n % 2 != 0) throw std::invalid_argument("inverse power: n must be even and from 2 to 64");
  }
};

/// epsilon (sigma/r) exp(-kappa (r - sigma))
struct Yukawa {
  double epsilon = 1.0;
  double sigma = 1.0;
  double kappa = 1.0;  // [1/sigma]

  PairValue at(double r) const {
    const double u = epsilon * sigma / r * std::exp(-kappa * (r - sigma));
    const double slope = -u * (1.0 / r + kappa);
    const double curvature = u * (2.0 / (r * r) + 2.0 * kappa / r + kappa * kappa);
    // Rounding of the exponent, of relative size 1, is an error of kappa r in exp.
    const double exponent = 1.0 + kappa * r;
    return {u, slope, curvature, std::abs(u) * exponent, std::abs(slope) * exponent};
  }
  double range() const { return unlimited; }
  double tail(double r_c) const {
    return epsilon * sigma * std::exp(-kappa * (r_c - sigma)) * (r_c / kappa + 1.0 / (kappa * kappa));
  }
  void check() const {
    if (!(kappa > 0.0) || !std::isfinite(kappa)) throw std::invalid_argument("yukawa: kappa must be positive and finite");
  }
};

/// factor (1 - r/sigma)^alpha below sigma. Rounding of r/sigma, of relative size 1, is an error of r/sigma in the difference.
inline PairValue overlap(double factor, double sigma, double alpha, double r) {
  const double x = r / sigma, depth = 1.0 - x;
  const double slope = -alpha * factor / sigma * std::pow(depth, alpha - 1.0);
  const double curvature = alpha * (alpha - 1.0) * factor / (sigma * sigma) * std::pow(depth, alpha - 2.0);
  const double u = factor * std::pow(depth, alpha);
  return {u, slope, curvature, std::abs(u) + r * std::abs(slope), std::abs(slope) + r * std::abs(curvature)};
}

/// The long-range integral of a potential that ends at sigma.
inline double overlap_tail(double sigma, double r_c) {
  if (r_c < sigma) throw std::invalid_argument("pair potential: long-range corrections need the whole range of the potential");
  return 0.0;
}

/// (epsilon/2) (1 - r/sigma)^2 below sigma
struct Harmonic {
  double epsilon = 1.0;
  double sigma = 1.0;

  PairValue at(double r) const { return overlap(epsilon / 2.0, sigma, 2.0, r); }
  double range() const { return sigma; }
  double tail(double r_c) const { return overlap_tail(sigma, r_c); }
  void check() const {}
};

/// (2 epsilon/5) (1 - r/sigma)^(5/2) below sigma
struct Hertzian {
  double epsilon = 1.0;
  double sigma = 1.0;

  PairValue at(double r) const { return overlap(2.0 * epsilon / 5.0, sigma, 2.5, r); }
  double range() const { return sigma; }
  double tail(double r_c) const { return overlap_tail(sigma, r_c); }
  void check() const {}
};

/// epsilon [(sigma/r)^12 + c_0 + c_2 (r/sigma)^2 + c_4 (r/sigma)^4] below 1.25 sigma, where value, first and second derivative
/// vanish. sigma is (sigma_i + sigma_j)/2 (1 - non_additivity |sigma_i - sigma_j|), sigma_i the diameter of particle i.
/// Ninarello, Berthier and Coslovich, doi 10.1103/PhysRevX.7.021039.
struct Polydisperse {
  static constexpr double x_c = 1.25;
  double epsilon = 1.0;
  double sigma = 1.0;           // of one pair of particles
  double non_additivity = 0.2;  // [1/sigma]

  PairValue at(double r) const {
    const double c_0 = -28.0 / std::pow(x_c, 12), c_2 = 48.0 / std::pow(x_c, 14), c_4 = -21.0 / std::pow(x_c, 16);
    return power(epsilon, sigma, 12.0, r) + term(epsilon * c_0, 0.0, 0.0) + power(epsilon * c_2, sigma, -2.0, r) +
           power(epsilon * c_4, sigma, -4.0, r);
  }
  double range() const { return x_c * sigma; }
  [[noreturn]] double tail(double) const { throw std::invalid_argument("polydisperse: there are no long-range corrections"); }
  void check() const {
    if (!(non_additivity >= 0.0)) throw std::invalid_argument("polydisperse: non-additivity must not be negative");
  }

  /// The same for a pair of particles of these diameters [sigma].
  Polydisperse between(double first, double second) const {
    return {epsilon, 0.5 * (first + second) * (1.0 - non_additivity * std::abs(first - second)), non_additivity};
  }
};

/// 4 epsilon [(sigma/r)^12 - (sigma/r)^6 - c4 (sigma/r)^4]
struct TwelveSixFour {
  double epsilon = 1.0;
  double sigma = 1.0;
  double c4 = 0.25;

  PairValue at(double r) const {
    return power(4.0 * epsilon, sigma, 12.0, r) + power(-4.0 * epsilon, sigma, 6.0, r) + power(-4.0 * epsilon * c4, sigma, 4.0, r);
  }
  double range() const { return unlimited; }
  double tail(double r_c) const {
    return power_tail(4.0 * epsilon, sigma, 12.0, r_c) + power_tail(-4.0 * epsilon, sigma, 6.0, r_c) +
           power_tail(-4.0 * epsilon * c4, sigma, 4.0, r_c);
  }
  void check() const {}
};

using PairForm = std::variant<LennardJones, Mie, InversePower, Yukawa, Harmonic, Hertzian, Polydisperse, TwelveSixFour>;

/// The form of a name with its numbers beside epsilon and sigma, in the order in which model files have them (docs/FORMATS.md). Throws
/// std::invalid_argument for a name that is not here.
inline PairForm pair_form(std::string_view name, double epsilon, double sigma, std::span<const double> numbers) {
  const auto whole = [&](std::size_t k) { return static_cast<int>(numbers[k]); };
  if (name == "lennard-jones") return LennardJones{epsilon, sigma};
  if (name == "mie") return Mie{epsilon, sigma, whole(0), whole(1)};
  if (name == "inverse-power") return InversePower{epsilon, sigma, whole(0)};
  if (name == "yukawa") return Yukawa{epsilon, sigma, numbers[0]};
  if (name == "harmonic") return Harmonic{epsilon, sigma};
  if (name == "hertzian") return Hertzian{epsilon, sigma};
  if (name == "lennard-jones-12-6-4") return TwelveSixFour{epsilon, sigma, numbers[0]};
  if (name == "polydisperse") return Polydisperse{epsilon, sigma, numbers[0]};
  throw std::invalid_argument("the reference has no pair potential '" + std::string(name) + "'");
}

}  // namespace lanescape::reference
