#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pair_forms.hpp"
#include "views/pair.hpp"

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

  kernels::PairCorrectionKind kind() const {
    if (c1 != 0.0) return kernels::PairCorrectionKind::linear;
    return c2 != 0.0 || c4 != 0.0 ? kernels::PairCorrectionKind::even : kernels::PairCorrectionKind::constant;
  }
};

// Integrals from the cutoff to infinity of r^2 u(r) and of -r^3 u'(r) [epsilon sigma^3].
struct PairTail {
  double energy, virial;
};

// A number of a form beside epsilon and sigma, the same for all pairs of a model.
struct FormNumber {
  const char* key;  // in model files
  double lowest, highest;
  bool even;                     // a whole, even number
  std::optional<double> preset;  // none: it has to be given
  bool per_length = false;       // in 1/sigma; else without a dimension
};

// The same potential as another form has it.
struct EquivalentForm {
  const char* word = nullptr;
  std::vector<double> numbers;
};

// A pair potential: its name, its numbers, u(r) as a scalar function, and what its kernels take. The scalar function serves
// parameters and constants; the kernels in kernels/forms/ do the sums.
struct PairForm {
  const char* word = "";                                        // kind in model files
  kernels::PairForm kernel = kernels::PairForm::lennard_jones;  // the loops over it
  std::vector<FormNumber> numbers;
  // Throws Error(bad_input) for numbers that do not go together.
  void (*check_numbers)(std::span<const double>) = nullptr;
  // The form is zero from here on, in units of sigma: this is its cutoff, and no other is allowed. Infinity: any cutoff is.
  double range = std::numeric_limits<double>::infinity();
  // Nearer than this u(r) has lost all meaning [sigma_ab].
  double smallest_separation = 0.3;
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
  // Whose kernels are taken with a truncation that is more than a shift, where its own know shifts only.
  EquivalentForm truncated_as{};
};

// All there are, Lennard-Jones first.
std::span<const PairForm> pair_forms();
// Their words, separated by commas.
std::string pair_form_words();
// Throws Error(bad_input) naming the words there are.
const PairForm& pair_form(std::string_view word);
const PairForm& lennard_jones_form();

}  // namespace lanescape
