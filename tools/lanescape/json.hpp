#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace lanescape::program {

using Json = nlohmann::ordered_json;

}  // namespace lanescape::program

// Compiled once, in json.cpp.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace lanescape::program {

// A result as it is printed and kept in result.json. Negative zeros are written as 0.0. Throws Error(internal) that names the key
// of a number that is not finite: such a result is never printed as a success. Nulls are allowed.
std::string text_of_result(Json result);

// For values that may be undefined, such as a mean over nothing: the number, or null if it is not finite.
inline Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(); }

}  // namespace lanescape::program
