// Compiled without contraction: the last bit of a distance decides about pairs at the cutoff.
#include "neighbour/pair_rows.hpp"

#include <algorithm>
#include <cmath>

namespace lanescape {
namespace {

// Counting smaller numbers is quadratic, but without branches: it is faster than any sort for rows of usual length.
constexpr std::size_t few = 256;

Point separation(const Point& edges, const PairPoint& from, const PairPoint& to) {
  Point d{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    d[axis] = (to.position[axis] - from.position[axis]) + (to.boxes[axis] - from.boxes[axis]) * edges[axis];
  return d;
}

double length(const double* d) { return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]); }

bool is_excluded(const PairRule& rule, std::int64_t first, std::int64_t second) {
  const auto i = static_cast<std::size_t>(first);
  const auto begin = rule.excluded.begin();
  return std::binary_search(begin + static_cast<std::ptrdiff_t>(rule.first_excluded[i]),
                            begin + static_cast<std::ptrdiff_t>(rule.first_excluded[i + 1]), second);
}

}  // namespace

std::size_t keep_neighbours(const PairRule& rule, const PairRow& row, const PairPoint* points, std::uint32_t* numbers,
                            std::size_t count) {
  const double* cutoffs = rule.cutoffs.data() + row.particle.species * rule.species;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const PairPoint& point = points[numbers[k]];
    const Point d = separation(rule.edges, row.particle, point);
    numbers[kept] = numbers[k];
    kept += length(d.data()) < cutoffs[point.species];
  }
  if (!rule.first_excluded.empty())
    kept = static_cast<std::size_t>(
        std::remove_if(numbers, numbers + kept,
                       [&](std::uint32_t k) { return is_excluded(rule, row.particle.particle, points[k].particle); }) -
        numbers);
  return kept;
}

void write_pairs(const PairRule& rule, const PairRow& row, const PairPoint* points, std::span<const std::uint32_t> numbers,
                 const PairArrays& out, std::size_t begin, double* spare) {
  const std::size_t n = numbers.size();
  if (out.first != nullptr) std::fill(out.first + begin, out.first + begin + n, row.particle.particle);
  if (out.second != nullptr)
    for (std::size_t k = 0; k < n; ++k) out.second[begin + k] = points[numbers[k]].particle;
  if (out.shifts != nullptr)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        out.shifts[3 * (begin + k) + axis] = static_cast<std::int32_t>(points[numbers[k]].boxes[axis] - row.particle.boxes[axis]);
  if (out.separations == nullptr && out.distances == nullptr) return;
  double* separations = out.separations != nullptr ? out.separations + 3 * begin : spare;
  for (std::size_t k = 0; k < n; ++k) {
    const Point d = separation(rule.edges, row.particle, points[numbers[k]]);
    std::copy(d.begin(), d.end(), separations + 3 * k);
  }
  if (out.distances != nullptr)
    for (std::size_t k = 0; k < n; ++k) out.distances[begin + k] = length(separations + 3 * k);
}

void sort_numbers(std::uint32_t* numbers, std::size_t count, std::uint32_t* spare, const kernels::KernelTable& table) {
  if (count > few) return std::sort(numbers, numbers + count);
  table.sort_few(numbers, count, spare);
  std::copy(spare, spare + count, numbers);
}

}  // namespace lanescape
