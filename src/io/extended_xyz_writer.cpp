#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "core/error.hpp"
#include "io/extended_xyz.hpp"
#include "io/xyz_comment.hpp"

namespace lanescape {
namespace {

// `width` numbers per particle.
struct Column {
  const char* name;
  std::size_t width;
  const std::vector<double>* values;
};

void check_sizes(const char* one, const char* several, const std::vector<double>& sizes, std::size_t particles) {
  if (!sizes.empty() && sizes.size() != particles)
    throw_bad_input(fmt::format("a frame of {} particles and {} {} cannot be written: one each or none are allowed", particles,
                                sizes.size(), several));
  for (const double size : sizes)
    if (!(size > 0.0) || !std::isfinite(size))
      throw_bad_input(fmt::format("{} {} cannot be written: a finite number above 0 is needed", one, size));
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
  check_sizes("radius", "radii", configuration.radii, n);
  check_sizes("diameter", "diameters", configuration.diameters, n);
}

std::vector<Column> columns_of(const Configuration& configuration, const std::vector<double>* forces) {
  std::vector<Column> columns{{"pos", 3, &configuration.positions}};
  if (!configuration.radii.empty()) columns.push_back({"radius", 1, &configuration.radii});
  if (!configuration.diameters.empty()) columns.push_back({"diameter", 1, &configuration.diameters});
  if (forces) columns.push_back({"forces", 3, forces});
  return columns;
}

}  // namespace

void write_frame(std::ostream& out, const Configuration& configuration, const Mixture& mixture,
                 const std::map<std::string, std::string>& info, const std::vector<double>* forces) {
  check_for_writing(configuration, mixture, forces);
  const std::vector<Column> columns = columns_of(configuration, forces);
  const auto& edge = configuration.box.length;
  std::string text =
      fmt::format("{}\nLattice=\"{} 0 0 0 {} 0 0 0 {}\" Properties=species:S:1", configuration.size(), edge[0], edge[1], edge[2]);
  for (const Column& column : columns) fmt::format_to(std::back_inserter(text), ":{}:R:{}", column.name, column.width);
  const auto axis = [&](std::size_t k) { return configuration.box.periodic[k] ? 'T' : 'F'; };
  fmt::format_to(std::back_inserter(text), " pbc=\"{} {} {}\"", axis(0), axis(1), axis(2));
  for (const auto& [key, value] : info) xyz::append_pair(text, key, value);
  text += '\n';
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    text += mixture.species[static_cast<std::size_t>(configuration.species[i])].name;
    for (const auto& [name, width, values] : columns)
      for (std::size_t k = 0; k < width; ++k) fmt::format_to(std::back_inserter(text), " {}", (*values)[width * i + k]);
    text += '\n';
    if (text.size() > 65536) {
      out << text;
      text.clear();
    }
  }
  out << text;
}

}  // namespace lanescape
