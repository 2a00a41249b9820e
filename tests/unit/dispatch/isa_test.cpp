#include "dispatch/isa.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

#include "core/error.hpp"

namespace lanescape {
namespace {

// Sets or unsets LANESCAPE_ISA and restores the previous value at the end.
class Environment {
 public:
  explicit Environment(const char* value) {
    if (const char* before = std::getenv(name)) before_ = before;
    set(value);
  }
  ~Environment() { set(before_ ? before_->c_str() : nullptr); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  static constexpr const char* name = "LANESCAPE_ISA";
  static void set(const char* value) { value ? setenv(name, value, 1) : unsetenv(name); }
  std::optional<std::string> before_;
};

bool is_available(Isa isa) {
  const auto isas = available_isas();
  return std::find(isas.begin(), isas.end(), isa) != isas.end();
}

std::optional<Isa> missing_isa() {
  for (const Isa isa : every_isa)
    if (!is_available(isa)) return isa;
  return std::nullopt;
}

// The message of the Error(bad_input) that a call throws.
template <class Call>
std::string bad_input_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

TEST(ChooseIsa, TakesTheBestWhenNothingIsAsked) {
  const Environment environment(nullptr);
  const auto isas = available_isas();
  ASSERT_FALSE(isas.empty());
  EXPECT_TRUE(std::is_sorted(isas.begin(), isas.end()));
  EXPECT_EQ(choose_isa("auto"), isas.back());
  EXPECT_EQ(choose_isa(""), isas.back());
}

TEST(ChooseIsa, FindsEveryAvailableOneByItsName) {
  const Environment environment(nullptr);
  for (const Isa isa : available_isas()) EXPECT_EQ(choose_isa(to_string(isa)), isa) << to_string(isa);
}

TEST(ChooseIsa, RefusesAnUnknownNameAndListsTheKnownOnes) {
  const Environment environment(nullptr);
  for (const char* name : {"avx1024", "AVX2", "avx2 ", "neon"}) {
    const std::string message = bad_input_of([&] { choose_isa(name); });
    EXPECT_NE(message.find("--isa"), std::string::npos) << message;
    EXPECT_NE(message.find("'" + std::string(name) + "'"), std::string::npos) << message;
    for (const Isa isa : available_isas()) EXPECT_NE(message.find(to_string(isa)), std::string::npos) << message;
  }
}

TEST(ChooseIsa, NeverFallsBackFromOneThatIsNotThere) {
  const auto missing = missing_isa();
  if (!missing) GTEST_SKIP() << "every instruction set is compiled in and supported by this processor";
  const std::string name = to_string(*missing);
  const Environment unset(nullptr);
  EXPECT_NE(bad_input_of([&] { choose_isa(name); }).find("--isa: instruction set " + name + " is not available"),
            std::string::npos);
  const Environment set(name.c_str());
  EXPECT_NE(bad_input_of([&] { choose_isa("auto"); }).find("LANESCAPE_ISA: instruction set " + name), std::string::npos);
  EXPECT_NE(bad_input_of([&] { kernel_table(*missing); }).find(name), std::string::npos);
}

TEST(ChooseIsa, HonoursTheEnvironment) {
  for (const Isa isa : available_isas()) {
    const Environment environment(to_string(isa));
    EXPECT_EQ(choose_isa("auto"), isa);
    EXPECT_EQ(choose_isa(""), isa);
  }
}

TEST(ChooseIsa, TakesAnEmptyOrAutomaticEnvironmentForNone) {
  for (const char* value : {"", "auto"}) {
    const Environment environment(value);
    EXPECT_EQ(choose_isa("auto"), available_isas().back()) << '"' << value << '"';
  }
}

TEST(ChooseIsa, NamesTheEnvironmentWhereItIsWrong) {
  const Environment environment("pentium");
  const std::string message = bad_input_of([] { choose_isa("auto"); });
  EXPECT_NE(message.find("LANESCAPE_ISA"), std::string::npos) << message;
  EXPECT_NE(message.find("'pentium'"), std::string::npos) << message;
}

TEST(ChooseIsa, LetsTheRequestWinOverTheEnvironment) {
  const auto isas = available_isas();
  for (const Isa requested : isas) {
    for (const Isa other : isas) {
      const Environment environment(to_string(other));
      EXPECT_EQ(choose_isa(to_string(requested)), requested) << to_string(requested) << " over " << to_string(other);
    }
    const Environment wrong("pentium");
    EXPECT_EQ(choose_isa(to_string(requested)), requested);
  }
}

TEST(AvailableIsas, StartWithThePortableOneWhichIsNeverTheBestOnX86) {
#if defined(__x86_64__)
  const auto isas = available_isas();
  EXPECT_TRUE(isas.back() != Isa::generic || !is_available(Isa::sse2));
  EXPECT_TRUE(isas.front() == Isa::generic || !is_available(Isa::generic));
#else
  EXPECT_EQ(available_isas(), std::vector{Isa::generic});
#endif
}

TEST(KernelTable, CarriesTheNameOfItsInstructionSet) {
  for (const Isa isa : available_isas()) EXPECT_STREQ(kernel_table(isa).name, to_string(isa));
}

TEST(KernelTable, HasAllItsKernels) {
  for (const Isa isa : available_isas()) {
    const kernels::KernelTable& table = kernel_table(isa);
    EXPECT_TRUE(table.pair[0] && table.pair[0]->energy && table.pair[0]->gradient && table.pair[0]->stress && table.dot &&
                table.distance_squared && table.difference && table.combine && table.axpy && table.displacement_moments &&
                table.peak_rounds)
        << table.name;
    EXPECT_EQ(kernels::slot_padding % table.lanes, 0U) << table.name;
  }
}

}  // namespace
}  // namespace lanescape
