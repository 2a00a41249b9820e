#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "configuration/configuration.hpp"
#include "core/point.hpp"
#include "io/xyz_text.hpp"

// The columns of particles.
namespace lanescape::xyz {

// Which columns are read; others are ignored.
struct Columns {
  std::size_t count = 0;            // all columns of a line
  std::size_t species = 0;          // index of the column
  std::size_t position = 0;         // of the first of three
  std::optional<std::size_t> size;  // of the radius or diameter
};

// "radius" or "diameter"; empty where none is read.
std::string_view name_of(SizeColumn size);
// What Properties should be, for messages.
std::string properties_example(SizeColumn size);
// The columns that the value of Properties describes.
Columns parse_properties(std::string_view text, SizeColumn size);

struct Particle {
  std::string_view species;
  Point position{};   // [sigma]
  double size = 0.0;  // radius or diameter, where there is one [sigma]
};
Particle parse_particle(std::string_view line, const Columns& columns, SizeColumn size, const Box& box);

}  // namespace lanescape::xyz
