#include "io/xyz_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace lanescape::xyz {
namespace {

constexpr std::size_t most_columns = 1000;
constexpr double farthest_box_lengths = 1e6;  // beyond, wrapping leaves too few digits

// One name:type:columns triplet.
struct Entry {
  std::string_view name, type, columns;

  std::optional<std::size_t> width() const { return parse<std::size_t>(columns); }
  bool is(char expected_type, std::size_t expected_width) const {
    return type.size() == 1 && type[0] == expected_type && width() == expected_width;
  }
  bool has_known_type() const { return type.size() == 1 && std::string_view("SRIL").find(type) != std::string_view::npos; }
};

std::string allowed_properties(SizeColumn size) {
  const std::string wanted = size == SizeColumn::ignored ? " and pos:R:3" : fmt::format(", pos:R:3 and {}:R:1", name_of(size));
  return fmt::format("name:type:columns triplets with species:S:1{} are needed, types S, R, I, L", wanted);
}

void check_entry(const Entry& entry, std::size_t columns_before, SizeColumn size) {
  const auto width = entry.width();
  const bool fits = width && *width > 0 && columns_before + std::min(*width, most_columns + 1) <= most_columns;
  const bool is_size = size != SizeColumn::ignored && entry.name == name_of(size);
  if (entry.name.empty() || !entry.has_known_type() || !fits || (entry.name == "species" && !entry.is('S', 1)) ||
      (entry.name == "pos" && !entry.is('R', 3)) || (is_size && !entry.is('R', 1)))
    throw Refusal{fmt::format("Properties entry {}:{}:{} is not allowed: {}, at most {} columns", printable(entry.name),
                              printable(entry.type), printable(entry.columns), allowed_properties(size), most_columns)};
}

double parse_coordinate(std::string_view word, double edge) {
  const double x = parse_finite(word, "coordinate");
  if (std::abs(x) > farthest_box_lengths * edge)
    throw Refusal{fmt::format("coordinate {} is not allowed: at most {} box lengths of {} are", x, farthest_box_lengths, edge)};
  return x;
}

}  // namespace

std::string_view name_of(SizeColumn size) {
  switch (size) {
    case SizeColumn::ignored:
      return "";
    case SizeColumn::radius:
      return "radius";
    case SizeColumn::diameter:
      return "diameter";
  }
  return "";
}

std::string properties_example(SizeColumn size) {
  const std::string plain = "Properties=species:S:1:pos:R:3";
  return size == SizeColumn::ignored ? plain : fmt::format("{}:{}:R:1", plain, name_of(size));
}

Columns parse_properties(std::string_view text, SizeColumn size) {
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() % 3 != 0)
    throw Refusal{fmt::format("Properties {} is not allowed: {}", printable(text), allowed_properties(size))};
  Columns columns;
  std::size_t species = 0, positions = 0, sizes = 0;
  for (std::size_t p = 0; p < parts.size(); p += 3) {
    const Entry entry{parts[p], parts[p + 1], parts[p + 2]};
    check_entry(entry, columns.count, size);
    if (entry.name == "species") ++species, columns.species = columns.count;
    if (entry.name == "pos") ++positions, columns.position = columns.count;
    if (size != SizeColumn::ignored && entry.name == name_of(size)) ++sizes, columns.size = columns.count;
    columns.count += *entry.width();
  }
  if (species != 1 || positions != 1)
    throw Refusal{fmt::format("Properties {} has species {} and pos {}: {}, each once", printable(text), counted(species, "time"),
                              counted(positions, "time"), allowed_properties(size))};
  if (size != SizeColumn::ignored && sizes != 1)
    throw Refusal{fmt::format("Properties {} has {} {}: {} need {}:R:1 once, each value finite and above 0", printable(text),
                              name_of(size), counted(sizes, "time"),
                              size == SizeColumn::radius ? "hard spheres" : "polydisperse models", name_of(size))};
  return columns;
}

Particle parse_particle(std::string_view line, const Columns& columns, SizeColumn size, const Box& box) {
  Particle particle;
  std::size_t column = 0;
  for (std::string_view word; !(word = take_word(line)).empty(); ++column) {
    if (column == columns.species) particle.species = word;
    if (column == columns.size) particle.size = parse_positive(word, name_of(size));
    if (column >= columns.position && column < columns.position + 3) {
      const std::size_t axis = column - columns.position;
      particle.position[axis] = parse_coordinate(word, box.length[axis]);
    }
  }
  if (column != columns.count)
    throw Refusal{fmt::format("a particle line of {} is not allowed: Properties has {}", counted(column, "column"), columns.count)};
  return particle;
}

}  // namespace lanescape::xyz
