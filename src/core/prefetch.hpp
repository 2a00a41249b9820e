#pragma once

namespace lanescape {

// Asks for the cache line of an address, of which any is allowed. Inlined by force: g++ takes a function that only prefetches for
// one without effects, and drops calls of it.
[[gnu::always_inline]] inline void prefetch(const void* address) { __builtin_prefetch(address); }

}  // namespace lanescape
