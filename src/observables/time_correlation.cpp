#include "observables/time_correlation.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <kissfft/kissfft.hh>  // of the standard headers it needs, this one includes only <complex>, <utility> and <vector>

namespace lanescape {
namespace {

using Complex = std::complex<double>;

// The smallest number >= n without prime factors above 5, for which kissfft has fast code.
std::size_t transform_length(std::size_t n) {
  const auto is_smooth = [](std::size_t m) {
    for (const std::size_t prime : {2, 3, 5})
      while (m % prime == 0) m /= prime;
    return m == 1;
  };
  while (!is_smooth(n)) ++n;
  return n;
}

}  // namespace

std::vector<double> full_window_correlation(const SeriesView& series, std::size_t lags) {
  // Let a be the series x cut to its origins. The circular correlation of a and x over a length of at least `records` mixes lag k
  // with lags k +- length. These have no terms: they need a record at k + length or an origin at length - k.
  const std::size_t origins = series.records - lags, length = transform_length(series.records);
  const kissfft<double> forward(length, false);
  std::vector<Complex> pair(length), transformed(length), spectrum(length);
  for (std::size_t column = series.first; column < series.first + series.count; ++column) {
    for (std::size_t t = 0; t < series.records; ++t) {
      const double x = series.values[t * series.row + column];
      pair[t] = {t < origins ? x : 0.0, x};
    }
    forward.transform(pair.data(), transformed.data());
    // With z = a + i x, conj(A_q) X_q = Im(Z_q Z_-q)/2 - i (|Z_q|^2 - |Z_-q|^2)/4: one transform handles both real series.
    for (std::size_t q = 0; q < length; ++q) {
      const Complex z = transformed[q], mirror = transformed[q == 0 ? 0 : length - q];
      spectrum[q] +=
          Complex(0.5 * (z.real() * mirror.imag() + z.imag() * mirror.real()), -0.25 * (std::norm(z) - std::norm(mirror)));
    }
  }
  kissfft<double>(length, true).transform(spectrum.data(), transformed.data());
  std::vector<double> correlation(lags + 1);
  for (std::size_t k = 0; k <= lags; ++k) correlation[k] = transformed[k].real() / static_cast<double>(length);
  return correlation;
}

std::vector<double> running_simpson(std::span<const double> f, double spacing) {
  std::vector<double> integral(f.size(), 0.0);
  if (f.size() == 2) integral[1] = spacing / 2.0 * (f[0] + f[1]);
  if (f.size() > 2) integral[1] = spacing / 12.0 * (5.0 * f[0] + 8.0 * f[1] - f[2]);
  for (std::size_t k = 2; k < f.size(); ++k)
    integral[k] = k % 2 == 0 ? integral[k - 2] + spacing / 3.0 * (f[k - 2] + 4.0 * f[k - 1] + f[k])
                             : integral[k - 3] + spacing * 3.0 / 8.0 * (f[k - 3] + 3.0 * (f[k - 2] + f[k - 1]) + f[k]);
  return integral;
}

}  // namespace lanescape
