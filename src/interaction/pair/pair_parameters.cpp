#include "interaction/pair/pair_parameters.hpp"

#include <algorithm>

namespace lanescape {

std::vector<kernels::PairParameters> pair_parameters(const PairModel& model, double unit) {
  std::vector<kernels::PairParameters> pairs;
  for (std::size_t ab = 0; ab < model.sigma.size(); ++ab) {
    const double cutoff = model.cutoff_of(ab);
    kernels::PairParameters pair{cutoff * cutoff / (unit * unit), {}, kernels::ImageSearch::nearest};
    model.form->coefficients(model.numbers(ab), model.correction(ab), unit,
                             std::span<double, kernels::pair_coefficients>(pair.coefficient));
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
                                    {}};
    std::transform(std::begin(pair.coefficient), std::end(pair.coefficient), p.coefficient,
                   [](double c) { return static_cast<float>(c); });
    single.push_back(p);
  }
  return single;
}

}  // namespace lanescape
