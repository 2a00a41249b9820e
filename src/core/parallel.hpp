#pragma once

#include <cstddef>
#include <functional>

namespace lanescape {

// Calls body(part) for each part below `parts`, on that many threads; on one in a child that was forked after a call. An exception
// is rethrown once all threads have ended.
void run_on_threads(int parts, const std::function<void(int)>& body);

// Does the same, but runs a single part without OpenMP. Divide work so that no result depends on the number of parts.
template <class Body>
void for_each_part(int parts, const Body& body) {
  if (parts <= 1)
    body(0);
  else
    run_on_threads(parts, std::cref(body));
}

// The first element of a part of n elements; the part after the last begins at n.
inline std::size_t part_begin(std::size_t n, int part, int parts) {
  return n * static_cast<std::size_t>(part) / static_cast<std::size_t>(parts);
}

}  // namespace lanescape
