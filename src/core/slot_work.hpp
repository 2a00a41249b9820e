#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

#include "core/parallel.hpp"

namespace lanescape {

// Something to be done to the particles in slots [begin, end), multiples of kernels::slot_padding, that depends on these slots alone:
// whoever calls it may cut all slots into such ranges as it likes and share them among threads.
using SlotWork = std::function<void(std::size_t begin, std::size_t end)>;

// Ranges of this length stay in the first-level cache from one piece of work to the next.
inline constexpr std::size_t slot_range = 128;

// Does the work in all slots. `threads`: at most so many, and not for less than pays.
inline void for_all_slots(int threads, std::size_t slots, const SlotWork& work) {
  constexpr std::size_t least_of_thread = 1024;
  const std::size_t parts = std::clamp<std::size_t>(slots / least_of_thread, 1, static_cast<std::size_t>(threads));
  const std::size_t ranges = (slots + slot_range - 1) / slot_range;
  for_each_part(static_cast<int>(parts), [&](int part) {
    const int all = static_cast<int>(parts);
    for (std::size_t r = part_begin(ranges, part, all); r < part_begin(ranges, part + 1, all); ++r)
      work(r * slot_range, std::min((r + 1) * slot_range, slots));
  });
}

}  // namespace lanescape
