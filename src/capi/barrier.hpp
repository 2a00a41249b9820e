#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

#include <lanescape/lanescape.h>
#include <lanescape/error.hpp>

namespace lanescape::capi {

// A function of the caller returned an error code, or threw, which is code 0.
class CallbackFailure : public std::runtime_error {
 public:
  CallbackFailure(int code, const std::string& message) : std::runtime_error(message), code_(code) {}
  int code() const noexcept { return code_; }

 private:
  int code_;
};

// Keep the message for this thread's lanescape_last_error(), and return the status.
lanescape_status failed(lanescape_status status, const char* message, int callback_error = 0) noexcept;

// Does the work of a function of the C interface. No exception leaves it.
template <class Work>
lanescape_status guarded(const Work& work) noexcept {
  try {
    work();
    return LANESCAPE_OK;
  } catch (const CallbackFailure& failure) {
    return failed(LANESCAPE_CALLBACK_FAILED, failure.what(), failure.code());
  } catch (const Error& error) {
    return failed(static_cast<lanescape_status>(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return failed(LANESCAPE_INTERNAL, "not enough memory");
  } catch (const std::exception& error) {
    return failed(LANESCAPE_INTERNAL, error.what());
  } catch (...) {
    return failed(LANESCAPE_INTERNAL, "unknown exception");
  }
}

// Calls a function of the caller, which may be C++ behind a C signature.
template <class Call>
auto call_back(const char* what, const Call& call) {
  try {
    return call();
  } catch (const std::exception& error) {
    throw CallbackFailure(0, std::string(what) + " threw an exception: " + error.what());
  } catch (...) {
    throw CallbackFailure(0, std::string(what) + " threw an exception");
  }
}

[[noreturn]] void refuse(const std::string& message);
[[noreturn]] void refuse_null(const char* argument);
[[noreturn]] void refuse_size(const char* type, std::size_t given, std::size_t known);

template <class Type>
Type& given(Type* pointer, const char* argument) {
  if (pointer == nullptr) refuse_null(argument);
  return *pointer;
}

// An array of the caller, which may be NULL only if it is empty.
template <class Number>
std::span<Number> array(Number* data, std::size_t count, const char* argument) {
  constexpr std::size_t most = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(Number);
  if (count > most)
    refuse("argument " + std::string(argument) + " would have " + std::to_string(count) + " numbers: at most " +
           std::to_string(most) + " are possible");
  if (data == nullptr && count != 0) refuse_null(argument);
  return {data, count};
}

// One that may be left out.
template <class Number>
std::span<Number> optional_array(Number* data, std::size_t count, const char* argument) {
  return data == nullptr ? std::span<Number>{} : array(data, count, argument);
}

// A length that cannot be stays one: array() refuses it.
inline std::size_t times(std::size_t factor, std::size_t count) {
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  return count > most / factor ? most : factor * count;
}

// Struct is a struct of the interface whose first member is its size.
template <class Struct>
Struct& sized(Struct* pointer, const char* argument, const char* type) {
  Struct& object = given(pointer, argument);
  if (object.size != sizeof(Struct)) refuse_size(type, object.size, sizeof(Struct));
  return object;
}

// For *_init, which the caller tells the size.
template <class Struct>
void initialise(Struct* pointer, std::size_t size, const char* argument, const char* type, const Struct& with) {
  Struct& object = given(pointer, argument);
  if (size != sizeof(Struct)) refuse_size(type, size, sizeof(Struct));
  object = with;
  object.size = size;
}

inline const char* word(const char* given, const char* otherwise) { return given != nullptr ? given : otherwise; }

}  // namespace lanescape::capi
