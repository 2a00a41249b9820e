#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "dispatch/vector_algebra.hpp"

namespace lanescape {

// A path of straight segments: its nodes from R_i to R_f in the layout's slots, kinematic coordinates (KinematicMetric) [sigma].
using Polyline = std::vector<AlignedArray>;

// The sum over segments of |R_{k+1} - R_k| [sigma].
double polyline_length(const VectorAlgebra& algebra, const Polyline& nodes);
// `count` nodes, at least two, equally spaced along the length of the path. Both ends keep their bits.
Polyline resampled(const VectorAlgebra& algebra, const Polyline& nodes, std::size_t count);
Polyline reversed(Polyline nodes);

// The unit vectors along the segments, one fewer than nodes. Throws what check_polyline() throws.
std::vector<AlignedArray> chord_tangents(const VectorAlgebra& algebra, const Polyline& nodes);
// Throws Error(bad_input) for fewer than `least` nodes, nodes of different sizes, coordinates that are not finite, and neighbouring
// nodes that coincide: the direction of their segment is not defined.
void check_polyline(const VectorAlgebra& algebra, const Polyline& nodes, std::size_t least = 2);

// Nodes of a known number and size, as one field.
void exchange_nodes(Archive& archive, std::string_view name, Polyline& nodes);

}  // namespace lanescape
