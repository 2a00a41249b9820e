#include "configuration/pair_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "core/error.hpp"

namespace lanescape {
namespace {

using Coefficients = std::span<double, kernels::pair_coefficients>;

// 4 epsilon [(sigma/r)^12 - (sigma/r)^6]
PairForm twelve_six() {
  PairForm form;
  form.word = "lennard-jones";
  form.kernel = kernels::PairForm::lennard_jones;
  form.derivatives = [](const PairNumbers& p, double r) -> PairDerivatives {
    const double s6 = std::pow(p.sigma, 6), rinv6 = std::pow(r, -6);
    const double c12 = 4.0 * p.epsilon * s6 * s6, c6 = 4.0 * p.epsilon * s6;
    return {(c12 * rinv6 - c6) * rinv6, -(12.0 * c12 * rinv6 - 6.0 * c6) * rinv6, (156.0 * c12 * rinv6 - 42.0 * c6) * rinv6};
  };
  form.truncated_as = {"lennard-jones-12-6-4", {0.0}};
  form.tail = [](const PairNumbers& p, double cutoff) -> PairTail {
    const double x3 = std::pow(cutoff, -3), x9 = x3 * x3 * x3, scale = 4.0 * p.epsilon * p.sigma * p.sigma * p.sigma;
    return {scale * (x9 / 9.0 - x3 / 3.0), scale * (12.0 * x9 / 9.0 - 6.0 * x3 / 3.0)};
  };
  form.repulsive_distance = [](const PairNumbers& p, double energy) {
    const double s6 = std::pow(p.sigma, 6);
    return std::pow(4.0 * p.epsilon * s6 * s6 / energy, 1.0 / 12.0);
  };
  form.coefficients = [](const PairNumbers& p, const PairCorrection& correction, double unit, Coefficients out) {
    const double s6 = std::pow(p.sigma, 6);
    out[0] = 4.0 * p.epsilon * s6 * s6 * std::pow(unit, -12);
    out[1] = 4.0 * p.epsilon * s6 * std::pow(unit, -6);
    out[2] = -correction.c0;
    out[3] = 12.0 * out[0];
    out[4] = -6.0 * out[1];
  };
  return form;
}

// The coefficients of a truncation, the first four of a form that takes any; lengths in `unit`.
void put_correction(const PairCorrection& c, double unit, Coefficients out) {
  out[0] = c.c0;
  out[1] = c.c1 * unit;
  out[2] = c.c2 * unit * unit;
  out[3] = c.c4 * unit * unit * unit * unit;
}

// a (sigma/r)^n - b (sigma/r)^m; of a single power b is 0, and m any even number up to n.
struct TwoPowers {
  double a, n, b, m;

