#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>

namespace lanescape::testing {

// What became of a system on one instruction set or through one host.
enum class Outcome { right, refused, undecided, wrong };

// How many random systems a test looks at, and from which number on:
//   LANESCAPE_RANDOM_CONFIGURATIONS=100000   so many
//   LANESCAPE_RANDOM_SECONDS=600             as many as there is time for, from a number that the clock gives
//   LANESCAPE_RANDOM_FIRST=123456            from this number on, else from 0
// Without these a test takes as many as fit into some seconds.
class RandomRun {
 public:
  explicit RandomRun(double usual_seconds) {
    count_ = number("LANESCAPE_RANDOM_CONFIGURATIONS");
    const std::optional<std::uint64_t> asked = number("LANESCAPE_RANDOM_SECONDS");
    if (!count_) seconds_ = asked ? static_cast<double>(*asked) : usual_seconds;
    stops_at_failure_ = !count_ && !asked;
    if (asked) first_ = static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count()) >> 20 << 20;
    first_ = number("LANESCAPE_RANDOM_FIRST").value_or(first_);
  }

  // Calls check(number, add), which calls add(outcome) for each result.
  template <class Check>
  void for_each(const char* systems, Check check) {
    std::cout << fmt::format("{} from number {} on", systems, first_) << std::endl;
    std::uint64_t made = 0;
    for (; count_ ? made < *count_ : made < least || passed() < *seconds_; ++made) {
      check(first_ + made, [&](Outcome outcome) { ++outcomes_[static_cast<std::size_t>(outcome)]; });
      if (stops_at_failure_ && ::testing::Test::HasFailure()) break;
    }
    std::cout << fmt::format("{} {}, results: {} right, {} refused, {} decided by rounding, {} wrong\n", made, systems,
                             of(Outcome::right), of(Outcome::refused), of(Outcome::undecided), of(Outcome::wrong));
    EXPECT_GT(of(Outcome::right), 3 * (of(Outcome::refused) + of(Outcome::undecided))) << "too few can be compared";
    EXPECT_EQ(of(Outcome::wrong), 0U);
  }

 private:
  static constexpr std::uint64_t least = 20;  // systems, however slow they are
  static std::optional<std::uint64_t> number(const char* name) {
    const char* given = std::getenv(name);
    return given != nullptr ? std::optional<std::uint64_t>(std::strtoull(given, nullptr, 10)) : std::nullopt;
  }
  double passed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count(); }
  std::uint64_t of(Outcome outcome) const { return outcomes_[static_cast<std::size_t>(outcome)]; }

  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::optional<std::uint64_t> count_;
  std::optional<double> seconds_;
  std::uint64_t first_ = 0;
  bool stops_at_failure_ = true;
  std::array<std::uint64_t, 4> outcomes_{};
};

}  // namespace lanescape::testing
