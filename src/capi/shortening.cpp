#include <lanescape/shortening.hpp>

#include <limits>

#include "capi/arguments.hpp"
#include "capi/callbacks.hpp"
#include "capi/model.hpp"
#include "capi/path.hpp"

using namespace lanescape;
using namespace lanescape::capi;

struct lanescape_short_path : Handle<ShortPath> {};

namespace {

using Frames = std::vector<std::vector<double>>;

ShortenSettings settings_of(const lanescape_shorten_settings* given) {
  ShortenSettings settings;
  if (given == nullptr) return settings;
  const auto& s = sized(given, "settings", "lanescape_shorten_settings");
  settings.method = word(s.method, "");
  settings.starts = s.starts;
  settings.seed = s.seed;
  settings.search = path_settings_of(s.search);
  return settings;
}

CheckSettings settings_of(const lanescape_check_settings* given) {
  CheckSettings settings;
  if (given == nullptr) return settings;
  const auto& s = sized(given, "settings", "lanescape_check_settings");
  if (s.landscape_energy != nullptr) settings.landscape_energy = *s.landscape_energy;
  settings.threads = s.threads;
  settings.instruction_set = word(s.instruction_set, settings.instruction_set.c_str());
  return settings;
}

Frames frames_of(const double* positions, std::size_t frames, std::size_t particles) {
  if (particles == 0) return {};  // the library refuses them
  const std::size_t numbers = times(3, particles);
  const auto all = array(positions, times(numbers, frames), "positions");
  Frames separate;
  for (std::size_t k = 0; k < frames; ++k) {
    const auto one = all.subspan(k * numbers, numbers);
    separate.emplace_back(one.begin(), one.end());
  }
  return separate;
}

void write_certificate(const PathCertificate& found, lanescape_path_certificate& out) {
  out.length = found.length;
  out.distance = found.distance;
  out.ratio_squared = found.ratio_squared;
  out.landscape_energy = found.landscape_energy;
  out.largest_violation = found.largest_violation;
  out.kuhn_tucker_residual = found.kuhn_tucker_residual;
  copy_out(found.multipliers, out.multipliers);
  copy_out(found.excess, out.excess);
  copy_out(found.segment_violation, out.segment_violation);
}

}  // namespace

lanescape_status lanescape_shorten_settings_init(lanescape_shorten_settings* settings, size_t size) {
  return guarded([&] {
    const ShortenSettings own;
    lanescape_shorten_settings presets{};
    presets.starts = own.starts;
    presets.seed = own.seed;
    initialise(settings, size, "settings", "lanescape_shorten_settings", presets);
  });
}

lanescape_status lanescape_shorten_path(const lanescape_model* model, size_t particles, const int* species, const double box[3],
                                        const double* start, const double* finish, const double* diameters, size_t frames,
                                        const double* positions, const lanescape_shorten_settings* settings,
                                        lanescape_short_path** path) {
  return guarded([&] {
    create(path, "path", [&] {
      return shorten_path(object_of(model, "model").model, array(species, particles, "species"), three(box, "box"),
                          vectors(start, particles, "start"), vectors(finish, particles, "finish"), settings_of(settings),
                          optional_array(diameters, particles, "diameters"), frames_of(positions, frames, particles));
    });
  });
}

lanescape_status lanescape_shorten_path_on(const lanescape_landscape* landscape, const double* start, const double* finish,
                                           const double* masses, size_t frames, const double* positions,
                                           const lanescape_shorten_settings* settings, lanescape_short_path** path) {
  return guarded([&] {
    create(path, "path", [&] {
      CallbackLandscape host(landscape);
      const std::size_t n = host.particles();
      return shorten_path(host, vectors(start, n, "start"), vectors(finish, n, "finish"), settings_of(settings),
                          optional_array(masses, n, "masses"), frames_of(positions, frames, n));
    });
  });
}

lanescape_status lanescape_short_path_summarise(const lanescape_short_path* path, lanescape_short_path_summary* summary) {
  return guarded([&] {
    const ShortPath& p = object_of(path, "path");
    auto& out = sized(summary, "summary", "lanescape_short_path_summary");
    out.outcome = p.outcome.c_str();
    out.reason = p.reason.c_str();
    out.length_before = p.length_before;
    out.length = p.length;
    out.distance = p.distance;
    out.ratio_squared = p.ratio_squared;
    out.landscape_energy = p.landscape_energy;
    out.largest_violation = p.largest_violation;
    out.kuhn_tucker_residual = p.kuhn_tucker_residual.value_or(std::numeric_limits<double>::quiet_NaN());
    out.evaluations = p.evaluations;
    out.seconds = p.seconds;
    out.particles = p.frames.empty() ? 0 : p.frames.front().size() / 3;
    out.frames = p.frames.size();
    out.starts = p.start_lengths.size();
    out.reached = p.reached() ? 1 : 0;
    out.has_multipliers = p.multipliers.empty() ? 0 : 1;
  });
}

lanescape_status lanescape_short_path_frame(const lanescape_short_path* path, size_t frame, double* positions) {
  return guarded([&] { copy_frame(object_of(path, "path").frames, frame, positions); });
}

lanescape_status lanescape_short_path_values(const lanescape_short_path* path, double* multipliers, double* start_lengths) {
  return guarded([&] {
    const ShortPath& p = object_of(path, "path");
    if (multipliers != nullptr && p.multipliers.empty())
      refuse("the path has no multipliers: methods whose frames are the whole path give them");
    copy_out(p.multipliers, multipliers);
    copy_out(p.start_lengths, start_lengths);
  });
}

lanescape_status lanescape_short_path_destroy(lanescape_short_path* path) { return destroy(path, "path"); }

lanescape_status lanescape_check_settings_init(lanescape_check_settings* settings, size_t size) {
  return guarded([&] {
    lanescape_check_settings presets{};
    presets.threads = CheckSettings{}.threads;
    initialise(settings, size, "settings", "lanescape_check_settings", presets);
  });
}

lanescape_status lanescape_check_path(const lanescape_model* model, size_t particles, const int* species, const double box[3],
                                      const double* diameters, size_t frames, const double* positions,
                                      const lanescape_check_settings* settings, lanescape_path_certificate* certificate) {
  return guarded([&] {
    auto& out = sized(certificate, "certificate", "lanescape_path_certificate");
    write_certificate(check_path(object_of(model, "model").model, array(species, particles, "species"), three(box, "box"),
                                 frames_of(positions, frames, particles), settings_of(settings),
                                 optional_array(diameters, particles, "diameters")),
                      out);
  });
}

lanescape_status lanescape_check_path_on(const lanescape_landscape* landscape, const double* masses, size_t frames,
                                         const double* positions, const lanescape_check_settings* settings,
                                         lanescape_path_certificate* certificate) {
  return guarded([&] {
    auto& out = sized(certificate, "certificate", "lanescape_path_certificate");
    CallbackLandscape host(landscape);
    const std::size_t n = host.particles();
    write_certificate(check_path(host, frames_of(positions, frames, n), settings_of(settings), optional_array(masses, n, "masses")),
                      out);
  });
}
