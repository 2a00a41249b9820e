#pragma once

#include <cstddef>

#include "isa.hpp"

// What a template over the vector type needs to know of it. `Vector` holds doubles, `FloatVector` floats.
namespace lanescape::kernels::LANESCAPE_ISA {

template <class V>
using ScalarOf = typename V::value_type;
template <class V>
using MaskOf = typename V::batch_bool_type;
template <class V>
inline constexpr std::size_t lanes_of = V::size;

}  // namespace lanescape::kernels::LANESCAPE_ISA
