#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <type_traits>
#include <utility>

namespace lanescape::python {

namespace nb = nanobind;

// One thread at a time. A callback that comes back to the object that called it gets an error where it would wait for ever.
class Lock {
 public:
  void lock() {
    if (owner_.load(std::memory_order_relaxed) == std::this_thread::get_id())
      throw std::runtime_error("this object is at work further up in the same thread: a callback cannot use it");
    mutex_.lock();
    owner_.store(std::this_thread::get_id(), std::memory_order_relaxed);
  }
  void unlock() {
    owner_.store(std::thread::id(), std::memory_order_relaxed);
    mutex_.unlock();
  }

 private:
  std::mutex mutex_;
  std::atomic<std::thread::id> owner_{};
};

// An object of the library with its lock: what Python's classes hold.
template <class T>
struct Guarded {
  template <class... Arguments>
    requires std::is_constructible_v<T, Arguments...>
  explicit Guarded(Arguments&&... arguments) : object(std::forward<Arguments>(arguments)...) {}

  T object;
  Lock lock;
};

// Works without the interpreter's lock, and with the object's. The interpreter's goes first: a thread that kept it while it waits
// would block the one that it waits for.
template <class Work>
auto unlocked(Lock& lock, Work&& work) {
  const nb::gil_scoped_release others_may_run;
  const std::lock_guard held(lock);
  return work();
}

}  // namespace lanescape::python
