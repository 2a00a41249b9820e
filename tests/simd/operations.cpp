#include "operations.hpp"

#include "simd/simd.hpp"

// Compiled once per instruction set, with the flags of kernels.
namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

template <class V, auto f>
void unary(const ScalarOf<V>* a, ScalarOf<V>* out) noexcept {
  store(out, f(load(a)));
}
template <class V, auto f>
void binary(const ScalarOf<V>* a, const ScalarOf<V>* b, ScalarOf<V>* out) noexcept {
  store(out, f(load(a), load(b)));
}
template <class V, auto f>
void ternary(const ScalarOf<V>* a, const ScalarOf<V>* b, const ScalarOf<V>* c, ScalarOf<V>* out) noexcept {
  store(out, f(load(a), load(b), load(c)));
}
template <class V>
MaskOf<V> mask_of(const ScalarOf<V>* m) noexcept {
  return equal(load(m), broadcast<V>(1));
}
template <class V, auto f>
unsigned compared(const ScalarOf<V>* a, const ScalarOf<V>* b) noexcept {
  return bits(f(load(a), load(b)));
}
template <class V, auto f>
unsigned combined(const ScalarOf<V>* a, const ScalarOf<V>* b) noexcept {
  return bits(f(mask_of<V>(a), mask_of<V>(b)));
}
template <class V, auto f>
void masked(const ScalarOf<V>* m, const ScalarOf<V>* a, const ScalarOf<V>* b, ScalarOf<V>* out) noexcept {
  store(out, f(mask_of<V>(m), load(a), load(b)));
}
template <class V, auto f>
void masked_unary(const ScalarOf<V>* m, const ScalarOf<V>* a, ScalarOf<V>* out) noexcept {
  store(out, f(mask_of<V>(m), load(a)));
}

template <class V>
constexpr testing::VectorOperations<ScalarOf<V>> vector_operations() noexcept {
  using T = ScalarOf<V>;
  using M = MaskOf<V>;
  return {
      .lanes = lanes_of<V>,
      .broadcast = [](T s, T* out) { store(out, broadcast<V>(s)); },
      .copy = unary<V, [](V a) { return a; }>,
      .copy_unaligned = [](const T* a, T* out) { store_unaligned(out, load_unaligned(a)); },
      .absolute = unary<V, [](V a) { return absolute(a); }>,
      .square_root = unary<V, [](V a) { return square_root(a); }>,
      .nearest_whole = unary<V, [](V a) { return nearest_whole(a); }>,
      .exponential = unary<V, [](V a) { return exponential(a); }>,
      .add = binary<V, [](V a, V b) { return V(a + b); }>,
      .add_to = binary<V, [](V a, V b) { return a += b; }>,
      .subtract = binary<V, [](V a, V b) { return V(a - b); }>,
      .multiply = binary<V, [](V a, V b) { return V(a * b); }>,
      .divide = binary<V, [](V a, V b) { return V(a / b); }>,
      .maximum = binary<V, [](V a, V b) { return maximum(a, b); }>,
      .minimum = binary<V, [](V a, V b) { return minimum(a, b); }>,
      .copy_sign = binary<V, [](V a, V b) { return copy_sign(a, b); }>,
      .scale_by_power_of_two = binary<V, [](V a, V b) { return scale_by_power_of_two(a, b); }>,
      .multiply_add = ternary<V, [](V a, V b, V c) { return multiply_add(a, b, c); }>,
      .subtract_product = ternary<V, [](V c, V a, V b) { return subtract_product(c, a, b); }>,
      .less = compared<V, [](V a, V b) { return less(a, b); }>,
      .equal = compared<V, [](V a, V b) { return equal(a, b); }>,
      .both = combined<V, [](M a, M b) { return both(a, b); }>,
      .either = combined<V, [](M a, M b) { return either(a, b); }>,
      .and_not = combined<V, [](M a, M b) { return and_not(a, b); }>,
      .any = [](const T* m) { return any(mask_of<V>(m)); },
      .select = masked<V, [](M m, V a, V b) { return select(m, a, b); }>,
      .masked_quotient = masked<V, [](M m, V a, V b) { return masked_quotient(m, a, b); }>,
      .masked_reciprocal = masked_unary<V, [](M m, V a) { return masked_reciprocal(m, a); }>,
      .masked_increment = masked_unary<V, [](M m, V a) { return masked_increment(a, m); }>,
      .lanes_below = [](std::ptrdiff_t k) { return bits(lanes_below<V>(k)); },
      .lanes_below_unsigned = [](std::size_t k) { return bits(lanes_below<V>(k)); },
  };
}

