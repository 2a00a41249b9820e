#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/mixture.hpp"

namespace lanescape {
namespace xyz {
struct Columns;
struct Comment;
}  // namespace xyz

// One frame of an extended XYZ file, https://github.com/libAtoms/extxyz.
struct Frame {
  Configuration configuration;
  std::map<std::string, std::string> info;  // the comment line's other pairs, as text; a bare word has the value "T"
};

// What a reader does with a box that is not periodic along all axes.
enum class OpenAxes { refused, allowed };

// Reads frame by frame and holds one frame in memory. Strict: ambiguous input throws Error(bad_input) with file and
// line. Wanted are an orthorhombic Lattice, Properties with species:S:1 and pos:R:3 (other columns are skipped), pbc "T T T"
// or none, or any where open axes are allowed, the mixture's species and finite coordinates within 10^6 box lengths; positions may
// be unwrapped. With a size column, each particle must have a radius or diameter, finite and above 0.
class ExtendedXyzReader {
 public:
  ExtendedXyzReader(std::filesystem::path path, const Mixture& mixture, SizeColumn size = SizeColumn::ignored,
                    OpenAxes open_axes = OpenAxes::refused);
  // Accepts any species, at most 118, and numbers them in the order in which they appear.
  explicit ExtendedXyzReader(std::filesystem::path path, SizeColumn size = SizeColumn::ignored);
  // The next frame; nothing at the end of the file. A file without any frame is refused.
  std::optional<Frame> next();
  // Whether another frame follows, for callers that need no more: it is not read and may be incomplete. Refuses other text, which
  // shows that the frame before has more particles than it announces. next() cannot be called any more.
  bool another_begins();
  // The species there are; of a reader that accepts any, those met so far.
  const Mixture& mixture() const { return mixture_; }

 private:
  std::optional<std::string_view> next_line();
  std::size_t line_of_count();
  Box box_of(const xyz::Comment& comment) const;
  void read_particles(std::size_t count, const xyz::Columns& columns, Configuration& configuration);
  int species_of(std::string_view word);
  [[noreturn]] void refuse(const std::string& what_and_allowed) const;

  std::filesystem::path path_;
  Mixture mixture_;
  bool accepts_any_species_ = false;
  SizeColumn size_;
  OpenAxes open_axes_ = OpenAxes::refused;
  std::ifstream in_;
  std::vector<char> buffer_;
  std::size_t line_ = 0;
  std::size_t frames_ = 0;
};

// The frame of a file that must hold exactly one.
Frame read_single_frame(const std::filesystem::path& path, const Mixture& mixture, SizeColumn size = SizeColumn::ignored);
// All frames of a file that must hold at least one.
std::vector<Frame> read_frames(const std::filesystem::path& path, const Mixture& mixture, SizeColumn size = SizeColumn::ignored);

// Writes one frame with the shortest digits that read back as the same bits. `info` must not use the names Lattice, Properties
// and pbc. Radii and diameters, where the configuration has them, make the columns radius:R:1 and diameter:R:1 [sigma]. `forces`,
// where given, are 3N numbers in the particles' order and make the column forces:R:3 [epsilon/sigma].
void write_frame(std::ostream& out, const Configuration& configuration, const Mixture& mixture,
                 const std::map<std::string, std::string>& info, const std::vector<double>* forces = nullptr);

}  // namespace lanescape
