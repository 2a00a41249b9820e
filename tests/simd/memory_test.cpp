// Gathers, packed stores and sums over lanes.

#include <gtest/gtest.h>

#include <algorithm>

#include "every_simd.hpp"

namespace lanescape::testing {
namespace {

class Memory : public EverySimd {
 protected:
  std::size_t lanes() const { return simd().doubles.lanes; }
  std::size_t float_lanes() const { return simd().floats.lanes; }
};
INSTANTIATE_TEST_SUITE_P(Isa, Memory, all_isas(), isa_name);

// Unordered indices of records, some repeated.
std::int32_t scattered(std::size_t k) { return static_cast<std::int32_t>(5 * k * k + 3 * k + 1) % 16; }

TEST_P(Memory, GathersNumbersByIndex) {
  Lanes<double> base{}, out{};
  for (std::size_t k = 0; k < base.size(); ++k) base[k] = 100.0 + static_cast<double>(k);
  std::int32_t index[8];
  for (std::size_t k = 0; k < 8; ++k) index[k] = scattered(k) - 8;
  simd().gather(base.data() + 8, index, out.data());
  for (std::size_t k = 0; k < lanes(); ++k) EXPECT_EQ(out[k], base[static_cast<std::size_t>(scattered(k))]);
}

TEST_P(Memory, GathersFieldsOfRecords) {
  Lanes<double> base{}, out{};
  for (std::size_t k = 0; k < base.size(); ++k) base[k] = 100.0 + static_cast<double>(k);
  std::int32_t index[8];
  for (std::size_t k = 0; k < 8; ++k) index[k] = scattered(k);
  simd().gather_records(base.data(), index, out.data());
  for (std::size_t field = 0; field < 8; ++field)
    for (std::size_t k = 0; k < lanes(); ++k)
      EXPECT_EQ(out[field * lanes() + k], base[8 * static_cast<std::size_t>(scattered(k)) + field]);
}

TEST_P(Memory, GathersPointsAndQuadsAtOffsets) {
  Lanes<double> base{}, points{}, quads{};
  for (std::size_t k = 0; k < base.size(); ++k) base[k] = 100.0 + static_cast<double>(k);
  std::uint32_t offset[8];
  for (std::size_t k = 0; k < 8; ++k) offset[k] = 4 * static_cast<std::uint32_t>(scattered(k));
  simd().gather_points(base.data(), offset, points.data());
  simd().gather_quads(base.data(), offset, quads.data());
  for (std::size_t axis = 0; axis < 4; ++axis)
    for (std::size_t k = 0; k < lanes(); ++k) {
      EXPECT_EQ(quads[axis * lanes() + k], base[offset[k] + axis]);
      if (axis < 3) {
        EXPECT_EQ(points[axis * lanes() + k], base[offset[k] + axis]);
      }
    }
}

constexpr std::int32_t smallest = std::numeric_limits<std::int32_t>::min(), largest = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t wrapping[] = {0,         1, -1, 12345678, -87654321, smallest, largest, smallest + 1, 1 << 24, (1 << 24) + 1,
                                     -(1 << 30)};

float difference(std::int32_t a, std::int32_t b) {
  return static_cast<float>(static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b)));
}

TEST_P(Memory, DifferencesOfIntegersWrapAround) {
  Lanes<std::int32_t> p{};
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = wrapping[k % std::size(wrapping)];
  for (const std::int32_t s : wrapping) {
    Lanes<float> out{};
    simd().wrapped_difference(p.data(), s, out.data());
    for (std::size_t k = 0; k < float_lanes(); ++k) EXPECT_EQ(out[k], difference(p[k], s)) << p[k] << " - " << s;
  }
}

