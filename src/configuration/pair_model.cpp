#include "configuration/pair_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/enum_words.hpp"
#include "core/error.hpp"
#include "core/length_unit.hpp"

namespace lanescape {

namespace {

constexpr EnumWord<ImageRule> image_rules[] = {{ImageRule::all, "all"}, {ImageRule::minimum, "minimum"}};
constexpr EnumWord<Truncation> truncations[] = {{Truncation::shifted, "shifted"},
                                                {Truncation::plain, "plain"},
                                                {Truncation::tail, "tail"},
                                                {Truncation::shifted_force, "shifted-force"},
                                                {Truncation::smooth, "smooth"}};

}  // namespace

ImageRule parse_image_rule(std::string_view word) { return parse_word(image_rules, "image rule", word); }
Truncation parse_truncation(std::string_view word) { return parse_word(truncations, "truncation", word); }
const char* to_string(ImageRule rule) { return word_of(image_rules, rule); }
const char* to_string(Truncation truncation) { return word_of(truncations, truncation); }

double PairModel::largest_cutoff() const {
  double largest = 0.0;
  for (std::size_t ab = 0; ab < sigma.size(); ++ab) largest = std::max(largest, cutoff_of(ab));
  return largest;
}

double PairModel::largest_size(double largest_diameter) const {
  return form->has_diameters ? largest_diameter : *std::max_element(sigma.begin(), sigma.end());
}

double PairModel::length_unit(double largest_diameter) const { return length_unit_of(largest_size(largest_diameter)); }

PairCorrection PairModel::correction(const PairNumbers& numbers) const {
  if (truncation == Truncation::plain || truncation == Truncation::tail) return {};
  const double rc = cutoff * numbers.sigma, rc2 = rc * rc;
  const PairDerivatives at = form->derivatives(numbers, rc);
  if (truncation == Truncation::shifted) return {.c0 = -at.u};
  if (truncation == Truncation::shifted_force) return {.c0 = at.first - at.u, .c1 = -at.first / rc};
  // With t = r^2 the correction is a parabola in t, which takes over value, slope and curvature at rc.
  const double slope = at.first / (2.0 * rc2), curvature = (at.second - at.first) / (4.0 * rc2 * rc2);
  const double c4 = -0.5 * curvature, c2 = curvature * rc2 - slope;
  return {.c0 = -at.u - c2 * rc2 - c4 * rc2 * rc2, .c2 = c2, .c4 = c4};
}

namespace {

// Beyond these, twelfth powers or sums of energies leave the range of numbers.
constexpr double least_sigma = 1e-100, greatest_sigma = 1e100, least_sigma_ratio = 1e-12, greatest_epsilon = 1e100;

bool takes_equivalent(const PairModel& model) {
  const bool more_than_shift = model.truncation == Truncation::shifted_force || model.truncation == Truncation::smooth;
  return more_than_shift && model.form->truncated_as.word != nullptr;
}

}  // namespace

const PairForm& PairModel::kernel_form() const { return takes_equivalent(*this) ? pair_form(form->truncated_as.word) : *form; }

std::span<const double> PairModel::kernel_numbers() const {
  return takes_equivalent(*this) ? std::span<const double>(form->truncated_as.numbers) : form_numbers;
}

PairModel PairModel::in_unit(double unit) const {
  PairModel model = *this;
  for (std::size_t k = 0; k < form->numbers.size(); ++k)
    if (form->numbers[k].per_length) model.form_numbers[k] *= unit;
  if (!form->has_diameters)
    for (double& s : model.sigma) s /= unit;
  return model;
}

PairDerivatives PairModel::derivatives(const PairNumbers& numbers, double r) const {
  const PairCorrection c = correction(numbers);
  const PairDerivatives at = form->derivatives(numbers, r);
  const double r2 = r * r, r4 = r2 * r2;
  return {at.u + (c.c0 + c.c1 * r + c.c2 * r2 + c.c4 * r4), at.first + (c.c1 * r + 2.0 * c.c2 * r2 + 4.0 * c.c4 * r4),
          at.second + (2.0 * c.c2 * r2 + 12.0 * c.c4 * r4)};
}

void PairModel::check_form() const {
  if (form_numbers.size() != form->numbers.size())
    throw_bad_input(fmt::format("model {}: {} numbers of the potential {} are needed", name, form->numbers.size(), form->word));
  for (std::size_t k = 0; k < form_numbers.size(); ++k) {
    const auto& [key, lowest, highest, even, preset, per_length] = form->numbers[k];
    const double value = form_numbers[k];
    if (!(value >= lowest && value <= highest) || (even && std::remainder(value, 2.0) != 0.0))
      throw_bad_input(fmt::format("model {}: {} {} is not allowed: {} from {} to {} is needed", name, key, value,
                                  even ? "an even number" : "a number", lowest, highest));
  }
  if (form->check_numbers != nullptr) form->check_numbers(form_numbers);
  if (std::isfinite(form->range) && cutoff != form->range)
    throw_bad_input(
        fmt::format("cutoff {} is not allowed with the potential {}: it ends at {} sigma_ab", cutoff, form->word, form->range));
  if (truncation == Truncation::tail && (form->tail == nullptr || !std::isfinite(form->tail(numbers(0), cutoff).energy)))
    throw_bad_input(fmt::format("truncation tail is not allowed with the potential {}: it has no long-range integral", form->word));
}

void PairModel::check_range(const std::string& pair, double e, double s) const {
  const double largest = *std::max_element(sigma.begin(), sigma.end());
  if (!(e <= greatest_epsilon && s >= least_sigma && s <= greatest_sigma && s >= least_sigma_ratio * largest))
    throw_bad_input(
        fmt::format("pair {}: epsilon {} and sigma {} are not allowed: epsilon up to {} and sigma from {} to {} are, and "
                    "at least {} of the largest, {}",
                    pair, e, s, greatest_epsilon, least_sigma, greatest_sigma, least_sigma_ratio, largest));
}

void PairModel::check_truncation() const {
  const PairModel reduced = in_unit(length_unit());
  for (std::size_t ab = 0; ab < sigma.size(); ++ab) {
    const PairCorrection c = reduced.correction(reduced.numbers(ab));
    for (const double number : {c.c0, c.c1, c.c2, c.c4})
      if (!(std::abs(number) <= greatest_epsilon))
        throw_bad_input(fmt::format("cutoff {} is not allowed: the potential {} overflows there", cutoff, form->word));
  }
}

void PairModel::check() const {
  check_species();
  const std::size_t n = species.size();
  if (epsilon.size() != n * n || sigma.size() != n * n)
    throw_bad_input(fmt::format("model {}: {} species need {} pair parameters", name, n, n * n));
  check_form();
  if (!(cutoff > 0.0) || !std::isfinite(cutoff))
    throw_bad_input(fmt::format("cutoff {} is not allowed: it must be a finite number above 0 (in units of sigma_ab)", cutoff));
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) {
      const double e = epsilon[pair(a, b)], s = sigma[pair(a, b)];
      if (!(e >= 0.0) || !std::isfinite(e) || !(s > 0.0) || !std::isfinite(s))
        throw_bad_input(fmt::format("pair {}-{}: epsilon {} and sigma {} must be finite, epsilon at least 0 and sigma above 0",
                                    species[a].name, species[b].name, e, s));
      check_range(species[a].name + "-" + species[b].name, e, s);
      if (form->has_diameters && s != 1.0)
        throw_bad_input(
            fmt::format("pair {}-{}: sigma {} is not allowed with the potential {}: 1 is needed, particles have diameters",
                        species[a].name, species[b].name, s, form->word));
      if (e != epsilon[pair(b, a)] || s != sigma[pair(b, a)])
        throw_bad_input(fmt::format("pair {}-{} differs from its mirror image", species[a].name, species[b].name));
    }
  check_truncation();
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

PairModel wca() {
  PairModel model = lennard_jones();
  model.name = "wca";
  model.cutoff = std::pow(2.0, 1.0 / 6.0);
  return model;
}

PairModel wahnstrom() {
  PairModel model;
  model.name = "wahnstrom";
  model.species = {{"Ni", 2.0, 0.5}, {"P", 1.0, 0.5}};
  model.epsilon = {1.0, 1.0, 1.0, 1.0};
  model.sigma = {1.0, 11.0 / 12.0, 11.0 / 12.0, 5.0 / 6.0};
  return model;
}

PairModel one_component(const PairForm& form) {
  PairModel model = lennard_jones();
  model.name = form.word;
  model.form = &form;
  for (const FormNumber& number : form.numbers) {
    if (!number.preset) throw_bad_input(fmt::format("the potential {} needs {}: give it in a model file", form.word, number.key));
    model.form_numbers.push_back(*number.preset);
  }
  if (std::isfinite(form.range)) model.cutoff = form.range;
  return model;
}

PairModel named_pair_model(std::string_view name) {
  if (name == "kob-andersen") return kob_andersen();
  if (name == "lennard-jones") return lennard_jones();
  throw_bad_input(fmt::format("unknown model '{}': allowed are kob-andersen, lennard-jones", name));
}

}  // namespace lanescape
