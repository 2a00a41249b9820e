#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "configuration/mixture.hpp"

namespace lanescape {

// Which periodic images of a pair interact (docs/ARCHITECTURE.md, "Small boxes").
enum class ImageRule { all, minimum };
// Cut and shifted; cut; cut with long-range corrections.
enum class Truncation { shifted, plain, tail };

// Throw Error(bad_input) naming the allowed words.
ImageRule parse_image_rule(std::string_view word);
Truncation parse_truncation(std::string_view word);
const char* to_string(ImageRule rule);
const char* to_string(Truncation truncation);

// A Lennard-Jones mixture: u(r) = 4 eps_ab [(s_ab/r)^12 - (s_ab/r)^6], r < cutoff s_ab.
struct PairModel : Mixture {
  std::vector<double> epsilon;  // S x S, row-major, symmetric [epsilon]
  std::vector<double> sigma;    // S x S [sigma]
  double cutoff = 2.5;          // in units of s_ab
  Truncation truncation = Truncation::shifted;
  ImageRule images = ImageRule::all;

  std::size_t pair(std::size_t a, std::size_t b) const { return a * species.size() + b; }
  // Throws Error(bad_input) unless species are sound, sizes match, matrices are symmetric and every number is finite and in range.
  void check() const;
};

// Kob and Andersen's 80:20 mixture, doi 10.1103/PhysRevE.51.4626; A is written Ni and B is written P.
PairModel kob_andersen();
// One component, written Ar.
PairModel lennard_jones();
// "kob-andersen" or "lennard-jones"; anything else throws Error(bad_input) naming these.
PairModel named_pair_model(std::string_view name);

}  // namespace lanescape
