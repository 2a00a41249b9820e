#pragma once

#include <memory>
#include <utility>

#include <lanescape/error.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN
namespace detail {

// What a class hides from hosts. An object that was moved from has nothing: its members throw Error(bad_input) until it is assigned
// to.
template <class T>
class Owned {
 public:
  Owned() = default;
  Owned(std::unique_ptr<T> object) : object_(std::move(object)) {}
  T* operator->() const { return &**this; }
  T& operator*() const {
    if (object_ == nullptr) throw Error(ErrorCode::bad_input, "an object that was moved from cannot be used: assign to it first");
    return *object_;
  }

 private:
  std::unique_ptr<T> object_;
};

}  // namespace detail
LANESCAPE_ABI_END
}  // namespace lanescape
