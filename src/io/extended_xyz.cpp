#include "io/extended_xyz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace lanescape {
namespace {

constexpr std::size_t most_particles = 10'000'000;
constexpr std::size_t longest_line = std::size_t{1} << 20;  // [bytes]; keeps a file without line ends out of memory
constexpr std::size_t most_columns = 1000;
constexpr std::size_t most_species = 118;         // where any are taken; there are no more elements
constexpr double farthest_box_lengths = 1e6;      // beyond, wrapping leaves too few digits
constexpr double orthorhombic_tolerance = 1e-12;  // of the edge; what rotating a cell to the axes leaves behind
constexpr std::string_view blanks = " \t";

// What is wrong with a piece of text; the reader adds file and line.
struct Refusal {
  std::string message;
};

// Text of the file as part of a one-line message.
std::string printable(std::string_view text) {
  std::string result(text.substr(0, 40));
  for (char& c : result)
    if (std::iscntrl(static_cast<unsigned char>(c))) c = '?';
  return text.size() > result.size() ? result + "..." : result;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// Cuts the first word off `rest`; empty at the end.
std::string_view take_word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
  const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
  rest.remove_prefix(word.size());
  return word;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end; (end = text.find(separator)) != std::string_view::npos; text.remove_prefix(end + 1))
    parts.push_back(text.substr(0, end));
  parts.push_back(text);
  return parts;
}

template <class Number>
std::optional<Number> parse(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);  // from_chars knows no plus sign
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

double parse_finite(std::string_view word, std::string_view what) {
  const auto value = parse<double>(word);
  if (!value || !std::isfinite(*value))
    throw Refusal{fmt::format("{} '{}' is not allowed: a finite number is needed", what, printable(word))};
  return *value;
}

// A value in quotes, with backslash escapes.
std::string take_quoted(std::string_view& rest) {
  const char quote = rest.front();
  std::string value;
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] == quote) {
      rest.remove_prefix(i + 1);
      return value;
    }
    if (rest[i] == '\\' && i + 1 < rest.size()) {
      ++i;
      value += rest[i] == 'n' ? '\n' : rest[i];
    } else {
      value += rest[i];
    }
  }
  throw Refusal{fmt::format("quote without an end at {}: a value is closed by the quote that opens it", printable(rest))};
}

// An array in brackets or braces, kept as text.
std::string take_bracketed(std::string_view& rest) {
  int depth = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == '[' || rest[i] == '{') ++depth;
    if (rest[i] == ']' || rest[i] == '}') --depth;
    if (depth == 0) {
      std::string value(rest.substr(0, i + 1));
      rest.remove_prefix(i + 1);
      return value;
    }
  }
  throw Refusal{fmt::format("bracket without an end at {}: a value is closed by the bracket that opens it", printable(rest))};
}

std::string take_value(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
  if (rest.empty()) throw Refusal{"key without a value at the end of the comment line: key=value is needed"};
  if (rest[0] == '"' || rest[0] == '\'') return take_quoted(rest);
  if (rest[0] == '[' || rest[0] == '{') return take_bracketed(rest);
  return std::string(take_word(rest));
}

using Info = std::map<std::string, std::string>;

// The comment line's pairs; the three keys with a meaning come in lower case.
Info parse_comment(std::string_view rest) {
  Info info;
  for (;;) {
    rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    if (rest.empty()) return info;
    std::string key;
    if (rest[0] == '"' || rest[0] == '\'') {
      key = take_quoted(rest);
    } else {
      key = rest.substr(0, rest.find_first_of(" \t="));
      rest.remove_prefix(key.size());
    }
    if (key.empty()) throw Refusal{fmt::format("value without a key at '{}': key=value is needed", printable(rest))};
    if (const std::string name = lower(key); name == "lattice" || name == "properties" || name == "pbc") key = name;
    const std::size_t next = rest.find_first_not_of(blanks);
    if (next == std::string_view::npos || rest[next] != '=') {
      info.emplace(std::move(key), "T");
      continue;
    }
    rest.remove_prefix(next + 1);
    std::string value = take_value(rest);
    if (!info.emplace(key, std::move(value)).second)
      throw Refusal{fmt::format("{} is given twice: each key once is allowed", printable(key))};
  }
}