TEST_P(Memory, RowsOfAVectorMeetTheParticlesOfACluster) {
  Lanes<std::int32_t> cluster{}, rows{};
  for (std::size_t k = 0; k < 8; ++k) cluster[k] = wrapping[k % std::size(wrapping)];
  const std::size_t width = float_lanes() / simd().rows_per_vector;
  for (std::size_t k = 0; k < simd().rows_per_vector; ++k) rows[k] = wrapping[(k + 3) % std::size(wrapping)];
  Lanes<float> out{};
  simd().cluster_differences(cluster.data(), rows.data(), out.data());
  for (std::size_t k = 0; k < float_lanes(); ++k) EXPECT_EQ(out[k], difference(cluster[k % width], rows[k / width]));
}

TEST_P(Memory, GradientsGoToTheParticlesOfAClusterAndToRows) {
  const std::size_t width = float_lanes() / simd().rows_per_vector;
  Lanes<float> v{}, p{}, row_sums{};
  for (std::size_t k = 0; k < 4 * width; ++k) v[k] = static_cast<float>(k * k + 1);
  for (std::size_t k = 0; k < 8; ++k) p[k] = row_sums[k] = 1000.0F;
  simd().subtract_from_cluster(p.data(), v.data());
  for (std::size_t k = 0; k < 8; ++k) {
    float sum = 0.0F;
    for (std::size_t row = 0; row < simd().rows_per_vector && k < width; ++row) sum += v[row * width + k];
    EXPECT_EQ(p[k], 1000.0F - sum) << k;
  }
  simd().add_to_rows(row_sums.data(), v.data());
  for (std::size_t k = 0; k < 8; ++k) {
    // Four rows, two to a vector or one.
    const std::size_t vector = k / simd().rows_per_vector, row = k % simd().rows_per_vector;
    float sum = 0.0F;
    for (std::size_t lane = 0; lane < width && k < 4; ++lane) sum += v[vector * float_lanes() + row * width + lane];
    EXPECT_EQ(row_sums[k], 1000.0F + sum) << k;
  }
}

TEST_P(Memory, GathersDifferencesFromAnOrigin) {
  Lanes<std::int32_t> base{};
  for (std::size_t k = 0; k < base.size(); ++k) base[k] = wrapping[k % std::size(wrapping)];
  std::uint32_t offset[16];
  for (std::size_t k = 0; k < 16; ++k) offset[k] = 4 * static_cast<std::uint32_t>(scattered(k));
  const std::int32_t origin[] = {7, smallest, largest};
  Lanes<float> out{};
  simd().gather_differences(base.data(), offset, origin, out.data());
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = 0; k < float_lanes(); ++k)
      EXPECT_EQ(out[axis * float_lanes() + k], difference(base[offset[k] + axis], origin[axis]));
}

// Selected values come first, in order; nothing is written beyond one vector.
template <class T, class Value>
void expect_packed(const Lanes<T>& out, std::size_t count, unsigned bits, std::size_t lanes, Value value) {
  std::size_t wanted = 0;
  for (std::size_t k = 0; k < lanes; ++k)
    if (bits >> k & 1U) {
      EXPECT_EQ(out[wanted++], value(k)) << bits;
    }
  EXPECT_EQ(count, wanted) << bits;
  for (std::size_t k = lanes; k < out.size(); ++k) EXPECT_EQ(out[k], T(99)) << bits;
}

TEST_P(Memory, PacksLanesThatAreSet) {
  Lanes<double> v{};
  Lanes<std::uint32_t> numbers{};
  for (std::size_t k = 0; k < lanes(); ++k) {
    v[k] = 10.5 + static_cast<double>(k);
    numbers[k] = 1000 + static_cast<std::uint32_t>(k);
  }
  for (unsigned bits = 0; bits < 1U << lanes(); ++bits) {
    Lanes<double> packed{};
    Lanes<std::uint32_t> packed_numbers{};
    Lanes<std::int32_t> packed_lanes{};
    packed.fill(99);
    packed_numbers.fill(99);
    packed_lanes.fill(99);
    expect_packed(packed, simd().compress_store(packed.data(), bits, v.data()), bits, lanes(), [&](std::size_t k) { return v[k]; });
    expect_packed(packed_numbers, simd().compress_store_numbers(packed_numbers.data(), bits, numbers.data()), bits, lanes(),
                  [&](std::size_t k) { return numbers[k]; });
    expect_packed(packed_lanes, simd().compress_store_lanes(packed_lanes.data(), bits, -3), bits, lanes(),
                  [](std::size_t k) { return static_cast<std::int32_t>(k) - 3; });
  }
}

