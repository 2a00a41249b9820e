#include "analysis_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "configuration/hard_sphere_model.hpp"
#include "core/error.hpp"
#include "io/extended_xyz.hpp"
#include "options.hpp"
#include "run/path_method.hpp"

namespace lanescape::program {
namespace {

constexpr SettingColumn columns[] = {{"kind", "", ""},
                                     {"model", "", ""},
                                     {"particles", "N", ""},
                                     {"density", "rho", ""},
                                     {"packing_fraction", "phi", ""},
                                     {"temperature", "T", ""},
                                     {"method", "", ""},
                                     {"path_method", "via-", ""},
                                     {"stepping", "", "faithful"},
                                     {"step", "step", ""},
                                     {"avoidance_step", "avoidance-step", "0.0001"},
                                     {"fictitious", "", "harmonic"},
                                     {"escape_tolerance", "dV", "0.0001"},
                                     {"landscape_energy", "E", ""},
                                     {"engine", "engine-", ""},
                                     {"direction", "", "forward"},
                                     {"starts", "starts", "1"},
                                     {"distance", "dR", ""},
                                     {"distance_species", "of-", ""},
                                     {"images", "images-", "all"},
                                     {"truncation", "", "shifted"},
                                     {"cutoff", "rc", ""},
                                     {"precision", "", "double"},
                                     {"interval", "dt", ""},
                                     {"longest_time", "tmax", ""},
                                     {"wave_number", "k", ""}};

// Names of groups have neither commas nor line breaks, which tables could not hold.
std::string name_of_value(const Json& value) {
  std::string text = value.is_string()         ? value.get<std::string>()
                     : value.is_number_float() ? fmt::format("{}", value.get<double>())
                                               : value.dump();
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == ' ' || c == '\n' || c == '\r' || c == '"'; }, '/');
  return text;
}

std::optional<double> number_in_info(const Frame& frame, const char* key, const std::filesystem::path& file) {
  const auto found = frame.info.find(key);
  if (found == frame.info.end()) return std::nullopt;
  const std::optional<double> value = number_in(found->second);
  if (!value || !std::isfinite(*value)) throw_bad_input(fmt::format("{}: {}={} is no number", file.string(), key, found->second));
  return value;
}

// Sets settings by name; what is not set stays null.
class Settings {
 public:
  Settings() {
    for (const SettingColumn& column : columns) row_.emplace_back(column.name, Json());
  }
  void set(const std::string& name, const Json& value) {
    std::find_if(row_.begin(), row_.end(), [&](const auto& entry) { return entry.first == name; })->second = value;
  }
  void set_rounded(const std::string& name, std::optional<double> value, int digits = 9) {
    if (value) set(name, rounded(*value, digits));
  }
  // From an option of the run file, where it is there.
  void take_number(const std::string& name, const toml::table& options, const char* option) {
    set_rounded(name, options[option].value<double>());
  }
  void take_text(const std::string& name, const toml::table& options, const char* option) {
    if (const auto text = options[option].value<std::string>()) set(name, *text);
  }
  ResultRow row() const { return row_; }

 private:
  ResultRow row_;
};

void take_path_settings(Settings& settings, const std::string& subcommand, const toml::table& options, const PathMethod& method) {
  if (subcommand == "shorten") {
    settings.take_text("method", options, "method");
    settings.set("path_method", method.word);
    settings.set("starts", options["starts"].value_or(std::int64_t{1}));
  } else {
    settings.set("method", method.word);
    settings.set("direction", options["reverse"].value_or(false) ? "both" : "forward");
  }
  const bool adaptive = options["adaptive"].value_or(false);
  settings.set("stepping", adaptive ? "adaptive" : "faithful");
  settings.take_number("step", options, "step");
  const std::string word = method.word;
  if (word == "avoidance" && !adaptive) {
    settings.set("avoidance_step", options["avoidance-step"].value_or(1e-4));
    settings.set("fictitious", options["fictitious"].value_or(std::string("harmonic")));
  }
  if (word == "escape") settings.set("escape_tolerance", options["escape-tolerance"].value_or(1e-4));
  settings.take_number("landscape_energy", options, "landscape-energy");
  settings.take_text("engine", options, "landscape");
}

