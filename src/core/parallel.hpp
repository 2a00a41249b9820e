#pragma once

#include <cstddef>
#include <functional>

#include "core/thread_team.hpp"

namespace lanescape {

// Calls body(block) for each block below `blocks`, on so many threads, which share the blocks as they come to them (ThreadTeam).
// Cut work into blocks so that no result depends on who does them. Inside another loop, and in a child that was forked after such a
// call, one thread does all. Rethrows the exception of the first block that throws, once all threads have ended.
void run_on_threads(int threads, std::size_t blocks, const std::function<void(std::size_t)>& body, Taking taking);

// The same; a single thread costs nothing more than the loop.
template <class Body>
void for_each_block(int threads, std::size_t blocks, const Body& body, Taking taking = Taking::one_block) {
  if (threads > 1 && blocks > 1) return run_on_threads(threads, blocks, std::cref(body), taking);
  for (std::size_t block = 0; block < blocks; ++block) body(block);
}

// Calls body(part) for each part below `parts`, on that many threads.
template <class Body>
void for_each_part(int parts, const Body& body) {
  for_each_block(parts, static_cast<std::size_t>(parts < 1 ? 1 : parts), [&](std::size_t part) { body(static_cast<int>(part)); });
}

// The first element of a part of n elements; the part after the last begins at n.
inline std::size_t part_begin(std::size_t n, int part, int parts) {
  return n * static_cast<std::size_t>(part) / static_cast<std::size_t>(parts);
}

}  // namespace lanescape