TEST_P(Memory, PacksNumbersInPlace) {
  for (unsigned bits = 0; bits < 1U << lanes(); ++bits) {
    Lanes<std::uint32_t> numbers{};
    numbers.fill(99);
    for (std::size_t k = 0; k < lanes(); ++k) numbers[k] = 1000 + static_cast<std::uint32_t>(k);
    expect_packed(numbers, simd().compress_store_numbers(numbers.data(), bits, numbers.data()), bits, lanes(),
                  [](std::size_t k) { return 1000 + static_cast<std::uint32_t>(k); });
  }
}

TEST_P(Memory, PacksAWideVectorOfNumbersInPlace) {
  for (unsigned bits = 0; bits < 1U << float_lanes(); bits += float_lanes() > 8 ? 13 : 1) {
    Lanes<std::uint32_t> numbers{};
    numbers.fill(99);
    for (std::size_t k = 0; k < float_lanes(); ++k) numbers[k] = 1000 + static_cast<std::uint32_t>(k);
    expect_packed(numbers, simd().compress_store_wide(numbers.data(), bits, numbers.data()), bits, float_lanes(),
                  [](std::size_t k) { return 1000 + static_cast<std::uint32_t>(k); });
  }
}

TEST_P(Memory, PacksOffsetsOfRecords) {
  for (unsigned bits = 0; bits < 1U << float_lanes(); bits += float_lanes() > 8 ? 13 : 1) {
    Lanes<std::uint32_t> offsets{};
    offsets.fill(99);
    expect_packed(offsets, simd().compress_store_offsets(offsets.data(), bits, 1000), bits, float_lanes(),
                  [](std::size_t k) { return 4 * (1000 + static_cast<std::uint32_t>(k)); });
  }
}

TEST_P(Memory, SumsAndExtremesTakeEveryLaneOnce) {
  for (std::size_t odd = 0; odd < lanes(); ++odd) {
    Lanes<double> v{};
    for (std::size_t k = 0; k < lanes(); ++k) v[k] = static_cast<double>(1 << k);
    v[odd] = -1000.0;
    EXPECT_EQ(simd().reduce_add(v.data()), static_cast<double>((1 << lanes()) - 1 - (1 << odd)) - 1000.0);
    EXPECT_EQ(simd().reduce_min(v.data()), -1000.0);
    v[odd] = 1000.0;
    EXPECT_EQ(simd().reduce_max(v.data()), 1000.0);
  }
  Lanes<double> zeros{};
  EXPECT_FALSE(std::signbit(simd().reduce_min(zeros.data())));
}

TEST_P(Memory, SumsOfSeveralVectorsLieSideBySide) {
  Lanes<double> v{}, out{};
  double sums[4] = {};
  for (std::size_t k = 0; k < 4 * lanes(); ++k) {
    v[k] = static_cast<double>(k * k);
    sums[k / lanes()] += v[k];
  }
  out.fill(0.5);
  simd().reduce_add_four(out.data(), v.data());
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(out[k], k < 4 ? sums[k] + 0.5 : 0.5);
  out.fill(0.5);
  simd().store_point(out.data(), v.data());
  for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(out[k], k < 3 ? sums[k] : k == 3 ? 0.0 : 0.5);
}

