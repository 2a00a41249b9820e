#include "path/polyline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace lanescape {

double polyline_length(const VectorAlgebra& algebra, const Polyline& nodes) {
  double length = 0.0;
  for (std::size_t k = 1; k < nodes.size(); ++k) length += algebra.distance(nodes[k - 1], nodes[k]);
  return length;
}

Polyline resampled(const VectorAlgebra& algebra, const Polyline& nodes, std::size_t count) {
  if (nodes.size() < 2 || count < 2) throw_bad_input(fmt::format("{} nodes from {}: a path has at least two", count, nodes.size()));
  std::vector<double> along(nodes.size(), 0.0);
  for (std::size_t k = 1; k < nodes.size(); ++k) along[k] = along[k - 1] + algebra.distance(nodes[k - 1], nodes[k]);
  Polyline result(count, nodes.front());
  AlignedArray chord(nodes.front().size(), 0.0);
  std::size_t segment = 0;
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const double target = along.back() * static_cast<double>(k) / static_cast<double>(count - 1);
    while (segment + 2 < nodes.size() && along[segment + 1] <= target) ++segment;
    const double length = along[segment + 1] - along[segment];
    algebra.difference(chord, nodes[segment + 1], nodes[segment]);
    algebra.axpy(result[k], nodes[segment], length > 0.0 ? (target - along[segment]) / length : 0.0, chord);
  }
  result.back() = nodes.back();
  return result;
}

Polyline reversed(Polyline nodes) {
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

std::vector<AlignedArray> chord_tangents(const VectorAlgebra& algebra, const Polyline& nodes) {
  check_polyline(algebra, nodes);
  const AlignedArray zero(nodes.front().size(), 0.0);
  std::vector<AlignedArray> tangents(nodes.size() - 1, zero);
  AlignedArray chord = zero;
  for (std::size_t k = 0; k < tangents.size(); ++k) {
    algebra.difference(chord, nodes[k + 1], nodes[k]);
    algebra.axpy(tangents[k], zero, 1.0 / algebra.norm(chord), chord);
  }
  return tangents;
}

void check_polyline(const VectorAlgebra& algebra, const Polyline& nodes, std::size_t least) {
  if (nodes.size() < least)
    throw_bad_input(fmt::format("a path of {} nodes is not allowed: at least {} are needed", nodes.size(), least));
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (nodes[k].size() != nodes.front().size())
      throw_bad_input(
          fmt::format("node {} of the path has {} coordinates: the first has {}", k, nodes[k].size(), nodes.front().size()));
    if (!std::all_of(nodes[k].begin(), nodes[k].end(), [](double x) { return std::isfinite(x); }))
      throw_bad_input(fmt::format("node {} of the path has a coordinate that is not finite", k));
    if (k > 0 && !(algebra.distance(nodes[k - 1], nodes[k]) > 0.0))
      throw_bad_input(fmt::format("nodes {} and {} of the path coincide: neighbouring nodes must differ", k - 1, k));
  }
}

void exchange_nodes(Archive& archive, std::string_view name, Polyline& nodes) {
  const std::size_t dimension = nodes.empty() ? 0 : nodes.front().size();
  AlignedArray all(nodes.size() * dimension, 0.0);
  if (!archive.reading())
    for (std::size_t k = 0; k < nodes.size(); ++k)
      std::copy(nodes[k].begin(), nodes[k].end(), all.begin() + static_cast<std::ptrdiff_t>(k * dimension));
  archive.field(name, all);
  if (!archive.reading()) return;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(k * dimension), dimension, nodes[k].begin());
}

}  // namespace lanescape
