#include "reference/pair_potential.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lanescape::reference {
namespace {

PairValue untruncated(const PairPotential& potential, double r) {
  return std::visit([r](const auto& form) { return form.at(r); }, potential.form);
}

/// What a truncation adds to u(r); `edge` is u at r_c.
PairValue correction(Truncation truncation, const PairValue& edge, double r_c, double r) {
  switch (truncation) {
    case Truncation::plain:
    case Truncation::tail:
      return {};
    case Truncation::shifted:
      return term(-edge.u, 0.0, 0.0);
    case Truncation::shifted_force:
      return term(-edge.u, 0.0, 0.0) + term(r_c * edge.slope, 0.0, 0.0) + term(-r * edge.slope, -edge.slope, 0.0);
    case Truncation::smooth: {
      // The solution of p = -u, p' = -u', p'' = -u'' at r_c for p = c_0 + c_2 r^2 + c_4 r^4.
      const double c_4 = (edge.slope / r_c - edge.curvature) / (8.0 * r_c * r_c);
      const double c_2 = (edge.curvature - 3.0 * edge.slope / r_c) / 4.0;
      const double c_0 = -edge.u + 5.0 / 8.0 * r_c * edge.slope - r_c * r_c * edge.curvature / 8.0;
      return term(c_0, 0.0, 0.0) + power(c_2, 1.0, -2.0, r) + power(c_4, 1.0, -4.0, r);
    }
  }
  throw std::invalid_argument("pair potential: unknown truncation");
}

}  // namespace

double cutoff(const PairPotential& potential) {
  return std::min(potential.cutoff, std::visit([](const auto& form) { return form.range(); }, potential.form));
}

PairValue value(const PairPotential& potential, double r) {
  const double r_c = cutoff(potential);
  return untruncated(potential, r) + correction(potential.truncation, untruncated(potential, r_c), r_c, r);
}

TailIntegrals tail_integrals(const PairPotential& potential) {
  const double r_c = cutoff(potential);
  const double energy = std::visit([r_c](const auto& form) { return form.tail(r_c); }, potential.form);
  // By parts: r^3 u vanishes at infinity, and at the end of a form with a range of its own.
  return {energy, std::pow(r_c, 3) * untruncated(potential, r_c).u + 3.0 * energy};
}

void check(const PairPotential& potential) {
  std::visit(
      [](const auto& form) {
        if (!(form.sigma > 0.0) || !std::isfinite(form.sigma))
          throw std::invalid_argument("pair potential: sigma must be positive and finite");
        form.check();
      },
      potential.form);
  const double r_c = cutoff(potential);
  if (!(r_c > 0.0) || !std::isfinite(r_c)) throw std::invalid_argument("pair potential: the cutoff must be positive and finite");
  if (potential.truncation == Truncation::tail) tail_integrals(potential);
}

PairPotential between(const PairPotential& potential, double first_diameter, double second_diameter) {
  const auto* form = std::get_if<Polydisperse>(&potential.form);
  return form ? PairPotential{form->between(first_diameter, second_diameter), potential.cutoff, potential.truncation} : potential;
}

}  // namespace lanescape::reference
