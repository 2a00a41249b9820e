#include "run/path_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string_view>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "io/extended_xyz.hpp"
#include "io/hdf5_archive.hpp"
#include "io/model_file.hpp"
#include "run/path_nodes.hpp"

namespace lanescape {
namespace {

constexpr const char* path_kind = "path";
constexpr std::uint64_t path_version = 1;

std::vector<double> joined(const std::vector<std::vector<double>>& rows) {
  std::vector<double> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

std::vector<std::vector<double>> split(const std::vector<double>& all, std::size_t width) {
  std::vector<std::vector<double>> rows;
  for (std::size_t begin = 0; begin + width <= all.size(); begin += width)
    rows.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(begin + width));
  return rows;
}

// The fields of a file, in their order and shapes.
struct Stored {
  std::string kind = path_kind, model, species_names, method, isa;
  std::uint64_t version = path_version, nodes = 0, particles = 0;
  std::vector<std::uint64_t> species;
  std::vector<double> box, landscape_energy, radii, diameters, positions, tangents, multipliers, excess, segment_violation;

  void exchange(Archive& archive) {
    archive.field("kind", kind);
    archive.field("version", version);
    if (kind != path_kind || version != path_version)
      throw_bad_input(
          fmt::format("it is a {} of version {}: a {} of version {} is needed", kind, version, path_kind, path_version));
    archive.field("model", model);
    archive.field("species_names", species_names);
    archive.field("method", method);
    archive.field("isa", isa);
    archive.field("nodes", nodes);
    archive.field("particles", particles);
    archive.field("box", box);
    archive.field("landscape_energy", landscape_energy);
    archive.field("species", species);
    archive.field("radii", radii);
    archive.field("diameters", diameters);
    archive.field("positions", positions);
    archive.field("tangents", tangents);
    archive.field("multipliers", multipliers);
    archive.field("excess", excess);
    archive.field("segment_violation", segment_violation);
  }

