// Paths on models and on landscapes of the caller.
#include "check.h"

static const int two[2] = {0, 0};

// Two particles with a resting centre, r apart, turned by an angle: the straight way is forbidden.
static void turned(double r, double degrees, double positions[6]) {
  const double angle = degrees * acos(-1.0) / 180.0, x = 0.5 * r * cos(angle), y = 0.5 * r * sin(angle);
  const double both[6] = {5.0 + x, 5.0 + y, 5.0, 5.0 - x, 5.0 - y, 5.0};
  memcpy(positions, both, sizeof both);
}

// The shifted Lennard-Jones potential of two particles without images, and what its calls are made to do.
struct host {
  int calls, fail_at, code;
};

static int evaluate_pair(void* user, const double* x, double* gradient, double* energy) {
  struct host* host = user;
  if (++host->calls == host->fail_at) return host->code;
  const double d[3] = {x[0] - x[3], x[1] - x[4], x[2] - x[5]}, r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  const double s6 = 1.0 / (r2 * r2 * r2), cut6 = pow(2.5, -6.0), inside = r2 < 6.25;
  *energy = inside * 4.0 * (s6 * s6 - s6 - cut6 * cut6 + cut6);
  for (int k = 0; gradient != NULL && k < 3; ++k) {
    gradient[k] = -inside * 24.0 * (2.0 * s6 * s6 - s6) / r2 * d[k];
    gradient[3 + k] = -gradient[k];
  }
  return 0;
}

static lanescape_landscape landscape_of(struct host* host) {
  const lanescape_landscape landscape = {.size = sizeof landscape, .user = host, .particles = 2, .evaluate = evaluate_pair};
  return landscape;
}

static lanescape_path_summary summary_of(const lanescape_path* path) {
  lanescape_path_summary summary = {.size = sizeof summary};
  OK(lanescape_path_summarise(path, &summary));
  return summary;
}

static double start[6], finish[6];

static void both_landscapes_have_one_path(const char* method, int adaptive) {
  lanescape_model* model = named_model("lennard-jones");
  lanescape_path_settings settings;
  OK(lanescape_path_settings_init(&settings, sizeof settings));
  settings.method = method;
  settings.adaptive = adaptive;
  lanescape_path *of_model = NULL, *of_host = NULL;
  OK(lanescape_find_path(model, 2, two, cube, start, finish, NULL, &settings, &of_model));
  struct host host = {0, 0, 0};
  const lanescape_landscape landscape = landscape_of(&host);
  OK(lanescape_find_path_on(&landscape, start, finish, NULL, &settings, &of_host));
  const lanescape_path_summary a = summary_of(of_model), b = summary_of(of_host);
  CHECK(a.reached && strcmp(a.outcome, "reached") == 0 && a.length > a.distance && a.particles == 2 && a.frames > 2);
  CHECK(b.reached && near(a.length, b.length, 1e-3 * a.length) && near(a.landscape_energy, b.landscape_energy, 1e-12));
  CHECK(b.evaluations > 0 && host.calls > 0);
  CHECK((a.direct_steps + a.detour_steps < 300) == adaptive && (b.direct_steps + b.detour_steps < 300) == adaptive);
  double frame[6];
  OK(lanescape_path_frame(of_host, 0, frame));
  CHECK(memcmp(frame, start, sizeof frame) == 0);
  OK(lanescape_path_frame(of_host, b.frames - 1, frame));
  CHECK(memcmp(frame, finish, sizeof frame) == 0);
  REFUSED(lanescape_path_frame(of_host, b.frames, frame), "numbered from 0");
  REFUSED(lanescape_path_frame(of_host, 0, NULL), "argument positions is NULL");
  OK(lanescape_path_destroy(of_model));
  OK(lanescape_path_destroy(of_host));
  lanescape_path_summary gone = {.size = sizeof gone};
  REFUSED(lanescape_path_summarise(of_host, &gone), "it was destroyed");
  OK(lanescape_model_destroy(model));
}

static void an_error_of_the_landscape_comes_back(void) {
  for (int fail_at = 1; fail_at <= 60; fail_at += 20) {
    struct host host = {0, fail_at, 4711 + fail_at};
    const lanescape_landscape landscape = landscape_of(&host);
    lanescape_path* path = (lanescape_path*)&host;
    CHECK(lanescape_find_path_on(&landscape, start, finish, NULL, NULL, &path) == LANESCAPE_CALLBACK_FAILED);
    CHECK(lanescape_last_callback_error() == 4711 + fail_at && strstr(lanescape_last_error(), "returned error code") != NULL);
    CHECK(path == NULL && host.calls == fail_at);
  }
}

