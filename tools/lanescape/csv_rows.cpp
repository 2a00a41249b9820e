#include "csv_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "core/error.hpp"

namespace lanescape::program {
namespace {

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
}

// Cuts the first line off the text.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

}  // namespace

double CsvRow::number(std::size_t column) const {
  const std::string_view field = fields_[column];
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
    throw_bad_input(fmt::format("{}:{}: '{}' is no finite number", file_.string(), line_, field.substr(0, 40)));
  return value;
}

std::string read_text_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) throw_bad_input(fmt::format("{}: cannot be read", file.string()));
  return {std::istreambuf_iterator<char>(in), {}};
}

void for_each_csv_row(const std::filesystem::path& file, const std::string& header,
                      const std::function<void(const CsvRow&)>& take) {
  const std::string content = read_text_file(file);
  std::string_view rest = content;
  if (take_line(rest) != header) throw_bad_input(fmt::format("{}:1: the columns {} are needed", file.string(), header));
  const auto columns = static_cast<std::size_t>(std::count(header.begin(), header.end(), ',')) + 1;
  std::vector<std::string_view> fields;
  for (std::size_t line = 2; !rest.empty(); ++line) {
    const bool whole = rest.find('\n') != std::string_view::npos;
    split(take_line(rest), fields);
    if (!whole || fields.size() != columns)
      throw_bad_input(fmt::format("{}:{}: a whole row of {} columns is needed", file.string(), line, columns));
    take(CsvRow(file, line, fields));
  }
}

}  // namespace lanescape::program
