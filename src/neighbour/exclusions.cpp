#include "neighbour/exclusions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/error.hpp"

namespace lanescape {

Exclusions::Exclusions(std::span<const std::array<std::size_t, 2>> pairs, const ParticleLayout& layout)
    : first_(layout.slots() + 1, 0), partners_(2 * pairs.size()) {
  for (const auto& [i, j] : pairs) {
    for (const std::size_t k : {i, j})
      if (k >= layout.size())
        throw_bad_input(fmt::format("excluded pair {} {} is not allowed: particles are from 0 to {}", i, j,
                                    static_cast<std::ptrdiff_t>(layout.size()) - 1));
    if (i == j) throw_bad_input(fmt::format("excluded pair {} {} is not allowed: a particle is no pair with itself", i, j));
    ++first_[layout.slot_of(i) + 1];
    ++first_[layout.slot_of(j) + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next = first_;
  for (const auto& [i, j] : pairs) {
    partners_[next[layout.slot_of(i)]++] = static_cast<std::uint32_t>(layout.slot_of(j));
    partners_[next[layout.slot_of(j)]++] = static_cast<std::uint32_t>(layout.slot_of(i));
  }
  const auto at = [&](std::size_t k) { return partners_.begin() + static_cast<std::ptrdiff_t>(k); };
  for (std::size_t slot = 0; slot < slots(); ++slot) std::sort(at(first_[slot]), at(first_[slot + 1]));
  for (const auto& [i, j] : pairs) {
    const auto partners = of(layout.slot_of(i));
    const auto same = std::equal_range(partners.begin(), partners.end(), static_cast<std::uint32_t>(layout.slot_of(j)));
    if (same.second - same.first > 1) throw_bad_input(fmt::format("excluded pair {} {} is given twice: once is allowed", i, j));
  }
}

}  // namespace lanescape
