#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lanescape::program {

// One row of a table of a run, with what its messages need.
class CsvRow {
 public:
  CsvRow(const std::filesystem::path& file, std::size_t line, std::span<const std::string_view> fields)
      : file_(file), line_(line), fields_(fields) {}
  std::string_view text(std::size_t column) const { return fields_[column]; }
  // Throws Error(bad_input) with file and line unless the field is a finite number.
  double number(std::size_t column) const;

 private:
  const std::filesystem::path& file_;
  std::size_t line_;
  std::span<const std::string_view> fields_;
};

// Calls `take` for each row below the header, which must name exactly these columns. Throws Error(bad_input) with file and line for
// a file that cannot be read, another header, or a row of another length.
void for_each_csv_row(const std::filesystem::path& file, const std::string& header, const std::function<void(const CsvRow&)>& take);

// The content of a file of a run; throws Error(bad_input) for one that cannot be read.
std::string read_text_file(const std::filesystem::path& file);

}  // namespace lanescape::program
