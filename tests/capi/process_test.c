// What a host process does: threads, fork, and very many calls.
#define _POSIX_C_SOURCE 200809L
#include <sys/wait.h>
#include <threads.h>
#include <unistd.h>

#include "check.h"

enum { particles = 108, evaluations = 2000 };
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HAS_ADDRESS_SANITIZER
#endif
#endif
#if defined(HAS_ADDRESS_SANITIZER) || defined(__SANITIZE_ADDRESS__)
enum { holds_freed_memory = 1 };
#else
enum { holds_freed_memory = 0 };
#endif
static int species[particles];
static double positions[3 * particles], box[3], expected;

static lanescape_potential* make_potential(void) {
  lanescape_model* model = named_model("kob-andersen");
  lanescape_potential* potential = NULL;
  OK(lanescape_make_start(model, particles, 1.2, 1, species, positions, box, NULL));
  OK(lanescape_potential_create(model, particles, species, box, NULL, &potential));
  OK(lanescape_model_destroy(model));
  return potential;
}

static double energy_of(lanescape_potential* potential) {
  double energy = NAN, forces[3 * particles];
  const lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy, .forces = forces};
  OK(lanescape_potential_evaluate(potential, positions, &outputs));
  return energy;
}

// Each thread has an object, and errors of its own.
static int work(void* name) {
  lanescape_model* model = NULL;
  int wrong = 0;
  if (lanescape_last_error()[0] != '\0') ++wrong;
  if (lanescape_model_named(name, NULL, &model) != LANESCAPE_BAD_INPUT) ++wrong;
  lanescape_model* known = named_model("kob-andersen");
  lanescape_potential* potential = NULL;
  OK(lanescape_potential_create(known, particles, species, box, NULL, &potential));
  for (int k = 0; k < evaluations; ++k) wrong += energy_of(potential) != expected;
  OK(lanescape_potential_destroy(potential));
  OK(lanescape_model_destroy(known));
  return wrong + (strstr(lanescape_last_error(), name) == NULL);
}

static void threads_do_not_disturb_each_other(void) {
  lanescape_potential* potential = make_potential();
  expected = energy_of(potential);
  OK(lanescape_potential_destroy(potential));
  thrd_t first, second;
  int wrong_first = 1, wrong_second = 1;
  CHECK(thrd_create(&first, work, "unknown-one") == thrd_success && thrd_create(&second, work, "unknown-two") == thrd_success);
  CHECK(thrd_join(first, &wrong_first) == thrd_success && thrd_join(second, &wrong_second) == thrd_success);
  CHECK(wrong_first == 0 && wrong_second == 0);
  CHECK(strstr(lanescape_last_error(), "unknown") == NULL);
}

// A child of a process whose evaluations use threads goes on without them.
static void a_forked_child_goes_on(void) {
  enum { many = 4000 };
  static int kinds[many];
  static double fluid[3 * many], forces[3 * many];
  double edges[3], energy = NAN;
  lanescape_model* model = named_model("kob-andersen");
  lanescape_potential_options options;
  OK(lanescape_potential_options_init(&options, sizeof options));
  options.threads = 2;
  lanescape_potential* potential = NULL;
  OK(lanescape_make_start(model, many, 1.2, 1, kinds, fluid, edges, NULL));
  OK(lanescape_potential_create(model, many, kinds, edges, &options, &potential));
  const lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy, .forces = forces};
  OK(lanescape_potential_evaluate(potential, fluid, &outputs));
  const double before = energy;
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);  // ends a child that waits for ever
    _exit(lanescape_potential_evaluate(potential, fluid, &outputs) == LANESCAPE_OK && energy == before ? 0 : 1);
  }
  int status = -1;
  CHECK(child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0);
  OK(lanescape_potential_evaluate(potential, fluid, &outputs));
  CHECK(energy == before);
  OK(lanescape_potential_destroy(potential));
  OK(lanescape_model_destroy(model));
}

