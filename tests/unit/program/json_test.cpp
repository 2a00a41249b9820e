#include "json.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.hpp"

namespace lanescape::program {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

std::string refusal_of(const Json& result) {
  try {
    return "printed: " + text_of_result(result);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::internal);
    return error.what();
  }
}

TEST(ResultJson, NegativeZerosArePrintedAsZero) {
  const Json result = {{"a", -0.0}, {"b", {{"c", {1.5, -0.0}}}}, {"d", -1.0}, {"e", 0}};
  EXPECT_EQ(Json::parse(text_of_result(result)).dump(), R"({"a":0.0,"b":{"c":[1.5,0.0]},"d":-1.0,"e":0})");
}

TEST(ResultJson, ANumberThatIsNotFiniteIsRefusedWithItsKey) {
  EXPECT_EQ(refusal_of({{"energy", nan}, {"virial", infinity}}), "energy is not finite: no result is printed");
  EXPECT_EQ(refusal_of({{"energy", 1.0}, {"stress", {0.0, -infinity}}}), "stress[1] is not finite: no result is printed");
  Json paths;
  paths["paths"].push_back({{"length", 1.0}});
  paths["paths"].push_back({{"mean", {{"alpha", nan}}}});
  EXPECT_EQ(refusal_of(paths), "paths[1].mean.alpha is not finite: no result is printed");
  Json forces;
  forces["forces"] = {{1.0, 2.0}, {3.0, nan}};
  EXPECT_EQ(refusal_of(forces), "forces[1][1] is not finite: no result is printed");
}

TEST(ResultJson, NullsAreAllowed) {
  Json result;
  result["standard_error"] = Json();
  result["compressibility"] = number_or_null(nan);
  result["gap"] = number_or_null(0.5);
  EXPECT_EQ(Json::parse(text_of_result(result)).dump(), R"({"standard_error":null,"compressibility":null,"gap":0.5})");
}

}  // namespace
}  // namespace lanescape::program
