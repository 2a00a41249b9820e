#include "dispatch/isa.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

#include "core/error.hpp"

namespace lanescape {
namespace {

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
  const auto isas = available_isas();
  ASSERT_FALSE(isas.empty());
  EXPECT_TRUE(std::is_sorted(isas.begin(), isas.end()));
  for (const char* request : {"auto", ""})
    for (const char* environment : {"auto", ""}) EXPECT_EQ(choose_isa(request, environment), isas.back());
}

TEST(ChooseIsa, FindsEveryAvailableOneByItsName) {
  for (const Isa isa : available_isas()) EXPECT_EQ(choose_isa(to_string(isa), ""), isa) << to_string(isa);
}

TEST(ChooseIsa, RefusesAnUnknownNameAndListsTheKnownOnes) {
  for (const char* name : {"avx1024", "AVX2", "avx2 ", "neon"}) {
    const std::string message = bad_input_of([&] { choose_isa(name, ""); });
    EXPECT_EQ(message.find("unknown instruction set "), 0U) << message;
    EXPECT_NE(message.find("'" + std::string(name) + "'"), std::string::npos) << message;
    for (const Isa isa : available_isas()) EXPECT_NE(message.find(to_string(isa)), std::string::npos) << message;
  }
}

TEST(ChooseIsa, NeverFallsBackFromOneThatIsNotThere) {
  const auto missing = missing_isa();
  if (!missing) GTEST_SKIP() << "every instruction set is compiled in and supported by this processor";
  const std::string name = to_string(*missing);
  EXPECT_EQ(bad_input_of([&] { choose_isa(name, ""); }).find("instruction set " + name + " is not available"), 0U);
  EXPECT_EQ(bad_input_of([&] { choose_isa("auto", name); }).find("LANESCAPE_ISA: instruction set " + name), 0U);
  EXPECT_NE(bad_input_of([&] { kernel_table(*missing); }).find(name), std::string::npos);
}

TEST(ChooseIsa, HonoursTheEnvironment) {
  for (const Isa isa : available_isas())
    for (const char* request : {"auto", ""}) EXPECT_EQ(choose_isa(request, to_string(isa)), isa);
}

TEST(ChooseIsa, NamesTheEnvironmentWhereItIsWrong) {
  const std::string message = bad_input_of([] { choose_isa("auto", "pentium"); });
  EXPECT_EQ(message.find("LANESCAPE_ISA: "), 0U) << message;
  EXPECT_NE(message.find("'pentium'"), std::string::npos) << message;
}

TEST(ChooseIsa, LetsTheRequestWinOverTheEnvironment) {
  const auto isas = available_isas();
  for (const Isa requested : isas) {
    for (const Isa other : isas)
      EXPECT_EQ(choose_isa(to_string(requested), to_string(other)), requested)
          << to_string(requested) << " over " << to_string(other);
    EXPECT_EQ(choose_isa(to_string(requested), "pentium"), requested);
  }
}

// Hosts may change their environment in one thread while another one calls the library: it is read once.
TEST(ChooseIsa, DoesNotSeeLaterChangesOfTheEnvironment) {
  const std::string before = isa_of_environment();
  ASSERT_EQ(setenv("LANESCAPE_ISA", "pentium", 1), 0);
  EXPECT_EQ(isa_of_environment(), before);
  EXPECT_EQ(choose_isa("auto"), choose_isa("auto", before));
  before.empty() ? unsetenv("LANESCAPE_ISA") : setenv("LANESCAPE_ISA", before.c_str(), 1);
}

// What a host's early constructor sees: it may run before libgcc has looked at the processor.
unsigned seen_early = 0;  // a bit for each; zero before any constructor
__attribute__((constructor(101))) void look_early() {
  for (const Isa isa : available_isas()) seen_early |= 1U << static_cast<unsigned>(isa);
}

TEST(AvailableIsas, AreCompleteInAnEarlyConstructor) {
  unsigned expected = 0;
#define LANESCAPE_ENTRY(name, supported) \
  if (supported) expected |= 1U << static_cast<unsigned>(Isa::name);
  LANESCAPE_BUILT_INSTRUCTION_SETS(LANESCAPE_ENTRY)
#undef LANESCAPE_ENTRY
  EXPECT_EQ(seen_early, expected);
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
