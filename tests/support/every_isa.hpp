#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "dispatch/isa.hpp"

namespace lanescape::testing {

// A test for each instruction set; unavailable ones are skipped with the reason.
class EveryIsa : public ::testing::TestWithParam<Isa> {
 protected:
  void SetUp() override {
    const auto isas = available_isas();
    if (std::find(isas.begin(), isas.end(), GetParam()) == isas.end())
      GTEST_SKIP() << to_string(GetParam()) << " is not compiled in or not supported by this processor";
  }
};

inline auto all_isas() { return ::testing::ValuesIn(every_isa); }
inline auto isa_name = [](const auto& tested) { return to_string(tested.param); };

}  // namespace lanescape::testing
