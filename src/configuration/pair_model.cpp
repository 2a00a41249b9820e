#include "configuration/pair_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace lanescape {

namespace {

constexpr std::pair<Truncation, const char*> truncation_words[] = {{Truncation::shifted, "shifted"},
                                                                   {Truncation::plain, "plain"},
                                                                   {Truncation::tail, "tail"},
                                                                   {Truncation::shifted_force, "shifted-force"},
                                                                   {Truncation::smooth, "smooth"}};

}  // namespace

ImageRule parse_image_rule(std::string_view word) {
  if (word == "all") return ImageRule::all;
  if (word == "minimum") return ImageRule::minimum;
  throw_bad_input(fmt::format("unknown image rule '{}': allowed are all, minimum", word));
}

Truncation parse_truncation(std::string_view word) {
  for (const auto& [truncation, name] : truncation_words)
    if (word == name) return truncation;
  throw_bad_input(fmt::format("unknown truncation '{}': allowed are shifted, plain, tail, shifted-force, smooth", word));
}

const char* to_string(ImageRule rule) { return rule == ImageRule::all ? "all" : "minimum"; }

const char* to_string(Truncation truncation) {
  for (const auto& [value, name] : truncation_words)
    if (value == truncation) return name;
  return "";
}

double PairModel::largest_cutoff() const {
  double largest = 0.0;
  for (std::size_t ab = 0; ab < sigma.size(); ++ab) largest = std::max(largest, cutoff_of(ab));
  return largest;
}

PairCorrection PairModel::correction(std::size_t ab) const {
  if (truncation == Truncation::plain || truncation == Truncation::tail) return {};
  const double rc = cutoff_of(ab), rc2 = rc * rc;
  const PairDerivatives at = form->derivatives(numbers(ab), rc);
  if (truncation == Truncation::shifted) return {.c0 = -at.u};
  if (truncation == Truncation::shifted_force) return {.c0 = at.first - at.u, .c1 = -at.first / rc};
  // With t = r^2 the correction is a parabola in t, which takes over value, slope and curvature at rc.
  const double slope = at.first / (2.0 * rc2), curvature = (at.second - at.first) / (4.0 * rc2 * rc2);
  const double c4 = -0.5 * curvature, c2 = curvature * rc2 - slope;
  return {.c0 = -at.u - c2 * rc2 - c4 * rc2 * rc2, .c2 = c2, .c4 = c4};
}

PairDerivatives PairModel::derivatives(std::size_t ab, double r) const {
  const PairCorrection c = correction(ab);
  const PairDerivatives at = form->derivatives(numbers(ab), r);
  const double r2 = r * r, r4 = r2 * r2;
  return {at.u + (c.c0 + c.c1 * r + c.c2 * r2 + c.c4 * r4), at.first + (c.c1 * r + 2.0 * c.c2 * r2 + 4.0 * c.c4 * r4),
          at.second + (2.0 * c.c2 * r2 + 12.0 * c.c4 * r4)};
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
