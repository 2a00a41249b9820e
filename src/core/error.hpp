#pragma once

#include <lanescape/error.hpp>

#include <string>

namespace lanescape {

[[noreturn]] inline void throw_bad_input(const std::string& message) { throw Error(ErrorCode::bad_input, message); }

}  // namespace lanescape