void take_pair_state(Settings& settings, const PairState& state, bool hard) {
  settings.set("particles", state.particles);
  settings.set_rounded(hard ? "packing_fraction" : "density", hard ? state.packing_fraction : state.density);
  if (!hard) settings.set_rounded("temperature", state.temperature);
  settings.set_rounded("distance", state.distance, 4);
  if (state.distance_species) settings.set("distance_species", *state.distance_species);
}

void take_own_state(Settings& settings, const toml::table& options, const RunJson& result, bool hard) {
  const RunJson of_spheres = result.has("packing_fraction") ? result : result.in("endpoints");
  if (hard) {
    settings.set_rounded("packing_fraction", of_spheres.optional_number("packing_fraction"));
    return;
  }
  settings.take_number("density", options, "density");
  settings.set_rounded("density", result.optional_number("density"));
  settings.take_number("temperature", options, "temperature");
}

void take_diffusion_settings(Settings& settings, const toml::table& options, const RunJson& result) {
  settings.set("particles", static_cast<std::size_t>(result.number("particles")));
  if (options.contains("interval") || options.contains("lags")) {
    settings.take_number("interval", options, "interval");
    settings.set_rounded("longest_time", result.optional_number("longest_time"));
  }
  settings.take_text("wave_number", options, "wave-number");
}

std::string model_of(const toml::table& options, const RunJson& result) {
  if (result.has("model")) return result.text("model");
  if (const auto name = options["model"].value<std::string>()) return *name;
  return std::filesystem::path(options["model-file"].value_or(std::string())).stem().string();
}

const PathMethod* path_method_of(const std::string& subcommand, const toml::table& options, const std::string& run_file) {
  if (subcommand != "path" && subcommand != "shorten") return nullptr;
  const auto word = options[subcommand == "path" ? "method" : "path-method"].value<std::string>();
  if (!word) throw_bad_input(fmt::format("{}: the method of the path is missing", run_file));
  return &path_method(*word);
}

}  // namespace

std::span<const SettingColumn> setting_columns() { return columns; }

double rounded(double value, int digits) { return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr); }

std::string name_of_settings(const ResultRow& settings, std::span<const std::string> without) {
  std::string name;
  for (const SettingColumn& column : columns) {
    const auto found =
        std::find_if(settings.begin(), settings.end(), [&](const auto& entry) { return entry.first == column.name; });
    if (found == settings.end() || found->second.is_null()) continue;
    if (std::find(without.begin(), without.end(), column.name) != without.end()) continue;
    const std::string value = name_of_value(found->second);
    if (value != column.unwritten) name += (name.empty() ? "" : " ") + (column.prefix + value);
  }
  return name;
}

PairState read_pair_state(const std::filesystem::path& file, bool hard) {
  ExtendedXyzReader reader(file, hard ? SizeColumn::radius : SizeColumn::ignored);
  const Frame frame = *reader.next();
  PairState state;
  state.particles = frame.configuration.size();
  if (hard) state.packing_fraction = packing_fraction(frame.configuration);
  state.density = static_cast<double>(state.particles) / frame.configuration.box.volume();
  state.temperature = number_in_info(frame, "temperature", file);
  state.distance = number_in_info(frame, "asked_distance", file);
  state.measured_distance = number_in_info(frame, "distance", file);
  if (const auto found = frame.info.find("distance_species"); found != frame.info.end()) state.distance_species = found->second;
  return state;
}

ResultRow settings_of(const std::filesystem::path& folder, const std::string& subcommand, const toml::table& options,
                      const RunJson& result) {
  const PathMethod* method = path_method_of(subcommand, options, (folder / "run.toml").string());
  const bool hard = method != nullptr ? method->is_hard : result.has("packing_fraction");
  Settings settings;
  settings.set("kind", subcommand);
  settings.set("model", model_of(options, result));
  if (method != nullptr) take_path_settings(settings, subcommand, options, *method);
  if (subcommand == "diffusion")
    take_diffusion_settings(settings, options, result);
  else
    take_pair_state(settings, read_pair_state(folder / "pair-0001.extxyz", hard), hard);
  if (subcommand == "diffusion" || !options.contains("pair")) take_own_state(settings, options, result, hard);
  settings.set_rounded("distance", options["distance"].value<double>(), 4);
  settings.take_text("distance_species", options, "distance-species");
  for (const char* of_model : {"images", "truncation"}) settings.take_text(of_model, options, of_model);
  settings.take_number("cutoff", options, "cutoff");
  if (result.has("precision")) settings.set("precision", result.text("precision"));
  return settings.row();
}

}  // namespace lanescape::program