TEST_P(Memory, HalvesAreAddedInDoublePrecision) {
  Lanes<float> v{};
  Lanes<double> out{};
  for (std::size_t k = 0; k < float_lanes(); ++k) v[k] = k < lanes() ? 1e8F : 1.0F / static_cast<float>(k + 2);
  ASSERT_EQ(float_lanes(), 2 * lanes());
  simd().add_halves(v.data(), out.data());
  for (std::size_t k = 0; k < lanes(); ++k) EXPECT_EQ(out[k], static_cast<double>(v[k]) + static_cast<double>(v[k + lanes()]));
}

TEST_P(Memory, CountsFromANumber) {
  Lanes<double> out{};
  simd().count_from(-2.5, out.data());
  for (std::size_t k = 0; k < lanes(); ++k) EXPECT_EQ(out[k], static_cast<double>(k) - 2.5);
}

TEST_P(Memory, ConvertsToIntegers) {
  const std::vector<double> numbers{0.0,  -0.0,       0.5,   -0.5,         1.5,           2.5,
                                    -2.5, 0.99999999, -7.75, 2147483647.0, -2147483648.0, 1234567.5};
  for_each_pair(numbers, lanes(), [&](const Lanes<double>& v, const Lanes<double>&) {
    Lanes<std::int32_t> truncated{}, wrapped{};
    simd().store_truncated(truncated.data(), v.data());
    simd().store_wrapped(wrapped.data(), v.data());
    for (std::size_t k = 0; k < lanes(); ++k) {
      EXPECT_EQ(truncated[k], static_cast<std::int32_t>(v[k])) << v[k];
      EXPECT_EQ(wrapped[k], static_cast<std::int32_t>(std::nearbyint(v[k]))) << v[k];
    }
  });
  Lanes<double> half{};
  half.fill(2147483648.0);
  Lanes<std::int32_t> out{};
  simd().store_wrapped(out.data(), half.data());
  for (std::size_t k = 0; k < lanes(); ++k) EXPECT_EQ(out[k], smallest);
}

TEST_P(Memory, FractionsOfTheBoxWrapAround) {
  const std::vector<double> numbers{0.0, 0.25, -0.25, 0.5, -0.5, 0.75, 3.125, -7.875, 1e5 + 0.0625, 0.4999999999};
  for_each_pair(numbers, lanes(), [&](const Lanes<double>& v, const Lanes<double>&) {
    Lanes<std::int32_t> out{};
    simd().store_fractions(out.data(), v.data());
    for (std::size_t k = 0; k < lanes(); ++k) {
      const double rest = v[k] - std::nearbyint(v[k]);
      const auto wanted = static_cast<std::int64_t>(std::nearbyint(std::ldexp(rest, 32)));
      EXPECT_EQ(out[k], static_cast<std::int32_t>(static_cast<std::uint32_t>(wanted))) << v[k];
    }
  });
}

TEST_P(Memory, KeepsWholeNumbersLaneByLane) {
  const std::vector<double> numbers{0.0, 0.5, 1.5, 2.5, 3.49, 1023.75, 2147483646.5, 2147483647.0, 77.0};
  for_each_pair(numbers, lanes(), [&](const Lanes<double>& v, const Lanes<double>&) {
    Lanes<std::uint32_t> out{}, multiples{};
    Lanes<double> whole{};
    simd().store_nearest_whole(out.data(), whole.data(), v.data(), 1.0);
    simd().store_nearest_whole(multiples.data(), whole.data(), v.data(), 0.25);
    for (std::size_t k = 0; k < lanes(); ++k) {
      const double nearest = std::nearbyint(v[k]);
      EXPECT_EQ(whole[k], nearest);
      EXPECT_EQ(out[k], static_cast<std::uint32_t>(nearest));
      EXPECT_EQ(multiples[k], static_cast<std::uint32_t>(std::nearbyint(0.25 * nearest)));
    }
  });
}

}  // namespace
}  // namespace lanescape::testing
