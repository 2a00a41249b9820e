#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lanescape {

// How often a quantity took a value over the steps of a path. Entry k counts the value `first` + k `width`; for values that are
// not whole numbers this is the upper edge of its bin. Adaptive steps count with their length instead of 1 [sigma].
struct StepHistogram {
  std::string quantity;
  double first, width;
  std::vector<double> counts;

  double mean() const {
    double sum = 0.0, weight = 0.0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      sum += counts[k] * (first + static_cast<double>(k) * width);
      weight += counts[k];
    }
    return weight > 0.0 ? sum / weight : 0.0;
  }
};

}  // namespace lanescape
