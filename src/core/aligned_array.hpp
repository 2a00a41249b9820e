#pragma once

#include <cstddef>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace lanescape {

// Allocates on cache-line boundaries, as the kernels require (kernels::array_alignment). Large arrays are put on large pages where
// the system has them: otherwise address translation slows a step of 32,000 particles or more by a sixth.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::size_t line = 64, large_page = std::size_t{1} << 21;

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) noexcept {}

  T* allocate(std::size_t n) {
    void* memory = ::operator new(n * sizeof(T), alignment(n));
#ifdef __linux__
    if (is_large(n)) ::madvise(memory, n * sizeof(T), MADV_HUGEPAGE);  // advice: the system may ignore it
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* p, std::size_t n) noexcept { ::operator delete(p, alignment(n)); }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }

 private:
  static bool is_large(std::size_t n) { return n * sizeof(T) >= large_page / 2; }
  static std::align_val_t alignment(std::size_t n) { return std::align_val_t{is_large(n) ? large_page : line}; }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;
using AlignedArray = AlignedVector<double>;

}  // namespace lanescape
