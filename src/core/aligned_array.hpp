#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace lanescape {

// Allocates on cache-line boundaries, as the kernels demand (kernels::array_alignment).
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) noexcept {}

  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) noexcept { ::operator delete(p, alignment); }
  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
};

using AlignedArray = std::vector<double, AlignedAllocator<double>>;

}  // namespace lanescape
