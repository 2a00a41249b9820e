#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "capi/barrier.hpp"

namespace lanescape::capi {

// What a pointer of the C interface points to. Memory of handles is used again and never freed, so that a destroyed one can be told
// from a live one; the longest destroyed is used first.
template <class Object>
struct Handle {
  std::atomic<const void*> tag{nullptr};
  mutable std::atomic<bool> busy{false};
  std::optional<Object> object{};
};

// One address for each type of handle: what a live one's tag is.
template <class Type>
inline constexpr char tag_of = 0;

template <class Type>
class Slots {
 public:
  // Never destroyed: objects of a program may outlive the library's.
  static Slots& instance() {
    static Slots* const slots = new Slots;
    return *slots;
  }

  Type* take() {
    const std::scoped_lock lock(mutex_);
    if (destroyed_.empty()) return new Type;
    Type* const slot = destroyed_.front();
    destroyed_.pop_front();
    return slot;
  }

  void give_back(Type* slot) {
    const std::scoped_lock lock(mutex_);
    destroyed_.push_back(slot);
  }

 private:
  std::mutex mutex_;
  std::deque<Type*> destroyed_;
};

// A handle of an object made by `make`. The caller's pointer is NULL if that throws.
template <class Type, class Make>
void create(Type** handle, const char* argument, const Make& make) {
  Type*& result = given(handle, argument);
  result = nullptr;
  Type* const slot = Slots<Type>::instance().take();
  try {
    slot->object.emplace(make());
  } catch (...) {
    Slots<Type>::instance().give_back(slot);
    throw;
  }
  slot->tag.store(&tag_of<Type>, std::memory_order_release);
  result = slot;
}

template <class Type>
auto& object_of(Type* handle, const char* argument) {
  if (given(handle, argument).tag.load(std::memory_order_acquire) != &tag_of<std::remove_const_t<Type>>)
    refuse("argument " + std::string(argument) + " is no live handle of its kind: it was destroyed, or never made");
  return *handle->object;
}

// Refuses a second call while one uses an object: a caller who forgets a lock gets an error instead of wrong numbers.
class Occupied {
 public:
  Occupied(std::atomic<bool>& busy, const char* argument) : busy_(&busy) {
    if (busy.exchange(true, std::memory_order_acquire))
      refuse("argument " + std::string(argument) +
             " is in use by another call, of another thread or of a callback: one at a time is allowed");
  }
  ~Occupied() { busy_->store(false, std::memory_order_release); }
  Occupied(const Occupied&) = delete;
  Occupied& operator=(const Occupied&) = delete;

 private:
  std::atomic<bool>* busy_;
};

// Does the work of a function with an object that no other call may use meanwhile.
template <class Type, class Work>
lanescape_status alone(Type* handle, const char* argument, const Work& work) noexcept {
  return guarded([&] {
    const Occupied occupied(given(handle, argument).busy, argument);
    work(object_of(handle, argument));
  });
}

// A live handle becomes a destroyed one.
template <class Type>
lanescape_status destroy(Type* handle, const char* argument) {
  if (handle == nullptr) return LANESCAPE_OK;
  const lanescape_status status = alone(handle, argument, [&](auto&) {
    handle->tag.store(nullptr, std::memory_order_release);
    handle->object.reset();
  });
  if (status == LANESCAPE_OK) return guarded([&] { Slots<Type>::instance().give_back(handle); });
  return status;
}

}  // namespace lanescape::capi