std::string take_key(Info& info, const char* key, const char* example) {
  auto node = info.extract(key);
  if (!node) throw Refusal{fmt::format("the comment line has no {}: {} is needed", example, example)};
  return std::move(node.mapped());
}

Box parse_lattice(std::string_view text) {
  constexpr std::string_view allowed =
      "nine numbers of an orthorhombic box are needed, \"Lx 0 0 0 Ly 0 0 0 Lz\" with edges above 0";
  // {...} and [...] are older spellings of the quotes.
  if (text.size() >= 2 && (text.front() == '{' || text.front() == '[')) text = text.substr(1, text.size() - 2);
  std::vector<double> cell;
  for (std::string_view word; !(word = take_word(text)).empty();) {
    if (cell.size() == 9) throw Refusal{fmt::format("Lattice has more than 9 numbers: {}", allowed)};
    cell.push_back(parse_finite(word, "Lattice component"));
  }
  if (cell.size() != 9) throw Refusal{fmt::format("Lattice has {} numbers: {}", cell.size(), allowed)};
  Box box;
  for (std::size_t row = 0; row < 3; ++row) {
    box.length[row] = cell[4 * row];
    if (!(box.length[row] > 0.0)) throw Refusal{fmt::format("Lattice edge {} is {}: {}", row + 1, box.length[row], allowed)};
    for (std::size_t column = 0; column < 3; ++column)
      if (column != row && std::abs(cell[3 * row + column]) > orthorhombic_tolerance * box.length[row])
        throw Refusal{
            fmt::format("Lattice is not orthorhombic, vector {} has a component {}: {}", row + 1, cell[3 * row + column], allowed)};
  }
  return box;
}

void check_periodic(std::string_view text) {
  const std::string_view whole = text;
  int axes = 0;
  bool periodic = true;
  if (text.size() >= 2 && (text.front() == '{' || text.front() == '[')) text = text.substr(1, text.size() - 2);
  for (std::string_view word; !(word = take_word(text)).empty(); ++axes)
    periodic = periodic && (lower(word) == "t" || lower(word) == "true");
  if (axes != 3 || !periodic)
    throw Refusal{fmt::format("pbc \"{}\" is not allowed: the box must be periodic along all axes, \"T T T\"", printable(whole))};
}

const char* properties_example(RadiusColumn radius) {
  return radius == RadiusColumn::required ? "Properties=species:S:1:pos:R:3:radius:R:1" : "Properties=species:S:1:pos:R:3";
}

struct Columns {
  std::size_t count = 0;
  std::size_t species = 0;   // index of the column
  std::size_t position = 0;  // of the first of three
  std::optional<std::size_t> radius;
};

