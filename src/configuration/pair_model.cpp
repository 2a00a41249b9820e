#include "configuration/pair_model.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace lanescape {

ImageRule parse_image_rule(std::string_view word) {
  if (word == "all") return ImageRule::all;
  if (word == "minimum") return ImageRule::minimum;
  throw_bad_input(fmt::format("unknown image rule '{}': allowed are all, minimum", word));
}

Truncation parse_truncation(std::string_view word) {
  if (word == "shifted") return Truncation::shifted;
  if (word == "plain") return Truncation::plain;
  if (word == "tail") return Truncation::tail;
  throw_bad_input(fmt::format("unknown truncation '{}': allowed are shifted, plain, tail", word));
}

const char* to_string(ImageRule rule) { return rule == ImageRule::all ? "all" : "minimum"; }

const char* to_string(Truncation truncation) {
  switch (truncation) {
    case Truncation::shifted:
      return "shifted";
    case Truncation::plain:
      return "plain";
    case Truncation::tail:
      return "tail";
  }
  return "";
}

void PairModel::check() const {
  check_species();
  const std::size_t n = species.size();
  if (epsilon.size() != n * n || sigma.size() != n * n)
    throw_bad_input(fmt::format("model {}: {} species need {} pair parameters", name, n, n * n));
  if (!(cutoff > 0.0) || !std::isfinite(cutoff))
    throw_bad_input(fmt::format("cutoff {} is not allowed: it must be a finite number above 0 (in units of sigma_ab)", cutoff));
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      const double e = epsilon[pair(a, b)], s = sigma[pair(a, b)];
      if (!(e >= 0.0) || !std::isfinite(e) || !(s > 0.0) || !std::isfinite(s))
        throw_bad_input(fmt::format("pair {}-{}: epsilon {} and sigma {} must be finite, epsilon at least 0 and sigma above 0",
                                    species[a].name, species[b].name, e, s));
      if (e != epsilon[pair(b, a)] || s != sigma[pair(b, a)])
        throw_bad_input(fmt::format("pair {}-{} differs from its mirror image", species[a].name, species[b].name));
    }
}

PairModel kob_andersen() {
  PairModel model;
  model.name = "kob-andersen";
  model.species = {{"Ni", 1.0, 0.8}, {"P", 1.0, 0.2}};
  model.epsilon = {1.0, 1.5, 1.5, 0.5};
  model.sigma = {1.0, 0.8, 0.8, 0.88};
  return model;
}

PairModel lennard_jones() {
  PairModel model;
  model.name = "lennard-jones";
  model.species = {{"Ar", 1.0, 1.0}};
  model.epsilon = {1.0};
  model.sigma = {1.0};
  return model;
}

PairModel named_pair_model(std::string_view name) {
  if (name == "kob-andersen") return kob_andersen();
  if (name == "lennard-jones") return lennard_jones();
  throw_bad_input(fmt::format("unknown model '{}': allowed are kob-andersen, lennard-jones", name));
}

}  // namespace lanescape
