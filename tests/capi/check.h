#pragma once

// What the tests of the C interface share: plain C, a process each.

#include <lanescape/lanescape.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition)                                                                                              \
  do {                                                                                                                \
    if (!(condition)) {                                                                                               \
      ++failures;                                                                                                     \
      fprintf(stderr, "%s:%d: false: %s (last error: %s)\n", __FILE__, __LINE__, #condition, lanescape_last_error()); \
    }                                                                                                                 \
  } while (0)

// The call succeeds; a test cannot go on without.
#define OK(call)                                                                                        \
  do {                                                                                                  \
    const lanescape_status ok_status = (call);                                                          \
    if (ok_status != LANESCAPE_OK) {                                                                    \
      fprintf(stderr, "%s:%d: status %d: %s\n", __FILE__, __LINE__, ok_status, lanescape_last_error()); \
      exit(1);                                                                                          \
    }                                                                                                   \
  } while (0)

// The call is refused as bad input with a message that has these words.
#define REFUSED(call, words) CHECK((call) == LANESCAPE_BAD_INPUT && strstr(lanescape_last_error(), words) != NULL)

static inline int near(double a, double b, double tolerance) { return fabs(a - b) <= tolerance; }

static inline lanescape_model* named_model(const char* name) {
  lanescape_model* model = NULL;
  OK(lanescape_model_named(name, NULL, &model));
  return model;
}

static const double cube[3] = {10.0, 10.0, 10.0};
