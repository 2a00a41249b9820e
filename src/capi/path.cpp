#include "capi/path.hpp"

#include <string>

#include "capi/arguments.hpp"
#include "capi/callbacks.hpp"
#include "capi/model.hpp"

using namespace lanescape;
using namespace lanescape::capi;

struct lanescape_path : Handle<Path> {};

namespace lanescape::capi {

PathSettings path_settings_of(const lanescape_path_settings* given) {
  PathSettings settings;
  if (given == nullptr) return settings;
  const auto& s = sized(given, "settings", "lanescape_path_settings");
  settings.method = word(s.method, "");
  settings.adaptive = s.adaptive != 0;
  settings.step = s.step;
  settings.avoidance_step = s.avoidance_step;
  settings.fictitious = word(s.fictitious, settings.fictitious.c_str());
  if (s.landscape_energy != nullptr) settings.landscape_energy = *s.landscape_energy;
  settings.reverse = s.reverse != 0;
  settings.max_steps = s.max_steps;
  settings.patience = s.patience;
  settings.frames = s.frames;
  settings.threads = s.threads;
  settings.precision = word(s.precision, settings.precision.c_str());
  settings.instruction_set = word(s.instruction_set, settings.instruction_set.c_str());
  settings.progress = progress_of(s.progress, s.progress_user);
  return settings;
}

void copy_frame(const std::vector<std::vector<double>>& frames, std::size_t frame, double* positions) {
  if (frame >= frames.size())
    refuse("frame " + std::to_string(frame) + " is not allowed: the path has " + std::to_string(frames.size()) +
           ", numbered from 0");
  copy_out(frames[frame], &given(positions, "positions"));
}

}  // namespace lanescape::capi

lanescape_status lanescape_path_settings_init(lanescape_path_settings* settings, size_t size) {
  return guarded([&] {
    const PathSettings own;
    lanescape_path_settings presets{};
    presets.max_steps = own.max_steps;
    presets.patience = own.patience;
    presets.frames = own.frames;
    presets.threads = own.threads;
    initialise(settings, size, "settings", "lanescape_path_settings", presets);
  });
}

lanescape_status lanescape_find_path(const lanescape_model* model, size_t particles, const int* species, const double box[3],
                                     const double* start, const double* finish, const double* diameters,
                                     const lanescape_path_settings* settings, lanescape_path** path) {
  return guarded([&] {
    create(path, "path", [&] {
      return find_path(object_of(model, "model").model, array(species, particles, "species"), three(box, "box"),
                       vectors(start, particles, "start"), vectors(finish, particles, "finish"), path_settings_of(settings),
                       optional_array(diameters, particles, "diameters"));
    });
  });
}

lanescape_status lanescape_find_path_on(const lanescape_landscape* landscape, const double* start, const double* finish,
                                        const double* masses, const lanescape_path_settings* settings, lanescape_path** path) {
  return guarded([&] {
    create(path, "path", [&] {
      CallbackLandscape host(landscape);
      const std::size_t n = host.particles();
      return find_path(host, vectors(start, n, "start"), vectors(finish, n, "finish"), path_settings_of(settings),
                       optional_array(masses, n, "masses"));
    });
  });
}

lanescape_status lanescape_path_summarise(const lanescape_path* path, lanescape_path_summary* summary) {
  return guarded([&] {
    const Path& p = object_of(path, "path");
    auto& out = sized(summary, "summary", "lanescape_path_summary");
    out.outcome = p.outcome.c_str();
    out.reason = p.reason.c_str();
    out.length = p.length;
    out.distance = p.distance;
    out.ratio_squared = p.ratio_squared;
    out.participation_ratio = p.participation_ratio;
    out.direct_steps = p.direct_steps;
    out.detour_steps = p.detour_steps;
    out.evaluations = p.evaluations;
    out.landscape_energy = p.landscape_energy;
    out.largest_violation = p.largest_violation;
    out.seconds = p.seconds;
    out.particles = p.frames.empty() ? 0 : p.frames.front().size() / 3;
    out.frames = p.frames.size();
    out.reached = p.reached() ? 1 : 0;
    out.reversed = p.reversed ? 1 : 0;
  });
}

lanescape_status lanescape_path_frame(const lanescape_path* path, size_t frame, double* positions) {
  return guarded([&] { copy_frame(object_of(path, "path").frames, frame, positions); });
}

lanescape_status lanescape_path_destroy(lanescape_path* path) { return destroy(path, "path"); }