  PairDerivatives at(double sigma_over_r) const {
    const double repulsion = a * std::pow(sigma_over_r, n), attraction = b * std::pow(sigma_over_r, m);
    return {repulsion - attraction, m * attraction - n * repulsion, n * (n + 1.0) * repulsion - m * (m + 1.0) * attraction};
  }
  // Infinite where an integral does not exist.
  PairTail tail(double sigma, double x) const {
    if (n <= 3.0 || (b != 0.0 && m <= 3.0)) return {std::numeric_limits<double>::infinity(), 0.0};
    const double repulsion = a * std::pow(x, 3.0 - n) / (n - 3.0), attraction = b * std::pow(x, 3.0 - m) / (m - 3.0);
    const double volume = sigma * sigma * sigma;
    return {volume * (repulsion - attraction), volume * (n * repulsion - m * attraction)};
  }
  void put(double sigma, const PairCorrection& correction, double unit, Coefficients out) const {
    put_correction(correction, unit, out);
    const double own[] = {a, b, m / 2.0, (n - m) / 2.0, (sigma / unit) * (sigma / unit)};
    std::copy(std::begin(own), std::end(own), out.begin() + 4);
  }
};

// C epsilon [(sigma/r)^n - (sigma/r)^m], C = n/(n - m) (n/m)^(m/(n - m)), so that the minimum is -epsilon.
TwoPowers mie_powers(const PairNumbers& p) {
  const double n = p.form[0], m = p.form[1], c = n / (n - m) * std::pow(n / m, m / (n - m)) * p.epsilon;
  return {c, n, c, m};
}

PairForm mie() {
  PairForm form;
  form.word = "mie";
  form.kernel = kernels::PairForm::even_powers;
  form.numbers = {{"repulsive_exponent", 4, 64, true, 12}, {"attractive_exponent", 2, 62, true, 6}};
  form.check_numbers = [](std::span<const double> numbers) {
    if (numbers[0] <= numbers[1])
      throw_bad_input(fmt::format("repulsive_exponent {} is not allowed: more than attractive_exponent, {}, is needed", numbers[0],
                                  numbers[1]));
  };
  form.derivatives = [](const PairNumbers& p, double r) { return mie_powers(p).at(p.sigma / r); };
  form.tail = [](const PairNumbers& p, double x) { return mie_powers(p).tail(p.sigma, x); };
  form.repulsive_distance = [](const PairNumbers& p, double energy) {
    return p.sigma * std::pow(mie_powers(p).a / energy, 1.0 / p.form[0]);
  };
  form.coefficients = [](const PairNumbers& p, const PairCorrection& correction, double unit, Coefficients out) {
    mie_powers(p).put(p.sigma, correction, unit, out);
  };
  return form;
}

// epsilon (sigma/r)^n: in the kernel the product of two powers that are about equal.
TwoPowers single_power(const PairNumbers& p) { return {p.epsilon, p.form[0], 0.0, 2.0 * std::floor(p.form[0] / 4.0)}; }

PairForm inverse_power() {
  PairForm form;
  form.word = "inverse-power";
  form.kernel = kernels::PairForm::even_powers;
  form.numbers = {{"exponent", 2, 64, true, 12}};
  form.derivatives = [](const PairNumbers& p, double r) { return single_power(p).at(p.sigma / r); };
  form.tail = [](const PairNumbers& p, double x) { return single_power(p).tail(p.sigma, x); };
  form.repulsive_distance = [](const PairNumbers& p, double energy) {
    return p.sigma * std::pow(p.epsilon / energy, 1.0 / p.form[0]);
  };
  form.coefficients = [](const PairNumbers& p, const PairCorrection& correction, double unit, Coefficients out) {
    single_power(p).put(p.sigma, correction, unit, out);
  };
  return form;
}

// epsilon (sigma/r) exp(-kappa (r - sigma))
PairForm yukawa() {
  PairForm form;
  form.word = "yukawa";
  form.kernel = kernels::PairForm::yukawa;
  form.numbers = {{"kappa", 1e-30, 1e30, false, {}, true}};
  form.derivatives = [](const PairNumbers& p, double r) -> PairDerivatives {
    const double x = p.form[0] * r, u = p.epsilon * p.sigma / r * std::exp(p.form[0] * (p.sigma - r));
    return {u, -u * (1.0 + x), u * (2.0 + 2.0 * x + x * x)};
  };
  form.tail = [](const PairNumbers& p, double x) -> PairTail {
    const double kappa = p.form[0], rc = x * p.sigma, at_cutoff = p.epsilon * p.sigma * std::exp(kappa * (p.sigma - rc));
    const double energy = at_cutoff * (rc / kappa + 1.0 / (kappa * kappa));
    return {energy, at_cutoff * rc * rc + 3.0 * energy};
  };
  // Newton's method for ln u(r) = ln energy, which is concave in ln r.
  form.repulsive_distance = [](const PairNumbers& p, double energy) {
    const double kappa = p.form[0];
    double r = p.sigma;
    for (int k = 0; k < 200; ++k) {
      const double error = std::log(p.epsilon * p.sigma / (r * energy)) + kappa * (p.sigma - r);
      const double next = r * std::exp(error / (1.0 + kappa * r));
      if (std::abs(next - r) <= 1e-14 * r) break;
      r = next;
    }
    return r;
  };
  form.coefficients = [](const PairNumbers& p, const PairCorrection& correction, double unit, Coefficients out) {
    put_correction(correction, unit, out);
    out[4] = p.epsilon * p.sigma / unit;
    out[5] = p.form[0] * unit;
    out[6] = p.form[0] * p.sigma;
  };
  return form;
}

// (epsilon/alpha) (1 - r/sigma)^alpha below sigma: harmonic spheres (alpha = 2), Hertzian ones (5/2).
template <int twice_alpha>
PairForm soft_sphere(const char* word) {
  constexpr double alpha = 0.5 * twice_alpha;
  PairForm form;
  form.word = word;
  form.kernel = kernels::PairForm::soft_sphere;
  form.range = 1.0;
  form.smallest_separation = 0.0;
  form.derivatives = [](const PairNumbers& p, double r) -> PairDerivatives {
    const double x = r / p.sigma, depth = 1.0 - x;
    return {p.epsilon / alpha * std::pow(depth, alpha), -p.epsilon * x * std::pow(depth, alpha - 1.0),
            p.epsilon * (alpha - 1.0) * x * x * std::pow(depth, alpha - 2.0)};
  };
  form.tail = [](const PairNumbers&, double) -> PairTail { return {0.0, 0.0}; };
  form.repulsive_distance = [](const PairNumbers& p, double energy) {
    return p.sigma * std::max(0.0, 1.0 - std::pow(alpha * energy / p.epsilon, 1.0 / alpha));
  };
  form.coefficients = [](const PairNumbers& p, const PairCorrection& correction, double unit, Coefficients out) {
    put_correction(correction, unit, out);
    out[4] = p.epsilon / alpha;
    out[5] = unit / p.sigma;
    out[6] = twice_alpha == 5 ? 1.0 : 0.0;
  };
  return form;
}

// 4 epsilon [(sigma/r)^12 - (sigma/r)^6 - c4 (sigma/r)^4]: ions that polarise their neighbours.
PairForm twelve_six_four() {
  PairForm form;
  form.word = "lennard-jones-12-6-4";
  form.kernel = kernels::PairForm::twelve_six_four;
  form.numbers = {{"c4", -10.0, 10.0, false, 0.25}};
  form.derivatives = [](const PairNumbers& p, double r) -> PairDerivatives {
    const double x2 = p.sigma * p.sigma / (r * r), fourth = p.form[0] * x2 * x2, sixth = x2 * x2 * x2, a = 4.0 * p.epsilon;
    return {a * (sixth * sixth - sixth - fourth), a * (-12.0 * sixth * sixth + 6.0 * sixth + 4.0 * fourth),
            a * (156.0 * sixth * sixth - 42.0 * sixth - 20.0 * fourth)};
  };
  form.tail = [](const PairNumbers& p, double x) -> PairTail {
    const double x9 = std::pow(x, -9), x3 = std::pow(x, -3), x1 = p.form[0] / x, scale = 4.0 * p.epsilon * std::pow(p.sigma, 3);
    return {scale * (x9 / 9.0 - x3 / 3.0 - x1), scale * (12.0 * x9 / 9.0 - 6.0 * x3 / 3.0 - 4.0 * x1)};
  };
  form.repulsive_distance = [](const PairNumbers& p, double energy) {
    return p.sigma * std::pow(4.0 * p.epsilon / energy, 1.0 / 12.0);
  };
  form.coefficients = [](const PairNumbers& p, const PairCorrection& correction, double unit, Coefficients out) {
    put_correction(correction, unit, out);
    out[4] = 4.0 * p.epsilon;
    out[5] = p.form[0];
    out[6] = (p.sigma / unit) * (p.sigma / unit);
  };
  return form;
}

// epsilon [x^-12 + c0 + c2 x^2 + c4 x^4], x = r/sigma_ij below 1.25, where value, slope and curvature vanish. Diameters of
// particles are in units of the model's sigma.
PairForm polydisperse() {
  static constexpr double range = 1.25;
  PairForm form;
  form.word = "polydisperse";
  form.kernel = kernels::PairForm::polydisperse;
  form.numbers = {{"non_additivity", 0.0, 1.0, false, 0.2, true}};
  form.range = range;
  form.has_diameters = true;
  static const double c0 = -28.0 * std::pow(range, -12), c2 = 48.0 * std::pow(range, -14), c4 = -21.0 * std::pow(range, -16);
  form.derivatives = [](const PairNumbers& p, double r) -> PairDerivatives {
    const double x2 = r * r / (p.sigma * p.sigma), x4 = x2 * x2, repulsion = 1.0 / (x4 * x4 * x4);
    return {p.epsilon * (repulsion + c0 + c2 * x2 + c4 * x4), p.epsilon * (-12.0 * repulsion + 2.0 * c2 * x2 + 4.0 * c4 * x4),
            p.epsilon * (156.0 * repulsion + 2.0 * c2 * x2 + 12.0 * c4 * x4)};
  };
  form.repulsive_distance = [](const PairNumbers& p, double energy) { return p.sigma * std::pow(p.epsilon / energy, 1.0 / 12.0); };
  form.coefficients = [](const PairNumbers& p, const PairCorrection& correction, double unit, Coefficients out) {
    put_correction(correction, unit, out);
    const double own[] = {p.epsilon, c0, c2, c4, p.form[0] * unit, range * range};
    std::copy(std::begin(own), std::end(own), out.begin() + 4);
  };
  return form;
}

}  // namespace

std::span<const PairForm> pair_forms() {
  static const std::vector<PairForm> forms = {
      twelve_six(),     mie(), inverse_power(), yukawa(), soft_sphere<4>("harmonic"), soft_sphere<5>("hertzian"), polydisperse(),
      twelve_six_four()};
  return forms;
}

std::string pair_form_words() {
  std::string words;
  for (const PairForm& form : pair_forms()) words += fmt::format("{}{}", words.empty() ? "" : ", ", form.word);
  return words;
}

const PairForm& pair_form(std::string_view word) {
  for (const PairForm& form : pair_forms())
    if (word == form.word) return form;
  throw_bad_input(fmt::format("unknown pair potential '{}': allowed are {}", word, pair_form_words()));
}

const PairForm& lennard_jones_form() { return pair_forms().front(); }

}  // namespace lanescape
