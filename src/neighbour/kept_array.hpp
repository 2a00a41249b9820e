#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/aligned_array.hpp"

namespace lanescape {

// Memory that is kept from call to call and holds nothing until it is written: arrays that are overwritten anyway are not cleared
// first.
template <class T>
class KeptArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  // Room for n elements. What the array holds is lost where it has to grow.
  T* room_for(std::size_t n) { return grow(n, 0); }
  // The same; the first `kept` elements stay.
  T* grow(std::size_t n, std::size_t kept) {
    if (n <= memory_.get_deleter().capacity) return data();
    const std::size_t capacity = n + n / 8;  // numbers of pairs vary from call to call
    std::unique_ptr<T, Free> memory(AlignedAllocator<T>().allocate(capacity), Free{capacity});
    if (kept > 0) std::memcpy(memory.get(), data(), kept * sizeof(T));
    memory_ = std::move(memory);
    return data();
  }

  std::size_t capacity() const { return memory_.get_deleter().capacity; }
  T* data() { return memory_.get(); }
  const T* data() const { return memory_.get(); }
  T& operator[](std::size_t k) { return data()[k]; }
  const T& operator[](std::size_t k) const { return data()[k]; }

 private:
  struct Free {
    std::size_t capacity = 0;
    void operator()(T* p) const noexcept { AlignedAllocator<T>().deallocate(p, capacity); }
  };
  std::unique_ptr<T, Free> memory_;
};

}  // namespace lanescape