static int stop_soon(void* user, double done) {
  ++*(int*)user;
  return done >= 0.0;
}

static void progress_ends_the_search(void) {
  struct host host = {0, 0, 0};
  const lanescape_landscape landscape = landscape_of(&host);
  lanescape_path_settings settings;
  OK(lanescape_path_settings_init(&settings, sizeof settings));
  int reports = 0;
  settings.step = 1e-5;
  settings.progress = stop_soon;
  settings.progress_user = &reports;
  lanescape_path* path = NULL;
  OK(lanescape_find_path_on(&landscape, start, finish, NULL, &settings, &path));
  const lanescape_path_summary summary = summary_of(path);
  CHECK(reports >= 1 && !summary.reached && strcmp(summary.outcome, "interrupted") == 0);
  OK(lanescape_path_destroy(path));
}

static void bad_paths_are_refused(void) {
  lanescape_model* model = named_model("lennard-jones");
  struct host host = {0, 0, 0};
  lanescape_landscape landscape = landscape_of(&host);
  lanescape_path* path = NULL;
  lanescape_path_settings settings;
  OK(lanescape_path_settings_init(&settings, sizeof settings));
  settings.threads = 0;
  REFUSED(lanescape_find_path_on(&landscape, start, finish, NULL, &settings, &path), "0 threads are not allowed");
  settings.threads = 1;
  settings.method = "escape";
  settings.adaptive = 1;
  REFUSED(lanescape_find_path_on(&landscape, start, finish, NULL, &settings, &path), "method escape has no adaptive steps");
  settings.method = "magic";
  REFUSED(lanescape_find_path_on(&landscape, start, finish, NULL, &settings, &path), "magic");
  settings.size = 4;
  REFUSED(lanescape_find_path(model, 2, two, cube, start, finish, NULL, &settings, &path), "of size 4 is not known");
  double bad[6];
  memcpy(bad, start, sizeof bad);
  bad[2] = NAN;
  REFUSED(lanescape_find_path(model, 2, two, cube, bad, finish, NULL, NULL, &path), "finite");
  REFUSED(lanescape_find_path_on(&landscape, bad, finish, NULL, NULL, &path), "finite");
  REFUSED(lanescape_find_path_on(&landscape, start, start, NULL, NULL, &path), "coincide");
  REFUSED(lanescape_find_path(model, 2, two, cube, NULL, finish, NULL, NULL, &path), "argument start is NULL");
  REFUSED(lanescape_find_path(model, 2, two, cube, start, NULL, NULL, NULL, &path), "argument finish is NULL");
  REFUSED(lanescape_find_path(model, 2, NULL, cube, start, finish, NULL, NULL, &path), "argument species is NULL");
  REFUSED(lanescape_find_path(model, 2, two, cube, start, finish, NULL, NULL, NULL), "argument path is NULL");
  REFUSED(lanescape_find_path_on(NULL, start, finish, NULL, NULL, &path), "argument landscape is NULL");
  const double masses[2] = {1.0, -1.0};
  REFUSED(lanescape_find_path_on(&landscape, start, finish, masses, NULL, &path), "mass -1 of particle 1");
  landscape.evaluate = NULL;
  REFUSED(lanescape_find_path_on(&landscape, start, finish, NULL, NULL, &path), "argument landscape->evaluate is NULL");
  landscape.size = 1;
  REFUSED(lanescape_find_path_on(&landscape, start, finish, NULL, NULL, &path), "of size 1 is not known");
  REFUSED(lanescape_path_settings_init(&settings, 0), "of size 0 is not known");
  const int unknown[2] = {0, 3};
  REFUSED(lanescape_find_path(model, 2, unknown, cube, start, finish, NULL, NULL, &path), "3");
  CHECK(path == NULL);
  OK(lanescape_model_destroy(model));
}

int main(void) {
  turned(1.3, 0.0, start);
  turned(1.25, 120.0, finish);
  both_landscapes_have_one_path("contour", 0);
  both_landscapes_have_one_path("contour", 1);
  both_landscapes_have_one_path("escape", 0);
  an_error_of_the_landscape_comes_back();
  progress_ends_the_search();
  bad_paths_are_refused();
  return failures != 0;
}
