// Models: made by name, text, file and parameters, described, and refused.
#include "check.h"

static const char* const argon = "Ar";
static const double one = 1.0;

static lanescape_pair_parameters lennard_jones(void) {
  lanescape_pair_parameters p;
  OK(lanescape_pair_parameters_init(&p, sizeof p));
  p.form = "lennard-jones";
  p.species = 1;
  p.names = &argon;
  p.epsilon = &one;
  p.sigma = &one;
  return p;
}

static void words_are_listed(void) {
  CHECK(strcmp(lanescape_version(), LANESCAPE_VERSION) == 0);
  CHECK(lanescape_instruction_set(0) != NULL && lanescape_instruction_set(1000) == NULL);
  int found = 0;
  for (size_t k = 0; lanescape_model_name(k) != NULL; ++k) found |= strcmp(lanescape_model_name(k), "kob-andersen") == 0;
  CHECK(found);
  for (size_t k = found = 0; lanescape_pair_potential(k) != NULL; ++k) found |= strcmp(lanescape_pair_potential(k), "yukawa") == 0;
  CHECK(found);
}

static void a_named_model_is_described(void) {
  lanescape_model* model = named_model("kob-andersen");
  lanescape_model_description d = {.size = sizeof d};
  OK(lanescape_model_describe(model, &d));
  CHECK(strcmp(d.name, "kob-andersen") == 0 && d.species == 2 && !d.is_hard && !d.has_states && !d.has_diameters);
  CHECK(d.largest_cutoff == 2.5 && d.length_unit == 1.0);
  const char* name = NULL;
  double mass = 0.0, fraction = 0.0;
  OK(lanescape_model_species(model, 1, &name, &mass, &fraction));
  CHECK(name[0] != '\0' && mass == 1.0 && near(fraction, 0.2, 1e-12));
  REFUSED(lanescape_model_species(model, 2, NULL, NULL, NULL), "the model has 2");
  OK(lanescape_model_destroy(model));
}

static void a_text_makes_the_same_model(const char* path) {
  lanescape_model *model = named_model("kob-andersen"), *copy = NULL;
  size_t needed = 0, again = 0;
  OK(lanescape_model_to_toml(model, NULL, 0, &needed));
  char *text = malloc(needed), *second = malloc(needed);
  OK(lanescape_model_to_toml(model, text, needed, &again));
  CHECK(again == needed && strlen(text) == needed - 1);
  OK(lanescape_model_from_toml(text, &copy));
  OK(lanescape_model_to_toml(copy, second, needed, &again));
  CHECK(again == needed && strcmp(text, second) == 0);
  OK(lanescape_model_to_toml(copy, second, 5, &again));
  CHECK(again == needed && strlen(second) == 4 && strncmp(text, second, 4) == 0);
  OK(lanescape_model_destroy(copy));

  FILE* file = fopen(path, "w");
  CHECK(file != NULL && fputs(text, file) >= 0 && fclose(file) == 0);
  OK(lanescape_model_from_file(path, &copy));
  OK(lanescape_model_to_toml(copy, second, needed, &again));
  CHECK(strcmp(text, second) == 0);
  OK(lanescape_model_destroy(copy));
  OK(lanescape_model_destroy(model));
  remove(path);
  free(text);
  free(second);
}

static void parameters_make_models(void) {
  lanescape_pair_parameters p = lennard_jones();
  lanescape_model* model = NULL;
  p.cutoff = 3.0;
  p.name = "argon";
  OK(lanescape_model_mixture(&p, &model));
  lanescape_model_description d = {.size = sizeof d};
  OK(lanescape_model_describe(model, &d));
  CHECK(strcmp(d.name, "argon") == 0 && d.largest_cutoff == 3.0);
  OK(lanescape_model_destroy(model));

  const double diameter = 2.0;
  lanescape_hard_sphere_parameters spheres;
  OK(lanescape_hard_sphere_parameters_init(&spheres, sizeof spheres));
  spheres.species = 1;
  spheres.names = &argon;
  spheres.diameters = &diameter;
  OK(lanescape_model_hard_spheres(&spheres, &model));
  OK(lanescape_model_describe(model, &d));
  CHECK(d.is_hard && d.length_unit == 2.0);
  OK(lanescape_model_destroy(model));

  const char* key = "exponent";
  const double value = 10.0;
  p.form = "inverse-power";
  p.numbers = 1;
  p.number_keys = &key;
  p.number_values = &value;
  OK(lanescape_model_mixture(&p, &model));
  OK(lanescape_model_destroy(model));
  key = "hardness";
  REFUSED(lanescape_model_mixture(&p, &model), "has no number 'hardness': it has exponent");
}

