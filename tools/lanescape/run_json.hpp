#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "json.hpp"

namespace lanescape::program {

// One object within the result.json of a run, with the name that messages give it: "DIR/result.json: paths[0]".
class RunJson {
 public:
  RunJson(const Json& json, std::string where) : json_(&json), where_(std::move(where)) {}

  bool has(const char* key) const { return json_->is_object() && json_->contains(key) && !(*json_)[key].is_null(); }
  // These throw Error(bad_input) where there is no such number, text or object; `in` and the numbers that may be missing do so only
  // for one of another type.
  double number(const char* key) const;
  std::optional<double> optional_number(const char* key) const;
  std::string text(const char* key) const;
  RunJson in(const char* key) const;
  // Elements of a list, or of an object with their keys; nothing for a missing one.
  std::vector<RunJson> list(const char* key) const;
  std::vector<std::pair<std::string, RunJson>> entries(const char* key) const;
  std::vector<double> numbers(const char* key) const;
  const std::string& where() const { return where_; }
  // As an element of an object of numbers.
  double own_number() const;

 private:
  [[noreturn]] void refuse(const char* key, const char* wanted) const;
  const Json* json_;
  std::string where_;
};

// Throws Error(bad_input) unless the file holds one JSON object.
Json read_json_object(const std::filesystem::path& file);

}  // namespace lanescape::program
