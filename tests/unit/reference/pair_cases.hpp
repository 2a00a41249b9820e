#pragma once

#include <string>
#include <vector>

#include "reference/pair_potential.hpp"

/// What the tests of pair potentials go through: every form and every truncation.
namespace lanescape::reference {

struct NamedForm {
  std::string name;
  PairForm form;
  double cutoff;  // [sigma]
};

inline std::vector<NamedForm> all_forms() {
  return {{"lennard_jones", LennardJones{1.5, 0.8}, 2.0},
          {"mie 12 6", Mie{0.7, 1.1, 12, 6}, 2.5},
          {"mie 36 4", Mie{1.0, 1.0, 36, 4}, 2.5},
          {"mie 8 2", Mie{1.3, 0.9, 8, 2}, 3.0},
          {"inverse_power 2", InversePower{1.0, 1.2, 2}, 2.2},
          {"inverse_power 12", InversePower{0.9, 1.2, 12}, 1.5},
          {"inverse_power 64", InversePower{1.0, 1.0, 64}, 1.3},
          {"12-6-4", TwelveSixFour{1.3, 0.9, 0.4}, 2.2},
          {"yukawa", Yukawa{2.0, 0.9, 1.7}, 3.0},
          {"harmonic", Harmonic{1.8, 1.1}, unlimited},
          {"hertzian", Hertzian{1.8, 0.9}, unlimited},
          {"polydisperse", Polydisperse{1.2, 0.95}, unlimited}};
}

inline constexpr Truncation kAllTruncations[] = {Truncation::shifted, Truncation::plain, Truncation::tail,
                                                 Truncation::shifted_force, Truncation::smooth};

/// Whether the form has long-range integrals.
inline bool has_tail(const NamedForm& form) {
  return form.name != "mie 8 2" && form.name != "inverse_power 2" && form.name != "polydisperse";
}

/// Calls visit(potential, description) for each form with each truncation that it can have.
template <class Visit>
void for_each_potential(const Visit& visit) {
  for (const NamedForm& form : all_forms())
    for (const Truncation truncation : kAllTruncations)
      if (truncation != Truncation::tail || has_tail(form))
        visit(PairPotential{form.form, form.cutoff, truncation}, form.name + ", truncation " + std::to_string(int(truncation)));
}

/// Five-point difference of f at 0: error h^4 f^(5)/30 from truncation, about 1e-16 f/h from rounding.
template <class Function>
double derivative(const Function& f, double h) {
  return (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
}

}  // namespace lanescape::reference