Columns parse_properties(std::string_view text, RadiusColumn radius_column) {
  const bool with_radius = radius_column == RadiusColumn::required;
  const std::string allowed = fmt::format("name:type:columns triplets with species:S:1{} are needed, types S, R, I, L",
                                          with_radius ? ", pos:R:3 and radius:R:1" : " and pos:R:3");
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() % 3 != 0) throw Refusal{fmt::format("Properties {} is not allowed: {}", printable(text), allowed)};
  Columns columns;
  int species = 0, positions = 0, radii = 0;
  for (std::size_t p = 0; p < parts.size(); p += 3) {
    const std::string_view name = parts[p], type = parts[p + 1];
    const auto width = parse<std::size_t>(parts[p + 2]);
    const bool known_type = type.size() == 1 && std::string_view("SRIL").find(type) != std::string_view::npos;
    const bool fits = width && *width > 0 && columns.count + std::min(*width, most_columns + 1) <= most_columns;
    const bool is_species = name == "species", is_position = name == "pos", is_radius = with_radius && name == "radius";
    if (name.empty() || !known_type || !fits || (is_species && (type != "S" || *width != 1)) ||
        (is_position && (type != "R" || *width != 3)) || (is_radius && (type != "R" || *width != 1)))
      throw Refusal{fmt::format("Properties entry {}:{}:{} is not allowed: {}, at most {} columns", printable(name),
                                printable(type), printable(parts[p + 2]), allowed, most_columns)};
    if (is_species) ++species, columns.species = columns.count;
    if (is_position) ++positions, columns.position = columns.count;
    if (is_radius) ++radii, columns.radius = columns.count;
    columns.count += *width;
  }
  if (species != 1 || positions != 1)
    throw Refusal{fmt::format("Properties {} has species {} times and pos {} times: {}, each once", printable(text), species,
                              positions, allowed)};
  if (with_radius && radii != 1)
    throw Refusal{fmt::format("Properties {} has radius {} times: hard spheres need radius:R:1 once, each value finite and above 0",
                              printable(text), radii)};
  return columns;
}

int parse_species(std::string_view word, const Mixture& mixture) {
  for (std::size_t s = 0; s < mixture.species.size(); ++s)
    if (mixture.species[s].name == word) return static_cast<int>(s);
  try {
    return mixture.find_species(printable(word));
  } catch (const Error& error) {
    throw Refusal{error.what()};
  }
}

double parse_coordinate(std::string_view word, double edge) {
  const double x = parse_finite(word, "coordinate");
  if (std::abs(x) > farthest_box_lengths * edge)
    throw Refusal{fmt::format("coordinate {} is not allowed: at most {} box lengths of {} are", x, farthest_box_lengths, edge)};
  return x;
}

double parse_radius(std::string_view word) {
  const auto radius = parse<double>(word);
  if (!radius || !(*radius > 0.0) || !std::isfinite(*radius))
    throw Refusal{fmt::format("radius '{}' is not allowed: a finite number above 0 is needed", printable(word))};
  return *radius;
}

// `species_of` numbers the species.
template <class SpeciesOf>
void parse_particle(std::string_view line, const Columns& columns, SpeciesOf species_of, Configuration& configuration) {
  std::size_t column = 0;
  for (std::string_view word; !(word = take_word(line)).empty(); ++column) {
    if (column == columns.species) configuration.species.push_back(species_of(word));
    if (column == columns.radius) configuration.radii.push_back(parse_radius(word));
    if (column >= columns.position && column < columns.position + 3)
      configuration.positions.push_back(parse_coordinate(word, configuration.box.length[column - columns.position]));
  }
  if (column != columns.count)
    throw Refusal{fmt::format("a particle line of {} columns is not allowed: Properties has {}", column, columns.count)};
}

}  // namespace

ExtendedXyzReader::ExtendedXyzReader(std::filesystem::path path, RadiusColumn radius)
    : ExtendedXyzReader(std::move(path), Mixture{}, radius) {
  mixture_.name = path_.filename().string();
  takes_any_species_ = true;
}

ExtendedXyzReader::ExtendedXyzReader(std::filesystem::path path, const Mixture& mixture, RadiusColumn radius)
    : path_(std::move(path)), mixture_(mixture), radius_(radius) {
  std::error_code error;
  const auto status = std::filesystem::status(path_, error);
  if (std::filesystem::is_directory(status)) refuse("it is a folder: an extended XYZ file is needed");
  if (!std::filesystem::exists(status)) refuse("there is no such file: an extended XYZ file is needed");
  in_.open(path_, std::ios::binary);
  if (!in_) refuse("it cannot be opened: a readable extended XYZ file is needed");
  buffer_.resize(longest_line + 2);
}