static lanescape_potential* shared_potential;

// Calls on an object that the other thread may be using.
static int work_on_shared(void* refused) {
  int wrong = 0;
  double energy = NAN, forces[3 * particles];
  const lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy, .forces = forces};
  for (int k = 0; k < evaluations; ++k) {
    const lanescape_status status = lanescape_potential_evaluate(shared_potential, positions, &outputs);
    if (status == LANESCAPE_OK)
      wrong += energy != expected;
    else if (status == LANESCAPE_BAD_INPUT && strstr(lanescape_last_error(), "in use by another call") != NULL)
      ++*(int*)refused;
    else
      ++wrong;
  }
  return wrong;
}

static void two_threads_on_one_object_get_no_wrong_numbers(void) {
  shared_potential = make_potential();
  expected = energy_of(shared_potential);
  thrd_t first, second;
  int wrong_first = 1, wrong_second = 1, refused_first = 0, refused_second = 0;
  CHECK(thrd_create(&first, work_on_shared, &refused_first) == thrd_success);
  CHECK(thrd_create(&second, work_on_shared, &refused_second) == thrd_success);
  CHECK(thrd_join(first, &wrong_first) == thrd_success && thrd_join(second, &wrong_second) == thrd_success);
  CHECK(wrong_first == 0 && wrong_second == 0 && refused_first + refused_second < 2 * evaluations);
  fprintf(stderr, "calls refused because another thread used the object: %d of %d\n", refused_first + refused_second,
          2 * evaluations);
  OK(lanescape_potential_destroy(shared_potential));
}

static long resident_pages(void) {
  long size = 0, resident = 0;
  FILE* file = fopen("/proc/self/statm", "r");
  if (file == NULL) return 0;
  if (fscanf(file, "%ld %ld", &size, &resident) != 2) resident = 0;
  fclose(file);
  return resident;
}

// Of everything that allocates or fails, on two particles.
static void round_of_calls(lanescape_model* model, lanescape_potential* potential) {
  const int two[2] = {0, 0};
  static const double apart[6] = {9.5, 1.0, 2.0, 1.0, 1.0, 2.0};
  double energy = 0.0, forces[6];
  const lanescape_outputs outputs = {.size = sizeof outputs, .energy = &energy, .forces = forces};
  for (int k = 0; k < 900; ++k) OK(lanescape_potential_evaluate(potential, apart, &outputs));
  for (int k = 0; k < 95; ++k) REFUSED(lanescape_potential_evaluate(potential, NULL, &outputs), "NULL");
  lanescape_potential* another = NULL;
  OK(lanescape_potential_create(model, 2, two, cube, NULL, &another));
  OK(lanescape_potential_evaluate(another, apart, &outputs));
  OK(lanescape_potential_destroy(another));
  REFUSED(lanescape_potential_create(model, 2, NULL, cube, NULL, &another), "NULL");
  REFUSED(lanescape_potential_evaluate(another, apart, &outputs), "NULL");
}

static void a_million_calls_do_not_grow(void) {
  const int two[2] = {0, 0};
  lanescape_model* model = named_model("lennard-jones");
  lanescape_potential* potential = NULL;
  OK(lanescape_potential_create(model, 2, two, cube, NULL, &potential));
  for (int k = 0; k < 20; ++k) round_of_calls(model, potential);
  const long before = resident_pages();
  for (int k = 0; k < 1000; ++k) round_of_calls(model, potential);
  const long grown = resident_pages() - before;
  fprintf(stderr, "resident memory after 1e6 calls: %+ld pages\n", grown);
  CHECK(before > 0 && (holds_freed_memory || grown < 100));
  OK(lanescape_potential_destroy(potential));
  OK(lanescape_model_destroy(model));
}

int main(void) {
  threads_do_not_disturb_each_other();
  two_threads_on_one_object_get_no_wrong_numbers();
  a_forked_child_goes_on();
  a_million_calls_do_not_grow();
  return failures != 0;
}
