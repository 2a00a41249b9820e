#include "json.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace lanescape::program {
namespace {

// Makes negative zeros positive. False at a number that is not finite; `key` is then its path within `value`: "stress[2]".
bool make_printable(Json& value, std::string& key) {
  if (value.is_number_float()) {
    double& x = value.get_ref<double&>();
    if (x == 0.0) x = 0.0;
    return std::isfinite(x);
  }
  const auto prefix = [&](const std::string& name) { key = name + (key.empty() || key.front() == '[' ? "" : ".") + key; };
  if (value.is_object())
    for (auto& [name, inner] : value.items())
      if (!make_printable(inner, key)) {
        prefix(name);
        return false;
      }
  if (value.is_array())
    for (std::size_t k = 0; k < value.size(); ++k)
      if (!make_printable(value[k], key)) {
        prefix(fmt::format("[{}]", k));
        return false;
      }
  return true;
}

}  // namespace

std::string text_of_result(Json result) {
  std::string key;
  if (!make_printable(result, key)) throw Error(ErrorCode::internal, fmt::format("{} is not finite: no result is printed", key));
  return result.dump(2);
}

}  // namespace lanescape::program