  void check_length(const char* name, std::size_t found, std::size_t needed) const {
    if (found != needed) throw_bad_input(fmt::format("field {} has {} numbers: {} are needed", name, found, needed));
  }
  void check_sizes(const AnyModel& of_model) const {
    // Beyond this, products of the two would not be numbers of anything that fits into memory.
    constexpr std::uint64_t most = std::uint64_t{1} << 28;
    if (nodes < 3 || nodes > most) throw_bad_input(fmt::format("a path of {} nodes is not allowed: at least 3 are needed", nodes));
    if (particles < 1 || particles > most) throw_bad_input(fmt::format("{} particles are not allowed: at least one", particles));
    const bool hard = is_hard(of_model), sized = traits_of(of_model).sizes == SizeColumn::diameter;
    check_length("species", species.size(), particles);
    check_length("box", box.size(), 3);
    check_length("landscape_energy", landscape_energy.size(), hard ? 0 : 1);
    if (hard && radii.empty()) throw_bad_input("it has no radii: each hard sphere needs one");
    check_length("radii", radii.size(), hard ? particles : 0);
    check_length("diameters", diameters.size(), sized ? particles : 0);
    check_length("positions", positions.size(), nodes * particles * 3);
    check_length("tangents", tangents.size(), (nodes - 1) * particles * 3);
    check_length("multipliers", multipliers.size(), nodes);
    check_length("excess", excess.size(), nodes);
    check_length("segment_violation", segment_violation.size(), nodes - 1);
  }
  void check_values(const AnyModel& of_model) const {
    const std::size_t count = mixture_of(of_model).species.size();
    for (const std::uint64_t s : species)
      if (s >= count) throw_bad_input(fmt::format("species {} is not allowed: the model has {}", s, count));
    for (const std::vector<double>* sizes : {&radii, &diameters})
      for (const double size : *sizes)
        if (!(size > 0.0 && std::isfinite(size)))
          throw_bad_input(fmt::format("a particle of size {} is not allowed: finite and above 0", size));
    const auto bad = std::find_if(positions.begin(), positions.end(), [](double x) { return !std::isfinite(x); });
    if (bad != positions.end()) {
      const auto at = static_cast<std::size_t>(bad - positions.begin());
      throw_bad_input(fmt::format("node {}, particle {} has coordinate {}: finite ones are needed", at / (3 * particles),
                                  at / 3 % particles, *bad));
    }
    if (!landscape_energy.empty() && !std::isfinite(landscape_energy.front()))
      throw_bad_input(fmt::format("landscape energy {} is not allowed: it must be finite", landscape_energy.front()));
  }
};

Stored stored(const PathFile& path) {
  Stored s;
  const Configuration& first = path.nodes.front();
  std::ostringstream text;
  write_model_file(text, path.model);
  s.model = text.str();
  for (const Species& species : mixture_of(path.model).species)
    s.species_names += (s.species_names.empty() ? "" : " ") + species.name;
  s.method = path.method;
  s.isa = path.isa;
  s.nodes = path.nodes.size();
  s.particles = first.size();
  s.box.assign(first.box.length.begin(), first.box.length.end());
  if (path.landscape_energy) s.landscape_energy = {*path.landscape_energy};
  s.species.assign(first.species.begin(), first.species.end());
  s.radii = first.radii;
  s.diameters = first.diameters;
  for (const Configuration& node : path.nodes) s.positions.insert(s.positions.end(), node.positions.begin(), node.positions.end());
  s.tangents = joined(path.tangents);
  s.multipliers = path.multipliers;
  s.excess = path.excess;
  s.segment_violation = path.segment_violation;
  return s;
}

PathFile restored(Stored s) {
  PathFile path;
  path.model = read_model_text(s.model, "the model");
  s.check_sizes(path.model);
  s.check_values(path.model);
  Configuration node;
  std::copy(s.box.begin(), s.box.end(), node.box.length.begin());
  node.species.assign(s.species.begin(), s.species.end());
  node.radii = s.radii;
  node.diameters = s.diameters;
  for (std::vector<double>& positions : split(s.positions, 3 * s.particles)) {
    path.nodes.push_back(node);
    path.nodes.back().positions = std::move(positions);
  }
  path.method = s.method;
  path.isa = s.isa;
  if (!s.landscape_energy.empty()) path.landscape_energy = s.landscape_energy.front();
  path.tangents = split(s.tangents, 3 * s.particles);
  path.multipliers = std::move(s.multipliers);
  path.excess = std::move(s.excess);
  path.segment_violation = std::move(s.segment_violation);
  return path;
}

// Runs `action`; messages of what it refuses start with the file, once.
template <class Action>
auto naming(const std::filesystem::path& file, Action action) {
  try {
    return action();
  } catch (const Error& error) {
    const std::string message = error.what();
    if (message.starts_with(file.string())) throw;
    throw Error(error.code(), fmt::format("{}: {}", file.string(), message));
  }
}

}  // namespace

PathFile path_file(const AnyModel& model, std::vector<Configuration> nodes, std::optional<double> landscape_energy,
                   const PathCheck& check, const std::string& method, Isa isa) {
  PathFile path{model,
                method,
                to_string(isa),
                landscape_energy,
                std::move(nodes),
                {},
                check.multipliers,
                check.excess,
                check.segment_violation};
  const PathNodes made = path_nodes(model, path.nodes);
  for (const AlignedArray& tangent : chord_tangents(VectorAlgebra(kernel_table(isa)), made.nodes))
    path.tangents.push_back(made.layout.to_user(tangent));
  return path;
}

void write_path_file(const std::filesystem::path& file, const PathFile& path) {
  Stored s = stored(path);
  Hdf5Writer writer(file);
  s.exchange(writer);
  writer.commit();
}

PathFile read_path_file(const std::filesystem::path& file) {
  return naming(file, [&] {
    Stored s;
    Hdf5Reader reader(file);
    s.exchange(reader);
    return restored(std::move(s));
  });
}

bool is_path_file(const std::filesystem::path& file) {
  constexpr std::string_view signature("\x89HDF\r\n\x1a\n", 8);
  char first[8] = {};
  std::ifstream in(file, std::ios::binary);
  return in.read(first, sizeof first) && std::string_view(first, sizeof first) == signature;
}

PathFile read_path_frames(const std::filesystem::path& file, const AnyModel& model) {
  PathFile path;
  path.model = model;
  std::optional<std::string> energy;
  for (Frame& frame : read_frames(file, mixture_of(model), traits_of(model).sizes)) {
    const auto found = frame.info.find(landscape_energy_key);
    if (found != frame.info.end() && !energy) energy = found->second;
    path.nodes.push_back(std::move(frame.configuration));
  }
  if (path.nodes.size() < 3)
    throw_bad_input(fmt::format("{}: holds {} frames: a path has at least 3", file.string(), path.nodes.size()));
  if (!energy || is_hard(model)) return path;
  double value = 0.0;
  const auto [end, error] = std::from_chars(energy->data(), energy->data() + energy->size(), value);
  if (error != std::errc() || end != energy->data() + energy->size() || !std::isfinite(value))
    throw_bad_input(fmt::format("{}: {} is '{}': a finite number is needed", file.string(), landscape_energy_key, *energy));
  path.landscape_energy = value;
  return path;
}

}  // namespace lanescape
