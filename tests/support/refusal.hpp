#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"

namespace lanescape::testing {

// The message with which `action` refuses its input. The test fails if it does not refuse it, or if the message has more than one
// line.
template <class Action>
std::string refusal(Action action, ErrorCode code = ErrorCode::bad_input) {
  try {
    action();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), code) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

}  // namespace lanescape::testing
