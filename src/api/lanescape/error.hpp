#pragma once

#include <stdexcept>
#include <string>

#include <lanescape/export.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// One set of codes for exceptions, C status values and exit statuses.
enum class ErrorCode : int {
  goal_not_reached = 1,  // the run was sound but ended at a limit
  bad_input = 2,         // the caller's data or options
  internal = 3,          // a defect of the library, or no memory
  interrupted = 4,       // the caller or a signal ended it before it was done
};

// Thrown wherever the library cannot continue. The message is one line that says what, where and what is allowed.
class LANESCAPE_API Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

LANESCAPE_ABI_END
}  // namespace lanescape
