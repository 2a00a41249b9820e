#pragma once

#include "reference/pair_forms.hpp"

/// A pair potential with its cutoff: what is done there, and what is left beyond it.
namespace lanescape::reference {

/// Below the cutoff r_c the potential is u(r) and what is said here; from there on it is zero.
enum class Truncation {
  shifted,        // - u(r_c)
  plain,          // nothing
  tail,           // nothing; the integrals over a uniform fluid beyond r_c are added to energy and virial
  shifted_force,  // - u(r_c) - (r - r_c) u'(r_c)
  smooth,         // + c_0 + c_2 r^2 + c_4 r^4, so that value, first and second derivative vanish at r_c
};

/// The potential of one pair of species.
struct PairPotential {
  PairForm form;
  double cutoff = unlimited;  // [sigma], an absolute distance; forms with a range of their own end there at the latest
  Truncation truncation = Truncation::shifted;
};

/// r_c [sigma]: the cutoff or the range of the form, whichever is less.
double cutoff(const PairPotential& potential);

/// u and its derivatives with the truncation, for r below the cutoff. Terms of the truncation count in the magnitudes.
PairValue value(const PairPotential& potential, double r);

/// Integrals from the cutoff to infinity of the untruncated potential.
struct TailIntegrals {
  double energy = 0.0;  // of r^2 u [epsilon sigma^3]
  double virial = 0.0;  // of r^2 (-r u')
};
/// Throws std::invalid_argument for integrals that do not exist (r^-n with n <= 3) and for the polydisperse form.
TailIntegrals tail_integrals(const PairPotential& potential);

/// Throws std::invalid_argument where sigma is not positive, the cutoff is not positive and finite, the form's own parameters are
/// not allowed, or the truncation is tail and there are no integrals.
void check(const PairPotential& potential);

/// The same potential for particles of these diameters; only the polydisperse form changes.
PairPotential between(const PairPotential& potential, double first_diameter, double second_diameter);

}  // namespace lanescape::reference
