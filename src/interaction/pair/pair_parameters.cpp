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
  for (std::size_t ab = 0; ab < model.sigma.size(); ++ab) {
    const double cutoff = model.cutoff_of(ab);
    PairNumbers numbers = model.numbers(ab);
    const PairCorrection correction = model.correction(numbers);
    kernels::PairParameters pair{cutoff * cutoff / (unit * unit), {}, correction.kind(), kernels::ImageSearch::nearest};
    numbers.form = model.kernel_numbers();
    model.kernel_form().coefficients(numbers, correction, unit, std::span<double, kernels::pair_coefficients>(pair.coefficient));
    pairs.push_back(pair);
  }
  return pairs;
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