static void changes_reach_the_model(void) {
  lanescape_model* model = NULL;
  const lanescape_model_changes changes = {.size = sizeof changes, .cutoff = 1.5};
  OK(lanescape_model_named("kob-andersen", &changes, &model));
  lanescape_model_description d = {.size = sizeof d};
  OK(lanescape_model_describe(model, &d));
  CHECK(d.largest_cutoff == 1.5);
  OK(lanescape_model_destroy(model));
  const lanescape_model_changes unknown = {.size = sizeof unknown, .truncation = "sharp"};
  REFUSED(lanescape_model_named("kob-andersen", &unknown, &model), "sharp");
}

static void bad_input_is_refused(void) {
  lanescape_model* model = (lanescape_model*)&failures;
  REFUSED(lanescape_model_named("no-such-model", NULL, &model), "no-such-model");
  CHECK(model == NULL);
  REFUSED(lanescape_model_named(NULL, NULL, &model), "argument name is NULL");
  REFUSED(lanescape_model_named("kob-andersen", NULL, NULL), "argument model is NULL");
  REFUSED(lanescape_model_from_toml("[model]\nkind = 7\n", &model), "");
  REFUSED(lanescape_model_from_file("/no/such/file.toml", &model), "/no/such/file.toml");
  REFUSED(lanescape_model_from_toml(NULL, &model), "argument text is NULL");
  REFUSED(lanescape_model_from_file(NULL, &model), "argument path is NULL");
  REFUSED(lanescape_model_mixture(NULL, &model), "argument parameters is NULL");
  lanescape_pair_parameters p = lennard_jones();
  p.size = 8;
  REFUSED(lanescape_model_mixture(&p, &model), "a lanescape_pair_parameters of size 8 is not known");
  p = lennard_jones();
  p.epsilon = NULL;
  REFUSED(lanescape_model_mixture(&p, &model), "argument epsilon is NULL");
  p = lennard_jones();
  p.names = NULL;
  REFUSED(lanescape_model_mixture(&p, &model), "argument names is NULL");
  p = lennard_jones();
  p.species = SIZE_MAX / 2;
  REFUSED(lanescape_model_mixture(&p, &model), "species");
  REFUSED(lanescape_pair_parameters_init(&p, 3), "of size 3 is not known");
  REFUSED(lanescape_pair_parameters_init(NULL, sizeof p), "argument parameters is NULL");

  model = named_model("lennard-jones");
  size_t needed = 0;
  REFUSED(lanescape_model_to_toml(model, NULL, 0, NULL), "argument needed is NULL");
  REFUSED(lanescape_model_to_toml(model, NULL, 10, &needed), "argument text is NULL");
  lanescape_model_description d = {.size = 1};
  REFUSED(lanescape_model_describe(model, &d), "of size 1 is not known");
  REFUSED(lanescape_model_describe(NULL, &d), "argument model is NULL");
  OK(lanescape_model_destroy(model));
  OK(lanescape_model_destroy(NULL));
  d.size = sizeof d;
  REFUSED(lanescape_model_describe(model, &d), "it was destroyed");
  REFUSED(lanescape_model_destroy(model), "it was destroyed");
}

int main(int argc, char** argv) {
  CHECK(lanescape_last_error()[0] == '\0' && lanescape_last_callback_error() == 0);
  words_are_listed();
  a_named_model_is_described();
  a_text_makes_the_same_model(argc > 1 ? argv[1] : "capi_model_test.toml");
  parameters_make_models();
  changes_reach_the_model();
  bad_input_is_refused();
  return failures != 0;
}
