#pragma once

// Counts what a test program allocates. Included by one source of it, as this replaces operator new; the library's arrays come
// through the aligned one.

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace lanescape::testing {

inline std::atomic<std::size_t> allocated = 0;
inline std::size_t allocations() { return allocated; }

}  // namespace lanescape::testing

[[gnu::noinline]] void* operator new(std::size_t bytes) {
  ++lanescape::testing::allocated;
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t bytes, std::align_val_t alignment) {
  ++lanescape::testing::allocated;
  const auto line = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(line, (bytes + line - 1) / line * line)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
