#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace lanescape {

// Several time series side by side, one row per record; the correlated ones are the columns [first, first + count) of each row.
struct SeriesView {
  const float* values;
  std::size_t records, row;  // rows, and values in a row
  std::size_t first, count;
};

// c(k) = sum over series and origins t < records - lags of x(t) x(t + k), for k = 0, ..., lags < records. Every lag has the same
// origins, each with its full window. Cost: one Fourier transform of about `records` complex doubles per series. The result equals
// the double sum over the same floats to 1e-15 c(0).
std::vector<double> full_window_correlation(const SeriesView& series, std::size_t lags);

// The integral of equally spaced f from its first value to each of its values, by Simpson's composite rule; an odd number of
// intervals ends with the 3/8 rule. Exact for cubics, except on the first interval (quadratics) and for two values (straight
// lines).
std::vector<double> running_simpson(std::span<const double> f, double spacing);

}  // namespace lanescape
