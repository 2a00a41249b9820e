#include "configuration/pair_form.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "core/error.hpp"

namespace lanescape {
namespace {

using Coefficients = std::span<double, kernels::pair_coefficients>;

// 4 epsilon [(sigma/r)^12 - (sigma/r)^6]
PairForm lennard_jones() {
  PairForm form;
  form.word = "lennard-jones";
  form.kernel = kernels::PairForm::lennard_jones;
  form.derivatives = [](const PairNumbers& p, double r) -> PairDerivatives {
    const double s6 = std::pow(p.sigma, 6), rinv6 = std::pow(r, -6);
    const double c12 = 4.0 * p.epsilon * s6 * s6, c6 = 4.0 * p.epsilon * s6;
    return {(c12 * rinv6 - c6) * rinv6, -(12.0 * c12 * rinv6 - 6.0 * c6) * rinv6, (156.0 * c12 * rinv6 - 42.0 * c6) * rinv6};
  };
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

}  // namespace

std::span<const PairForm> pair_forms() {
  static const std::vector<PairForm> forms = {lennard_jones()};
  return forms;
}

const PairForm& pair_form(std::string_view word) {
  std::string words;
  for (const PairForm& form : pair_forms()) {
    if (word == form.word) return form;
    words += fmt::format("{}{}", words.empty() ? "" : ", ", form.word);
  }
  throw_bad_input(fmt::format("unknown pair potential '{}': allowed are {}", word, words));
}

const PairForm& lennard_jones_form() { return pair_forms().front(); }

}  // namespace lanescape