void reduce_add_four_of(double* out, const double* abcd) noexcept {
  reduce_add_four(out, load(abcd), load(abcd + lanes), load(abcd + 2 * lanes), load(abcd + 3 * lanes));
}
void store_point_of(double* out, const double* xyz) noexcept {
  store_point(out, load(xyz), load(xyz + lanes), load(xyz + 2 * lanes));
}
void gather_records_of(const double* base, const std::int32_t* index, double* out) noexcept {
  Vector field[8];
  gather_records(base, index, field);
  for (std::size_t f = 0; f < 8; ++f) store(out + f * lanes, field[f]);
}
void gather_points_of(const double* base, const std::uint32_t* offset, double* out) noexcept {
  Vector x, y, z;
  gather_points(base, offset, x, y, z);
  store(out, x);
  store(out + lanes, y);
  store(out + 2 * lanes, z);
}
void gather_quads_of(const double* base, const std::uint32_t* offset, double* out) noexcept {
  Vector x, y, z, w;
  gather_quads(base, offset, x, y, z, w);
  store(out, x);
  store(out + lanes, y);
  store(out + 2 * lanes, z);
  store(out + 3 * lanes, w);
}
void store_nearest_whole_of(std::uint32_t* out, double* whole, const double* v, double factor) noexcept {
  WholeLanes numbers;
  store(whole, store_nearest_whole(numbers, load(v), factor));
  for (std::size_t k = 0; k < lanes; ++k) out[k] = numbers[k];
}
void gather_differences_of(const std::int32_t* base, const std::uint32_t* offset, const std::int32_t* origin, float* out) noexcept {
  FloatVector x, y, z;
  gather_differences(base, offset, origin, x, y, z);
  store(out, x);
  store(out + float_lanes, y);
  store(out + 2 * float_lanes, z);
}

constexpr std::size_t rows_of_cluster = float_lanes > 8 ? float_lanes / 8 : 1;
void add_to_rows_of(float* p, const float* v) noexcept {
  FloatVector rows[4];
  for (std::size_t k = 0; k < 4 / rows_of_cluster; ++k) rows[k] = load(v + k * float_lanes);
  add_to_rows(p, rows);
}

}  // namespace

extern __attribute__((visibility("default"))) const testing::SimdOperations operations;
constinit const testing::SimdOperations operations{
    .name = LANESCAPE_ISA_STRING(LANESCAPE_ISA),
    .doubles = vector_operations<Vector>(),
    .floats = vector_operations<FloatVector>(),
    .reduce_to_nearest = unary<Vector, [](Vector v) { return reduce_to_nearest(v); }>,
    .count_from = [](double first, double* out) { store(out, count_from(first)); },
    .reduce_add = [](const double* v) { return reduce_add(load(v)); },
    .reduce_max = [](const double* v) { return reduce_max(load(v)); },
    .reduce_min = [](const double* v) { return reduce_min(load(v)); },
    .reduce_add_four = reduce_add_four_of,
    .store_point = store_point_of,
    .gather = [](const double* base, const std::int32_t* index, double* out) { store(out, gather(base, index)); },
    .gather_records = gather_records_of,
    .gather_points = gather_points_of,
    .gather_quads = gather_quads_of,
    .compress_store = [](double* p, unsigned bits, const double* v) { return compress_store(p, bits, load(v)); },
    .compress_store_numbers = compress_store,
    .compress_store_lanes = compress_store_lanes,
    .store_truncated = [](std::int32_t* out, const double* v) { store_truncated(out, load(v)); },
    .store_wrapped = [](std::int32_t* out, const double* v) { store_wrapped(out, load(v)); },
    .store_fractions = [](std::int32_t* out, const double* v) { store_fractions(out, load(v)); },
    .store_nearest_whole = store_nearest_whole_of,
    .rows_per_vector = rows_of_cluster,
    .cluster_differences = [](const std::int32_t* cluster, const std::int32_t* rows,
                              float* out) { store(out, wrapped_difference(load_cluster(cluster), load_rows(rows))); },
    .subtract_from_cluster = [](float* p, const float* v) { subtract_from_cluster(p, load(v)); },
    .add_to_rows = add_to_rows_of,
    .wrapped_difference = [](const std::int32_t* p, std::int32_t s, float* out) { store(out, wrapped_difference(p, s)); },
    .gather_differences = gather_differences_of,
    .compress_store_wide = compress_store_wide,
    .compress_store_offsets = compress_store_offsets,
    .add_halves = [](const float* v, double* out) { store(out, add_halves(load(v))); },
};

}  // namespace lanescape::kernels::LANESCAPE_ISA