void ExtendedXyzReader::refuse(const std::string& what_and_allowed) const {
  if (line_ == 0) throw_bad_input(fmt::format("{}: {}", path_.string(), what_and_allowed));
  throw_bad_input(fmt::format("{}:{}: {}", path_.string(), line_, what_and_allowed));
}

std::optional<std::string_view> ExtendedXyzReader::next_line() {
  in_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  auto length = static_cast<std::size_t>(in_.gcount());
  if (in_.bad()) refuse("reading failed: a readable file is needed");
  if (in_.eof() && length == 0) return std::nullopt;
  ++line_;
  const bool complete = in_.good();  // the line end was met; it is counted but not stored
  std::string_view line(buffer_.data(), complete ? length - 1 : length);
  if (line.find('\0') != std::string_view::npos) refuse("binary content: a text file without NUL bytes is needed");
  if (line.size() > longest_line) refuse(fmt::format("the line is too long: at most {} bytes are allowed", longest_line));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

// The number of particles in the frame that begins here, 0 at the end of the file.
std::size_t ExtendedXyzReader::line_of_count() {
  while (const auto line = next_line()) {
    std::string_view rest = *line;
    const std::string_view word = take_word(rest);
    if (word.empty()) continue;
    const auto count = parse<std::size_t>(word);
    if (!count || *count == 0 || *count > most_particles || !take_word(rest).empty())
      refuse(
          fmt::format("'{}' is not a number of particles: a frame begins with a line that holds one integer from 1 to {}, and "
                      "after the last frame only blank lines are allowed",
                      printable(*line), most_particles));
    return *count;
  }
  return 0;
}

int ExtendedXyzReader::species_of(std::string_view word) {
  auto& species = mixture_.species;
  const auto is_it = [&](const Species& s) { return s.name == word; };
  if (takes_any_species_ && std::none_of(species.begin(), species.end(), is_it)) {
    if (species.size() == most_species)
      throw Refusal{fmt::format("species '{}' is one too many: at most {} are allowed", printable(word), most_species)};
    species.push_back({std::string(word)});
  }
  return parse_species(word, mixture_);
}

std::optional<Frame> ExtendedXyzReader::next() {
  const std::size_t count = line_of_count();
  if (count == 0) {
    if (frames_ == 0) refuse("the file is empty: at least one extended XYZ frame is needed");
    return std::nullopt;
  }
  Frame frame;
  try {
    const auto comment = next_line();
    if (!comment) refuse(fmt::format("the file ends before the comment line: {} particles are announced", count));
    frame.info = parse_comment(*comment);
    frame.configuration.box = parse_lattice(take_key(frame.info, "lattice", "Lattice=\"Lx 0 0 0 Ly 0 0 0 Lz\""));
    const Columns columns = parse_properties(take_key(frame.info, "properties", properties_example(radius_)), radius_);
    if (const auto pbc = frame.info.extract("pbc")) check_periodic(pbc.mapped());
    // Nothing is reserved: the count is only a claim until the lines are there.
    for (std::size_t i = 0; i < count; ++i) {
      const auto line = next_line();
      if (!line) refuse(fmt::format("the file ends after {} of {} particle lines: all of them are needed", i, count));
      parse_particle(*line, columns, [this](std::string_view word) { return species_of(word); }, frame.configuration);
    }
  } catch (const Refusal& refusal) {
    refuse(refusal.message);
  }
  ++frames_;
  return frame;
}

Frame read_single_frame(const std::filesystem::path& path, const Mixture& mixture, RadiusColumn radius) {
  ExtendedXyzReader reader(path, mixture, radius);
  std::optional<Frame> frame = reader.next();
  if (reader.next()) throw_bad_input(fmt::format("{}: the file holds more than one frame: exactly one is allowed", path.string()));
  return std::move(*frame);
}

std::vector<Frame> read_frames(const std::filesystem::path& path, const Mixture& mixture, RadiusColumn radius) {
  ExtendedXyzReader reader(path, mixture, radius);
  std::vector<Frame> frames;
  while (auto frame = reader.next()) frames.push_back(std::move(*frame));
  return frames;
}

namespace {

void append_pair(std::string& comment, const std::string& key, const std::string& value) {
  const std::string name = lower(key);
  const bool bad_key = key.empty() || key.find_first_of(" \t\n\r=\"'\\[]{}") != std::string::npos;
  if (bad_key || name == "lattice" || name == "properties" || name == "pbc")
    throw_bad_input(
        fmt::format("'{}' cannot be a key of extended XYZ: a word other than Lattice, Properties and pbc, without quotes, "
                    "brackets and = is allowed",
                    printable(key)));
  if (std::any_of(value.begin(), value.end(), [](char c) { return c >= 0 && c < ' ' && c != '\n' && c != '\t'; }))
    throw_bad_input(
        fmt::format("the value '{}' of {} cannot be written: control characters are not allowed", printable(value), key));
  comment += ' ' + key + '=';
  if (!value.empty() && value.find_first_of(" \t\n=\"'\\[]{},") == std::string::npos) {
    comment += value;
    return;
  }
  comment += '"';
  for (const char c : value) {
    if (c == '"' || c == '\\') comment += '\\';
    if (c == '\n')
      comment += "\\n";
    else
      comment += c;
  }
  comment += '"';
}

void check_for_writing(const Configuration& configuration, const Mixture& mixture, const std::vector<double>* forces) {
  const std::size_t n = configuration.size();
  if (n == 0 || configuration.positions.size() != 3 * n || (forces && forces->size() != 3 * n))
    throw_bad_input(
        fmt::format("a frame of {} particles, {} coordinates and {} force components cannot be written: at least one "
                    "particle and 3 of each per particle are needed",
                    n, configuration.positions.size(), forces ? forces->size() : 3 * n));
  for (const int s : configuration.species)
    if (s < 0 || static_cast<std::size_t>(s) >= mixture.species.size())
      throw_bad_input(
          fmt::format("species {} cannot be written: model {} has 0 to {}", s, mixture.name, mixture.species.size() - 1));
  if (!configuration.radii.empty() && configuration.radii.size() != n)
    throw_bad_input(fmt::format("a frame of {} particles and {} radii cannot be written: one each or none are allowed", n,
                                configuration.radii.size()));
  for (const double r : configuration.radii)
    if (!(r > 0.0) || !std::isfinite(r))
      throw_bad_input(fmt::format("radius {} cannot be written: a finite number above 0 is needed", r));
}

}  // namespace

void write_frame(std::ostream& out, const Configuration& configuration, const Mixture& mixture,
                 const std::map<std::string, std::string>& info, const std::vector<double>* forces) {
  check_for_writing(configuration, mixture, forces);
  const auto& edge = configuration.box.length;
  std::string text =
      fmt::format("{}\nLattice=\"{} 0 0 0 {} 0 0 0 {}\" Properties=species:S:1:pos:R:3{}{} pbc=\"T T T\"", configuration.size(),
                  edge[0], edge[1], edge[2], configuration.radii.empty() ? "" : ":radius:R:1", forces ? ":forces:R:3" : "");
  for (const auto& [key, value] : info) append_pair(text, key, value);
  text += '\n';
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const double* r = &configuration.positions[3 * i];
    text += mixture.species[static_cast<std::size_t>(configuration.species[i])].name;
    fmt::format_to(std::back_inserter(text), " {} {} {}", r[0], r[1], r[2]);
    if (!configuration.radii.empty()) fmt::format_to(std::back_inserter(text), " {}", configuration.radii[i]);
    if (forces) fmt::format_to(std::back_inserter(text), " {} {} {}", (*forces)[3 * i], (*forces)[3 * i + 1], (*forces)[3 * i + 2]);
    text += '\n';
    if (text.size() > 65536) {
      out << text;
      text.clear();
    }
  }
  out << text;
}

}  // namespace lanescape
