#pragma once

#include <cstddef>
#include <exception>
#include <vector>

namespace lanescape {

// body(part) for every part below `parts`, on that many threads; one part runs without any OpenMP construct. What a body throws
// is thrown again once all have ended. Cut work so that no result depends on the number of parts.
template <class Body>
void for_each_part(int parts, Body body) {
  if (parts <= 1) return body(0);
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(parts));
#pragma omp parallel for schedule(static, 1) num_threads(parts)
  for (int part = 0; part < parts; ++part) {
    try {
      body(part);
    } catch (...) {
      failures[static_cast<std::size_t>(part)] = std::current_exception();
    }
  }
  for (const auto& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

// The first element of a part of n elements; the part after the last begins at n.
inline std::size_t part_begin(std::size_t n, int part, int parts) {
  return n * static_cast<std::size_t>(part) / static_cast<std::size_t>(parts);
}

}  // namespace lanescape
