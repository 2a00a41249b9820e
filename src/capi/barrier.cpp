#include "capi/barrier.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace lanescape::capi {
namespace {

// Longer messages are cut: keeping one must not allocate.
thread_local std::array<char, 2048> last_message{};
thread_local int last_callback_code = 0;

}  // namespace

lanescape_status failed(lanescape_status status, const char* message, int callback_error) noexcept {
  const std::size_t length = std::min(std::strlen(message), last_message.size() - 1);
  std::memmove(last_message.data(), message, length);
  last_message[length] = '\0';
  if (status == LANESCAPE_CALLBACK_FAILED) last_callback_code = callback_error;
  return status;
}

void refuse(const std::string& message) { throw Error(ErrorCode::bad_input, message); }

void refuse_null(const char* argument) { refuse("argument " + std::string(argument) + " is NULL: it must point to something"); }

void refuse_size(const char* type, std::size_t given, std::size_t known) {
  refuse("a " + std::string(type) + " of size " + std::to_string(given) + " is not known: this library's has " +
         std::to_string(known) + " bytes, which its first member must say");
}

}  // namespace lanescape::capi

using namespace lanescape;

const char* lanescape_last_error(void) { return capi::last_message.data(); }
int lanescape_last_callback_error(void) { return capi::last_callback_code; }
