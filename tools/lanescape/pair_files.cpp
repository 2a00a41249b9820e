#include "pair_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "end_point_options.hpp"
#include "interaction/sphere/rounding_overlaps.hpp"
#include "io/extended_xyz.hpp"

namespace lanescape::program {
namespace {

// Scales the radii of both frames by one factor if the file's rounding makes spheres overlap.
void scale_radii(ConfigurationPair& pair, double tolerance, const std::string& where) {
  try {
    const double factor = std::min(rounding_overlap_factor(pair.start, tolerance), rounding_overlap_factor(pair.finish, tolerance));
    for (Configuration* end : {&pair.start, &pair.finish})
      for (double& radius : end->radii) radius *= factor;
    pair.radius_factor *= factor;
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("{}: {}", where, error.what()));
  }
}

// What the writer of a pair says of it; other programs may mean something else by this word, so that what is no number above 0
// counts as nothing.
std::optional<double> told_number(const Frame& frame, const char* key) {
  const auto found = frame.info.find(key);
  if (found == frame.info.end()) return {};
  const char* end = found->second.data() + found->second.size();
  double value = 0.0;
  const auto [stop, status] = std::from_chars(found->second.data(), end, value);
  if (status != std::errc() || stop != end || !std::isfinite(value) || !(value > 0.0)) return {};
  return value;
}

// The factor of scale_radii() when the pair was kept.
double kept_radius_factor(const std::filesystem::path& file, const AnyModel& model) {
  const auto info = ExtendedXyzReader(file, mixture_of(model)).next()->info;
  const auto found = info.find(radius_factor_key);
  return found == info.end() ? 1.0 : std::stod(found->second);
}

}  // namespace

ConfigurationPair read_pair(const std::filesystem::path& file, const AnyModel& model, double tolerance) {
  const bool hard = is_hard(model);
  ExtendedXyzReader reader(file, mixture_of(model), traits_of(model).sizes);
  ConfigurationPair pair;
  Frame first = *reader.next();
  pair.start = std::move(first.configuration);
  if (!hard) pair.temperature = told_number(first, temperature_key);
  std::optional<Frame> second = reader.next();
  if (!second || reader.another_begins())
    throw_bad_input(fmt::format("{}: holds {}: a pair of end points is two frames", file.string(),
                                second ? "more than two frames" : "one frame"));
  pair.finish = std::move(second->configuration);
  if (hard) scale_radii(pair, tolerance, file.string());
  check_end_points(pair, model, file.string());
  for (std::size_t k = 0; k < pair.start.positions.size(); ++k)
    pair.distance = std::hypot(pair.distance, pair.finish.positions[k] - pair.start.positions[k]);
  return pair;
}

AskedDistance read_asked_distance(const std::filesystem::path& file) {
  const Frame first = *ExtendedXyzReader(file).next();
  const auto species = first.info.find(distance_species_key);
  return {told_number(first, asked_distance_key), species == first.info.end() ? std::string() : species->second};
}

ConfigurationPair read_kept_pair(const std::filesystem::path& file, const AnyModel& model, double tolerance) {
  ConfigurationPair pair = read_pair(file, model, tolerance);
  pair.radius_factor *= kept_radius_factor(file, model);
  return pair;
}

std::vector<ConfigurationPair> read_kept_pairs(const OutputFolder& folder, const AnyModel& model, double tolerance) {
  std::vector<ConfigurationPair> pairs;
  for (std::filesystem::path file; std::filesystem::exists(file = folder.path() / pair_file_name(pairs.size()));) {
    pairs.push_back(read_kept_pair(file, model, tolerance));
  }
  return pairs;
}

void warn_if_wrapped(const CommonOptions& common, const std::string& file, const ConfigurationPair& pair) {
  if (looks_wrapped(pair))
    say(common,
        fmt::format("{}: warning: both end points lie in one box, and a particle moves by more than half an edge: they look "
                    "wrapped, and the distance {} is then wrong; unwrapped positions are needed",
                    file, pair.distance));
}

}  // namespace lanescape::program
