#pragma once

#include <string>
#include <utility>
#include <vector>

#include "program.hpp"

namespace lanescape::program {

// Names and values of one row, for JSON and for the columns of a file alike.
using ResultRow = std::vector<std::pair<std::string, Json>>;
using ResultTable = std::vector<ResultRow>;

template <class Rows, class RowOf>
ResultTable table_of(const Rows& rows, RowOf row_of) {
  ResultTable table;
  for (const auto& row : rows) table.push_back(row_of(row));
  return table;
}

// A list of objects.
Json to_json(const ResultTable& table);
// Comma-separated, with the names in the first line and `missing` in place of nulls. Writes nothing if there are no rows.
void write_table(OutputFolder& folder, const std::string& name, const ResultTable& table, const std::string& missing = "nan");

}  // namespace lanescape::program
