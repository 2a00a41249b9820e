// Paths made short and checked, on models and on landscapes of the caller.
#include "check.h"

static const int two[2] = {0, 0};
enum { most_frames = 300 };

// Two particles with a resting centre, r apart, turned by an angle in radians.
static void turned(double r, double angle, double positions[6]) {
  const double x = 0.5 * r * cos(angle), y = 0.5 * r * sin(angle);
  const double both[6] = {5.0 + x, 5.0 + y, 5.0, 5.0 - x, 5.0 - y, 5.0};
  memcpy(positions, both, sizeof both);
}

// How near two particles are, so that E_L = 0 is the surface of hard spheres of diameter 1, and what its calls are made to do.
struct host {
  int calls, fail_at;
};

static int evaluate_nearness(void* user, const double* x, double* gradient, double* energy) {
  struct host* host = user;
  if (++host->calls == host->fail_at) return 4711;
  const double d[3] = {x[0] - x[3], x[1] - x[4], x[2] - x[5]}, r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  *energy = 1.0 - r;
  for (int k = 0; gradient != NULL && k < 3; ++k) {
    gradient[k] = -d[k] / r;
    gradient[3 + k] = d[k] / r;
  }
  return 0;
}

static lanescape_landscape landscape_of(struct host* host) {
  const lanescape_landscape landscape = {.size = sizeof landscape, .user = host, .particles = 2, .evaluate = evaluate_nearness};
  return landscape;
}

static const double no_energy = 0.0;
static double start[6], finish[6], angle;

// The taut path of two spheres around each other, from 3 apart to 3 apart: straight, along the contact, straight.
static size_t taut_path(double* positions) {
  const double tangent = acos(1.0 / 3.0);
  const int segments = 200;
  memcpy(positions, start, sizeof start);
  for (int k = 0; k <= segments; ++k) turned(1.0, tangent + (angle - 2.0 * tangent) * k / segments, positions + 6 * (k + 1));
  memcpy(positions + 6 * (segments + 2), finish, sizeof finish);
  return (size_t)segments + 3;
}

static lanescape_short_path_summary summary_of(const lanescape_short_path* path) {
  lanescape_short_path_summary summary = {.size = sizeof summary};
  OK(lanescape_short_path_summarise(path, &summary));
  return summary;
}

static lanescape_shorten_settings settings_with(const char* method, const lanescape_path_settings* search) {
  lanescape_shorten_settings settings;
  OK(lanescape_shorten_settings_init(&settings, sizeof settings));
  settings.method = method;
  settings.search = search;
  return settings;
}

static lanescape_path_settings search_on_the_surface(void) {
  lanescape_path_settings search;
  OK(lanescape_path_settings_init(&search, sizeof search));
  search.landscape_energy = &no_energy;
  return search;
}

static void every_method_shortens_a_path(void) {
  const lanescape_path_settings search = search_on_the_surface();
  for (size_t k = 0; lanescape_shorten_method(k) != NULL; ++k) {
    lanescape_shorten_settings settings = settings_with(lanescape_shorten_method(k), &search);
    settings.starts = 2;
    struct host host = {0, 0};
    const lanescape_landscape landscape = landscape_of(&host);
    lanescape_short_path* path = NULL;
    OK(lanescape_shorten_path_on(&landscape, start, finish, NULL, 0, NULL, &settings, &path));
    const lanescape_short_path_summary s = summary_of(path);
    CHECK(s.reached && strcmp(s.outcome, "reached") == 0 && s.length <= s.length_before && s.particles == 2 && s.starts == 2);
    CHECK(s.length > s.distance && near(s.ratio_squared, s.distance * s.distance / (s.length * s.length), 1e-12));
    CHECK(s.has_multipliers == !isnan(s.kuhn_tucker_residual));
    double lengths[2], frame[6];
    OK(lanescape_short_path_values(path, NULL, lengths));
    CHECK(s.length == fmin(lengths[0], lengths[1]));
    OK(lanescape_short_path_frame(path, 0, frame));
    CHECK(memcmp(frame, start, sizeof frame) == 0);
    OK(lanescape_short_path_frame(path, s.frames - 1, frame));
    CHECK(memcmp(frame, finish, sizeof frame) == 0);
    REFUSED(lanescape_short_path_frame(path, s.frames, frame), "numbered from 0");
    if (!s.has_multipliers) REFUSED(lanescape_short_path_values(path, lengths, NULL), "the path has no multipliers");
    if (s.has_multipliers) CHECK(near(s.length, 6.1620 / sqrt(2.0), 1e-4 * s.length) && s.kuhn_tucker_residual < 1e-2);
    OK(lanescape_short_path_destroy(path));
    lanescape_short_path_summary gone = {.size = sizeof gone};
    REFUSED(lanescape_short_path_summarise(path, &gone), "it was destroyed");
  }
}

