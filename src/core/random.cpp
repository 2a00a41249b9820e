#include "core/random.hpp"

#include <Random123/philox.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lanescape {
namespace {

struct UniformPair {
  double first, second;
};

// 52 bits centred in their cells: exact in a double, so never 0 and never 1.
double to_unit_interval(std::uint32_t high, std::uint32_t low) {
  const std::uint64_t bits = (static_cast<std::uint64_t>(high) << 20) ^ (low >> 12);
  return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

r123::Philox4x32::ctr_type draw_block(std::uint64_t seed, RandomStream stream, std::uint64_t step, std::uint32_t particle,
                                      std::uint32_t draw) {
  const r123::Philox4x32::ctr_type counter = {static_cast<std::uint32_t>(step), static_cast<std::uint32_t>(step >> 32), particle,
                                              draw ^ (static_cast<std::uint32_t>(stream) << 24)};
  const r123::Philox4x32::key_type key = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
  return r123::Philox4x32{}(counter, key);
}

UniformPair draw_pair(std::uint64_t seed, RandomStream stream, std::uint64_t step, std::uint32_t particle, std::uint32_t draw) {
  const auto r = draw_block(seed, stream, step, particle, draw);
  return {to_unit_interval(r[0], r[1]), to_unit_interval(r[2], r[3])};
}

}  // namespace

double CounterRandom::uniform(std::uint64_t step, std::uint32_t particle, std::uint32_t draw) const {
  return draw_pair(seed_, stream_, step, particle, draw).first;
}

double CounterRandom::normal(std::uint64_t step, std::uint32_t particle, std::uint32_t draw) const {
  const auto [radius, angle] = draw_pair(seed_, stream_, step, particle, draw);
  return std::sqrt(-2.0 * std::log(radius)) * std::cos(2.0 * std::numbers::pi * angle);
}

std::array<double, 3> CounterRandom::velocity(double width, std::uint64_t step, std::uint32_t particle, std::uint32_t draw) const {
  return {width * normal(step, particle, draw), width * normal(step, particle, draw + 1), width * normal(step, particle, draw + 2)};
}

std::array<double, 3> CounterRandom::uniform_point(std::uint64_t step, std::uint32_t particle, std::uint32_t draw) const {
  const auto r = draw_block(seed_, stream_, step, particle, draw);
  const auto fraction = [](std::uint32_t bits) { return (static_cast<double>(bits) + 0.5) * 0x1p-32; };
  return {fraction(r[0]), fraction(r[1]), fraction(r[2])};
}

std::uint32_t CounterRandom::below(std::uint32_t n, std::uint64_t step, std::uint32_t particle, std::uint32_t draw) const {
  return std::min(n - 1, static_cast<std::uint32_t>(uniform(step, particle, draw) * n));
}

}  // namespace lanescape
