#include "result_table.hpp"

#include <ostream>

namespace lanescape::program {

namespace {

// JSON has no number for what is not defined, tables have.
std::string text_of(const Json& value, const std::string& missing) {
  if (value.is_null()) return missing;
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

Json to_json(const ResultTable& table) {
  Json json = Json::array();
  for (const ResultRow& row : table) {
    Json object;
    for (const auto& [column, value] : row) object[column] = value;
    json.push_back(std::move(object));
  }
  return json;
}

void write_table(OutputFolder& folder, const std::string& name, const ResultTable& table, const std::string& missing) {
  if (table.empty()) return;
  folder.write(name, [&](std::ostream& out) {
    const char* comma = "";
    for (const auto& [column, value] : table.front()) out << std::exchange(comma, ",") << column;
    out << '\n';
    for (const ResultRow& row : table) {
      comma = "";
      for (const auto& [column, value] : row) out << std::exchange(comma, ",") << text_of(value, missing);
      out << '\n';
    }
  });
}

}  // namespace lanescape::program