static void a_given_path_is_shortened(void) {
  double positions[6 * most_frames];
  const size_t frames = taut_path(positions);
  const double energy = 1e-4;  // of the corners of the contact
  lanescape_path_settings search = search_on_the_surface();
  search.landscape_energy = &energy;
  const lanescape_shorten_settings settings = settings_with("montecarlo", &search);
  struct host host = {0, 0};
  const lanescape_landscape landscape = landscape_of(&host);
  lanescape_short_path* path = NULL;
  OK(lanescape_shorten_path_on(&landscape, start, finish, NULL, frames, positions, &settings, &path));
  const lanescape_short_path_summary s = summary_of(path);
  CHECK(s.reached && near(s.length_before, 6.1620 / sqrt(2.0), 1e-2) && s.length <= s.length_before);
  OK(lanescape_short_path_destroy(path));
  REFUSED(lanescape_shorten_path_on(&landscape, start, finish, NULL, 2, positions, &settings, &path), "at least 3");
  REFUSED(lanescape_shorten_path_on(&landscape, start, finish, NULL, frames - 1, positions, &settings, &path),
          "are not the end points");
  REFUSED(lanescape_shorten_path_on(&landscape, start, finish, NULL, frames, NULL, &settings, &path), "argument positions is NULL");
  turned(0.9, 1.5, positions + 12);
  REFUSED(lanescape_shorten_path_on(&landscape, start, finish, NULL, frames, positions, &settings, &path), "its energy 0.1");
  positions[12] = NAN;
  REFUSED(lanescape_shorten_path_on(&landscape, start, finish, NULL, frames, positions, &settings, &path), "finite");
}

static void a_model_has_short_paths_too(void) {
  lanescape_model* model = named_model("hard-sphere");
  lanescape_path_settings search;
  OK(lanescape_path_settings_init(&search, sizeof search));
  search.method = "away";
  lanescape_shorten_settings settings = settings_with("montecarlo", &search);
  lanescape_short_path* path = NULL;
  OK(lanescape_shorten_path(model, 2, two, cube, start, finish, NULL, 0, NULL, &settings, &path));
  const lanescape_short_path_summary s = summary_of(path);
  CHECK(s.reached && s.length <= s.length_before && s.length > 6.16 / sqrt(2.0) && s.largest_violation < 1e-9);
  OK(lanescape_short_path_destroy(path));
  settings.method = "walk";
  REFUSED(lanescape_shorten_path(model, 2, two, cube, start, finish, NULL, 0, NULL, &settings, &path), "unknown method 'walk'");
  settings.method = NULL;
  settings.starts = 0;
  REFUSED(lanescape_shorten_path(model, 2, two, cube, start, finish, NULL, 0, NULL, &settings, &path), "0 starts");
  settings.starts = 1;
  search.reverse = 1;
  REFUSED(lanescape_shorten_path(model, 2, two, cube, start, finish, NULL, 0, NULL, &settings, &path), "without reverse");
  search.size = 3;
  REFUSED(lanescape_shorten_path(model, 2, two, cube, start, finish, NULL, 0, NULL, &settings, &path), "of size 3 is not known");
  settings.size = 4;
  REFUSED(lanescape_shorten_path(model, 2, two, cube, start, finish, NULL, 0, NULL, &settings, &path), "of size 4 is not known");
  REFUSED(lanescape_shorten_path(model, 2, two, cube, NULL, finish, NULL, 0, NULL, NULL, &path), "argument start is NULL");
  REFUSED(lanescape_shorten_path(NULL, 2, two, cube, start, finish, NULL, 0, NULL, NULL, &path), "argument model is NULL");
  REFUSED(lanescape_shorten_path(model, 0, NULL, cube, NULL, NULL, NULL, 5, NULL, NULL, &path), "a path of no particles");
  CHECK(path == NULL);
  REFUSED(lanescape_shorten_path(model, 2, two, cube, start, finish, NULL, 0, NULL, NULL, NULL), "argument path is NULL");
  REFUSED(lanescape_shorten_settings_init(&settings, 0), "of size 0 is not known");
  OK(lanescape_model_destroy(model));
}

static int stop_at_once(void* user, double made) {
  ++*(int*)user;
  return made >= 0.0;
}

