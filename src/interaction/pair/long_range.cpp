#include "interaction/pair/long_range.hpp"

#include <numbers>

namespace lanescape {

PairTail long_range(const PairModel& model, std::size_t a, std::size_t b, double volume) {
  PairNumbers numbers = model.numbers(model.pair(a, b));
  numbers.epsilon *= 2.0 * std::numbers::pi / volume;  // the integrals are proportional to it
  return model.form->tail(numbers, model.cutoff);
}

}  // namespace lanescape
