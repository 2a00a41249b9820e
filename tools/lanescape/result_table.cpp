#include "result_table.hpp"

#include <ostream>

namespace lanescape::program {

Json to_json(const ResultTable& table) {
  Json json = Json::array();
  for (const ResultRow& row : table) {
    Json object;
    for (const auto& [column, value] : row) object[column] = value;
    json.push_back(std::move(object));
  }
  return json;
}

void write_table(OutputFolder& folder, const std::string& name, const ResultTable& table) {
  if (table.empty()) return;
  folder.write(name, [&](std::ostream& out) {
    const char* comma = "";
    for (const auto& [column, value] : table.front()) out << std::exchange(comma, ",") << column;
    out << '\n';
    for (const ResultRow& row : table) {
      comma = "";
      for (const auto& [column, value] : row)
        out << std::exchange(comma, ",") << (value.is_string() ? value.get<std::string>() : value.dump());
      out << '\n';
    }
  });
}

}  // namespace lanescape::program
