#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "pair_forms.hpp"
#include "views.hpp"

namespace lanescape {

// The numbers of one pair of species.
struct PairNumbers {
  double epsilon, sigma;         // [epsilon], [sigma]
  std::span<const double> form;  // those of the form, one for each of PairForm::numbers
};

// u(r), r u'(r) and r^2 u''(r) [epsilon].
struct PairDerivatives {
  double u, first, second;
};

// What a truncation adds to u(r) below the cutoff: c0 + c1 r + c2 r^2 + c4 r^4.
struct PairCorrection {
  double c0 = 0.0, c1 = 0.0, c2 = 0.0, c4 = 0.0;
};

// Integrals from the cutoff to infinity of r^2 u(r) and of -r^3 u'(r) [epsilon sigma^3].
struct PairTail {
  double energy, virial;
};

// A number of a form beside epsilon and sigma, the same for all pairs of a model.
struct FormNumber {
  const char* key;  // in model files
  double lowest, highest;
  bool even;      // a whole, even number
  double preset;  // NaN: has to be given
};

// A pair potential: its name, its numbers, u(r) as a scalar function, and what its kernels take. The scalar function serves
// parameters and constants; the kernels in kernels/forms/ do the sums.
struct PairForm {
  const char* word = "";                                        // kind in model files
  kernels::PairForm kernel = kernels::PairForm::lennard_jones;  // the loops over it
  std::vector<FormNumber> numbers;
  // The form ends at sigma: the cutoff is 1, in units of sigma.
  bool ends_at_sigma = false;
  // Particles have diameters of their own, which take the place of sigma.
  bool has_diameters = false;
  // Not truncated.
  PairDerivatives (*derivatives)(const PairNumbers&, double r) = nullptr;
  // The cutoff is in units of sigma. Null where the integrals do not exist or make no sense.
  PairTail (*tail)(const PairNumbers&, double cutoff) = nullptr;
  // Where the repulsion alone has this energy, which is above 0 [sigma].
  double (*repulsive_distance)(const PairNumbers&, double energy) = nullptr;
  // The form's coefficients for its kernel, lengths in a unit of so many sigma.
  void (*coefficients)(const PairNumbers&, const PairCorrection&, double unit,
                       std::span<double, kernels::pair_coefficients> out) = nullptr;
};

// All there are, Lennard-Jones first.
std::span<const PairForm> pair_forms();
// Throws Error(bad_input) naming the words there are.
const PairForm& pair_form(std::string_view word);
const PairForm& lennard_jones_form();

}  // namespace lanescape