static void callbacks_end_the_work(void) {
  lanescape_path_settings search = search_on_the_surface();
  int reports = 0;
  search.progress = stop_at_once;
  search.progress_user = &reports;
  const lanescape_shorten_settings settings = settings_with(NULL, &search);
  struct host host = {0, 0}, failing = {0, 30};
  lanescape_landscape landscape = landscape_of(&host);
  lanescape_short_path* path = NULL;
  OK(lanescape_shorten_path_on(&landscape, start, finish, NULL, 0, NULL, &settings, &path));
  const lanescape_short_path_summary s = summary_of(path);
  CHECK(reports == 1 && strcmp(s.outcome, "interrupted") == 0 && s.frames == 0 && s.starts == 0 && s.length == 0.0);
  OK(lanescape_short_path_destroy(path));
  landscape = landscape_of(&failing);
  CHECK(lanescape_shorten_path_on(&landscape, start, finish, NULL, 0, NULL, NULL, &path) == LANESCAPE_CALLBACK_FAILED);
  CHECK(lanescape_last_callback_error() == 4711 && failing.calls == 30 && path == NULL);
}

static void the_taut_path_has_a_certificate(void) {
  double positions[6 * most_frames], multipliers[most_frames], excess[most_frames], violation[most_frames];
  const size_t frames = taut_path(positions);
  lanescape_path_certificate found[2];
  for (int k = 0; k < 2; ++k) {
    const lanescape_path_certificate empty = {
        .size = sizeof empty, .multipliers = multipliers, .excess = excess, .segment_violation = violation};
    found[k] = empty;
  }
  lanescape_model* model = named_model("hard-sphere");
  OK(lanescape_check_path(model, 2, two, cube, NULL, frames, positions, NULL, &found[0]));
  CHECK(multipliers[0] == 0.0 && multipliers[100] > 0.0 && near(excess[100], 0.0, 1e-12) && violation[100] > 0.0);
  CHECK(near(excess[0], 2.0, 1e-12));
  struct host host = {0, 0};
  const lanescape_landscape landscape = landscape_of(&host);
  lanescape_check_settings settings;
  OK(lanescape_check_settings_init(&settings, sizeof settings));
  settings.landscape_energy = &no_energy;
  OK(lanescape_check_path_on(&landscape, NULL, frames, positions, &settings, &found[1]));
  CHECK(near(excess[0], -2.0, 1e-12) && host.calls > 0);
  for (int k = 0; k < 2; ++k)
    CHECK(near(found[k].length, 6.1620 / sqrt(2.0), 1e-4) && found[k].kuhn_tucker_residual < 1e-2 &&
          found[k].largest_violation < 1e-4 && found[k].distance < found[k].length);
  lanescape_path_certificate only_numbers = {.size = sizeof only_numbers};
  OK(lanescape_check_path_on(&landscape, NULL, frames, positions, &settings, &only_numbers));
  CHECK(only_numbers.length == found[1].length);
  REFUSED(lanescape_check_path(model, 2, two, cube, NULL, 2, positions, NULL, &found[0]), "at least 3 are needed");
  REFUSED(lanescape_check_path(model, 2, two, cube, NULL, frames, positions, &settings, &found[0]), "no landscape energy");
  REFUSED(lanescape_check_path(model, 2, two, cube, NULL, frames, NULL, NULL, &found[0]), "argument positions is NULL");
  REFUSED(lanescape_check_path(model, 2, two, cube, NULL, frames, positions, NULL, NULL), "argument certificate is NULL");
  REFUSED(lanescape_check_path(model, 0, NULL, cube, NULL, SIZE_MAX, NULL, NULL, &found[0]), "a path of no particles");
  REFUSED(lanescape_check_path(model, 2, two, cube, NULL, SIZE_MAX / 4, positions, NULL, &found[0]), "are possible");
  memcpy(positions + 6, positions, sizeof start);
  REFUSED(lanescape_check_path_on(&landscape, NULL, frames, positions, &settings, &found[1]), "coincide");
  settings.threads = 0;
  REFUSED(lanescape_check_path_on(&landscape, NULL, frames, positions, &settings, &found[1]), "0 threads are not allowed");
  settings.size = 5;
  REFUSED(lanescape_check_path_on(&landscape, NULL, frames, positions, &settings, &found[1]), "of size 5 is not known");
  found[1].size = 6;
  REFUSED(lanescape_check_path_on(&landscape, NULL, frames, positions, NULL, &found[1]), "of size 6 is not known");
  OK(lanescape_model_destroy(model));
}

int main(void) {
  angle = 170.0 * acos(-1.0) / 180.0;
  turned(3.0, 0.0, start);
  turned(3.0, angle, finish);
  every_method_shortens_a_path();
  a_given_path_is_shortened();
  a_model_has_short_paths_too();
  callbacks_end_the_work();
  the_taut_path_has_a_certificate();
  return failures != 0;
}
