#pragma once

#include <cstddef>
#include <cstdint>

// The vector operations of kernels/simd for one instruction set, as functions of arrays, one vector per call. Arrays are aligned to
// 64 bytes if the operation requires it. An input mask is an array of numbers, set where they are 1; an output mask is returned as
// bits.
namespace lanescape::testing {

// Operations for vectors of doubles and of floats.
template <class T>
struct VectorOperations {
  using Unary = void (*)(const T* a, T* out);
  using Binary = void (*)(const T* a, const T* b, T* out);
  using Ternary = void (*)(const T* a, const T* b, const T* c, T* out);
  using Masked = void (*)(const T* mask, const T* a, const T* b, T* out);
  using Bits = unsigned (*)(const T* a, const T* b);

  std::size_t lanes;
  void (*broadcast)(T s, T* out);
  Unary copy, copy_unaligned, absolute, square_root, nearest_whole, exponential;
  Binary add, add_to, subtract, multiply, divide, maximum, minimum, copy_sign, scale_by_power_of_two;
  Ternary multiply_add, subtract_product;
  Bits less, equal, both, either, and_not;
  bool (*any)(const T* mask);
  Masked select, masked_quotient;
  void (*masked_reciprocal)(const T* mask, const T* v, T* out);
  void (*masked_increment)(const T* mask, const T* sum, T* out);
  unsigned (*lanes_below)(std::ptrdiff_t k);
  unsigned (*lanes_below_unsigned)(std::size_t k);
};

struct SimdOperations {
  const char* name;
  VectorOperations<double> doubles;
  VectorOperations<float> floats;

  void (*reduce_to_nearest)(const double* v, double* out);
  void (*count_from)(double first, double* out);
  double (*reduce_add)(const double* v);
  double (*reduce_max)(const double* v);
  double (*reduce_min)(const double* v);
  void (*reduce_add_four)(double* out, const double* abcd);  // four vectors, contiguous
  void (*store_point)(double* out, const double* xyz);       // three vectors
  void (*gather)(const double* base, const std::int32_t* index, double* out);
  void (*gather_records)(const double* base, const std::int32_t* index, double* out);   // eight vectors
  void (*gather_points)(const double* base, const std::uint32_t* offset, double* out);  // three
  void (*gather_quads)(const double* base, const std::uint32_t* offset, double* out);   // four
  std::size_t (*compress_store)(double* p, unsigned bits, const double* v);
  std::size_t (*compress_store_numbers)(std::uint32_t* p, unsigned bits, const std::uint32_t* from);
  std::size_t (*compress_store_lanes)(std::int32_t* p, unsigned bits, std::int32_t first);
  void (*store_truncated)(std::int32_t* out, const double* v);
  void (*store_wrapped)(std::int32_t* out, const double* v);
  void (*store_fractions)(std::int32_t* out, const double* v);
  void (*store_nearest_whole)(std::uint32_t* out, double* whole, const double* v, double factor);

  std::size_t rows_per_vector;  // of clusters
  // load_cluster(cluster) - load_rows(rows)
  void (*cluster_differences)(const std::int32_t* cluster, const std::int32_t* rows, float* out);
  void (*subtract_from_cluster)(float* p, const float* v);
  void (*add_to_rows)(float* p, const float* v);  // vectors of four rows

  void (*wrapped_difference)(const std::int32_t* p, std::int32_t s, float* out);
  void (*gather_differences)(const std::int32_t* base, const std::uint32_t* offset, const std::int32_t* origin,
                             float* out);  // three vectors
  std::size_t (*compress_store_wide)(std::uint32_t* p, std::uint32_t bits, const std::uint32_t* from);
  std::size_t (*compress_store_offsets)(std::uint32_t* p, std::uint32_t bits, std::uint32_t first);
  void (*add_halves)(const float* v, double* out);
};

}  // namespace lanescape::testing
