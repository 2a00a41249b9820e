#include "run_json.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "csv_rows.hpp"

namespace lanescape::program {

void RunJson::refuse(const char* key, const char* wanted) const {
  throw_bad_input(fmt::format("{}: {} is missing or of another kind: {} is needed", where_, key, wanted));
}

double RunJson::number(const char* key) const {
  if (!has(key) || !(*json_)[key].is_number()) refuse(key, "a number");
  return (*json_)[key].get<double>();
}

std::optional<double> RunJson::optional_number(const char* key) const {
  return has(key) ? std::optional(number(key)) : std::nullopt;
}

std::string RunJson::text(const char* key) const {
  if (!has(key) || !(*json_)[key].is_string()) refuse(key, "a text");
  return (*json_)[key].get<std::string>();
}

RunJson RunJson::in(const char* key) const {
  static const Json nothing = Json::object();
  if (!has(key)) return {nothing, fmt::format("{}.{}", where_, key)};
  if (!(*json_)[key].is_object()) refuse(key, "an object");
  return {(*json_)[key], fmt::format("{}.{}", where_, key)};
}

std::vector<RunJson> RunJson::list(const char* key) const {
  std::vector<RunJson> elements;
  if (!has(key)) return elements;
  const Json& array = (*json_)[key];
  if (!array.is_array()) refuse(key, "a list");
  for (std::size_t k = 0; k < array.size(); ++k) elements.emplace_back(array[k], fmt::format("{}: {}[{}]", where_, key, k));
  return elements;
}

std::vector<std::pair<std::string, RunJson>> RunJson::entries(const char* key) const {
  std::vector<std::pair<std::string, RunJson>> found;
  if (!has(key)) return found;
  const Json& object = (*json_)[key];
  if (!object.is_object()) refuse(key, "an object");
  for (const auto& [name, value] : object.items())
    found.emplace_back(name, RunJson(value, fmt::format("{}: {}.{}", where_, key, name)));
  return found;
}

double RunJson::own_number() const {
  if (!json_->is_number()) throw_bad_input(fmt::format("{}: a number is needed", where_));
  return json_->get<double>();
}

std::vector<double> RunJson::numbers(const char* key) const {
  std::vector<double> values;
  for (const RunJson& element : list(key)) values.push_back(element.own_number());
  return values;
}

Json read_json_object(const std::filesystem::path& file) {
  Json json = Json::parse(read_text_file(file), nullptr, false);
  if (!json.is_object()) throw_bad_input(fmt::format("{}: it is damaged: one JSON object is needed", file.string()));
  return json;
}

}  // namespace lanescape::program
