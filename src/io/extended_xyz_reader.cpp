#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "io/extended_xyz.hpp"
#include "io/xyz_columns.hpp"
#include "io/xyz_comment.hpp"

namespace lanescape {
namespace {

using namespace xyz;

constexpr std::size_t most_particles = 10'000'000;
constexpr std::size_t longest_line = std::size_t{1} << 20;  // [bytes]; keeps a file without line ends out of memory
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::size_t most_elements = 118;  // of a reader that accepts any; there are no more elements

int parse_species(std::string_view word, const Mixture& mixture) {
  for (std::size_t s = 0; s < mixture.species.size(); ++s)
    if (mixture.species[s].name == word) return static_cast<int>(s);
  try {
    return mixture.find_species(printable(word));
  } catch (const Error& error) {
    throw Refusal{error.what()};
  }
}

}  // namespace

ExtendedXyzReader::ExtendedXyzReader(std::filesystem::path path, SizeColumn size)
    : ExtendedXyzReader(std::move(path), Mixture{}, size) {
  mixture_.name = path_.filename().string();
  accepts_any_species_ = true;
}

ExtendedXyzReader::ExtendedXyzReader(std::filesystem::path path, const Mixture& mixture, SizeColumn size, OpenAxes open_axes)
    : path_(std::move(path)), mixture_(mixture), size_(size), open_axes_(open_axes) {
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
    if (line_ == 1 && rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
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
  if (accepts_any_species_ && std::none_of(species.begin(), species.end(), is_it)) {
    if (species.size() == most_elements)
      throw Refusal{fmt::format("species '{}' is one too many: at most {} are allowed", printable(word), most_elements)};
    species.push_back({std::string(word)});
  }
  return parse_species(word, mixture_);
}

Box ExtendedXyzReader::box_of(const Comment& comment) const {
  Box box = parse_lattice(required(comment.lattice, "Lattice=\"Lx 0 0 0 Ly 0 0 0 Lz\""));
  if (comment.periodic) box.periodic = parse_periodic(*comment.periodic);
  if (open_axes_ == OpenAxes::refused && box.has_open_axis())
    throw Refusal{
        fmt::format("pbc \"{}\" is not allowed: the box must be periodic along all axes, \"T T T\"", printable(*comment.periodic))};
  return box;
}

void ExtendedXyzReader::read_particles(std::size_t count, const xyz::Columns& columns, Configuration& configuration) {
  // Nothing is reserved: the count is only a claim until the lines are there.
  for (std::size_t i = 0; i < count; ++i) {
    const auto line = next_line();
    if (!line) refuse(fmt::format("the file ends after {} of {} particle lines: all of them are needed", i, count));
    const Particle particle = parse_particle(*line, columns, size_, configuration.box);
    configuration.species.push_back(species_of(particle.species));
    configuration.positions.insert(configuration.positions.end(), particle.position.begin(), particle.position.end());
    if (size_ == SizeColumn::radius) configuration.radii.push_back(particle.size);
    if (size_ == SizeColumn::diameter) configuration.diameters.push_back(particle.size);
  }
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
    Comment pairs = parse_comment(*comment);
    frame.info = std::move(pairs.info);
    frame.configuration.box = box_of(pairs);
    const Columns columns = parse_properties(required(pairs.properties, properties_example(size_)), size_);
    read_particles(count, columns, frame.configuration);
  } catch (const Refusal& refusal) {
    refuse(refusal.message);
  }
  ++frames_;
  return frame;
}

bool ExtendedXyzReader::another_begins() { return line_of_count() > 0; }

Frame read_single_frame(const std::filesystem::path& path, const Mixture& mixture, SizeColumn size) {
  ExtendedXyzReader reader(path, mixture, size);
  std::optional<Frame> frame = reader.next();
  if (reader.another_begins())
    throw_bad_input(fmt::format("{}: the file holds more than one frame: exactly one is allowed", path.string()));
  return std::move(*frame);
}

std::vector<Frame> read_frames(const std::filesystem::path& path, const Mixture& mixture, SizeColumn size) {
  ExtendedXyzReader reader(path, mixture, size);
  std::vector<Frame> frames;
  while (auto frame = reader.next()) frames.push_back(std::move(*frame));
  return frames;
}

}  // namespace lanescape
