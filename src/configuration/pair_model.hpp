#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "configuration/mixture.hpp"
#include "configuration/pair_form.hpp"

namespace lanescape {

// Which periodic images of a pair interact (src/interaction/README.md, "Small boxes").
enum class ImageRule { all, minimum };
// How u(r) ends at the cutoff.
enum class Truncation {
  shifted,        // u(r) - u(rc)
  plain,          // u(r)
  tail,           // u(r), and the integral over a uniform fluid beyond the cutoff
  shifted_force,  // u(r) - u(rc) - (r - rc) u'(rc)
  smooth          // u(r) + c0 + c2 r^2 + c4 r^4: value, slope and curvature vanish at the cutoff
};

// Throw Error(bad_input) naming the allowed words.
ImageRule parse_image_rule(std::string_view word);
Truncation parse_truncation(std::string_view word);
const char* to_string(ImageRule rule);
const char* to_string(Truncation truncation);

// A mixture with a pair potential of one form, for each two species with an epsilon and a sigma of their own.
struct PairModel : Mixture {
  const PairForm* form = &lennard_jones_form();
  std::vector<double> form_numbers;  // one for each of form->numbers
  std::vector<double> epsilon;       // S x S, row-major, symmetric [epsilon]
  std::vector<double> sigma;         // S x S [sigma]
  double cutoff = 2.5;               // in units of s_ab
  Truncation truncation = Truncation::shifted;
  ImageRule images = ImageRule::all;

  std::size_t pair(std::size_t a, std::size_t b) const { return a * species.size() + b; }
  PairNumbers numbers(std::size_t ab) const { return {epsilon[ab], sigma[ab], form_numbers}; }
  double cutoff_of(std::size_t ab) const { return cutoff * sigma[ab]; }  // [sigma]
  double largest_cutoff() const;                                         // of all pairs [sigma]
  // The largest sigma, or this diameter of the largest particle where particles have diameters of their own [sigma].
  double largest_size(double largest_diameter = 1.0) const;
  // The unit of length for its particles, likewise [sigma].
  double length_unit(double largest_diameter = 1.0) const;
  // What the truncation adds to u(r) of a pair of species.
  PairCorrection correction(const PairNumbers& numbers) const;
  // The form whose kernels sum it up, and its numbers: `form` and form_numbers, but for some truncations.
  const PairForm& kernel_form() const;
  std::span<const double> kernel_numbers() const;
  // The same model with lengths in another unit. Diameters of particles, where the form has them, change with it.
  PairModel in_unit(double unit) const;
  // Of the truncated potential, below the cutoff.
  PairDerivatives derivatives(const PairNumbers& numbers, double r) const;
  // Throws Error(bad_input) unless species are sound, sizes match, matrices are symmetric and every number is finite and in range.
  void check() const;

 private:
  void check_form() const;
  void check_range(const std::string& pair, double epsilon, double sigma) const;
  void check_truncation() const;
};

// Kob and Andersen's 80:20 mixture, doi 10.1103/PhysRevE.51.4626; A is written Ni and B is written P.
PairModel kob_andersen();
// One component, written Ar.
PairModel lennard_jones();
// Lennard-Jones cut and shifted at its minimum, doi 10.1063/1.1674820; written Ar.
PairModel wca();
// Wahnstrom's 50:50 mixture, doi 10.1103/PhysRevA.44.3752: A is twice as heavy as B, whose sigma is 5/6; written Ni and P.
PairModel wahnstrom();
// A form with its preset numbers, epsilon = sigma = 1; written Ar. Throws Error(bad_input) where a number has no preset.
PairModel one_component(const PairForm& form);
// "kob-andersen" or "lennard-jones"; anything else throws Error(bad_input) naming these.
PairModel named_pair_model(std::string_view name);

}  // namespace lanescape
