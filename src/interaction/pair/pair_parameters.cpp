#include "interaction/pair/pair_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace lanescape {

double diameter_scale(const PairModel& model, const ParticleLayout& layout) {
  if (!model.form->has_diameters) return 1.0;
  const AlignedArray& diameters = layout.diameters();
  if (layout.size() > 0 && diameters.size() == 0)
    throw_bad_input(fmt::format("model {} needs a diameter of each particle, column diameter:R:1 of a file", model.name));
  return diameters.size() == 0 ? 1.0 : *std::max_element(diameters.begin(), diameters.end());
}

std::vector<kernels::PairParameters> pair_parameters(const PairModel& model, double unit) {
  std::vector<kernels::PairParameters> pairs;
  put_pair_parameters(model, unit, pairs);
  return pairs;
}

void put_pair_parameters(const PairModel& model, double unit, std::vector<kernels::PairParameters>& pairs) {
  pairs.clear();
  for (std::size_t ab = 0; ab < model.sigma.size(); ++ab) {
    const double cutoff = model.cutoff_of(ab);
    PairNumbers numbers = model.numbers(ab);
    const PairCorrection correction = model.correction(numbers);
    kernels::PairParameters pair{cutoff * cutoff / (unit * unit), {}, correction.kind(), kernels::ImageSearch::nearest};
    numbers.form = model.kernel_numbers();
    model.kernel_form().coefficients(numbers, correction, unit, std::span<double, kernels::pair_coefficients>(pair.coefficient));
    pairs.push_back(pair);
  }
}

namespace {

// `smallest` and `largest`: diameters of particles that have some of their own.
void check_single_precision(const PairModel& model, double smallest, double largest) {
  // Coordinates are rounded to 2^-29 of the largest reach, which at this limit is 2^-24 of the smallest diameter: what rounding to
  // single precision loses anyway.
  constexpr double most_reach_per_size = 32.0, least_epsilon = 1e-10, greatest_epsilon = 1e10;
  const double size = smallest * *std::min_element(model.sigma.begin(), model.sigma.end()),
               reach = largest * model.largest_cutoff();
  if (reach > most_reach_per_size * size)
    throw_bad_input(
        fmt::format("mixed precision is not allowed with a smallest diameter of {} and a cutoff of {}: at most {} diameters "
                    "are; double precision has no such limit",
                    size, reach, most_reach_per_size));
  for (const double e : model.epsilon)
    if (e != 0.0 && !(e >= least_epsilon && e <= greatest_epsilon))
      throw_bad_input(
          fmt::format("mixed precision is not allowed with epsilon {}: from {} to {} is; double precision has no such limit", e,
                      least_epsilon, greatest_epsilon));
}

}  // namespace

void check_single_precision(const PairModel& model) { check_single_precision(model, 1.0, 1.0); }

void check_single_precision(const PairModel& model, const ParticleLayout& layout) {
  double smallest = diameter_scale(model, layout);
  if (model.form->has_diameters)
    for (const auto& block : layout.blocks())
      for (std::size_t k = 0; k < block.count; ++k) smallest = std::min(smallest, layout.diameters()[block.begin + k]);
  check_single_precision(model, smallest, diameter_scale(model, layout));
}

std::vector<kernels::SinglePairParameters> single_pair_parameters(const std::vector<kernels::PairParameters>& pairs,
                                                                  double fixed_unit) {
  const double sigma_squared = 1.0 / (fixed_unit * fixed_unit);
  std::vector<kernels::SinglePairParameters> single;
  for (const auto& pair : pairs) {
    kernels::SinglePairParameters p{static_cast<float>(pair.cutoff_squared * sigma_squared),
                                    static_cast<float>(sigma_squared),
                                    static_cast<float>(fixed_unit * fixed_unit),
                                    {},
                                    pair.correction};
    std::transform(std::begin(pair.coefficient), std::end(pair.coefficient), p.coefficient,
                   [](double c) { return static_cast<float>(c); });
    single.push_back(p);
  }
  return single;
}

}  // namespace lanescape
