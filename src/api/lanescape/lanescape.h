#pragma once

// The C interface, C11. Lengths, energies and masses are in any consistent units; k_B = 1. Positions are x0 y0 z0 x1 ..., 3N
// numbers; boxes are three edge lengths of a periodic orthorhombic box; particles are numbered from 0.
//
// Functions return a status and never end the process; lanescape_last_error() says in one line what is wrong, where and what is
// allowed. What they write is written only if the status is LANESCAPE_OK, unless stated otherwise. Structs begin with their size,
// sizeof the struct; one of a size that this library does not know is refused. The functions *_init fill structs with the
// library's defaults, which comments give after the field's meaning; where a struct of settings may be NULL, that stands for these.
// A word that is NULL, as after *_init, is the first one of its comment.
//
// Objects are made by the functions that take a pointer to a handle, and freed by *_destroy, which accepts NULL. A destroyed handle
// is refused until its memory serves a new object of its kind. An object serves one call at a time: a second one, from another
// thread or a callback, is refused. Different objects may be used by different threads, models, paths and end points by several. An
// object keeps what it needs of the objects and arrays it was made from.

#include <stddef.h>
#include <stdint.h>

#include <lanescape/version.h>

#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif
#ifdef __cplusplus
extern "C" {
#endif

typedef int lanescape_status;
enum {
  LANESCAPE_OK = 0,
  LANESCAPE_GOAL_NOT_REACHED = 1,  // the run was sound but ended at a limit
  LANESCAPE_BAD_INPUT = 2,         // the caller's data or options
  LANESCAPE_INTERNAL = 3,          // a defect of the library, or no memory
  LANESCAPE_INTERRUPTED = 4,       // the caller's progress function or a signal ended it before it was done
  LANESCAPE_CALLBACK_FAILED = 5    // a function of the caller returned an error code, or threw
};

// Objects of the library.
typedef struct lanescape_model lanescape_model;
typedef struct lanescape_potential lanescape_potential;
typedef struct lanescape_moves lanescape_moves;
typedef struct lanescape_listed_potential lanescape_listed_potential;
typedef struct lanescape_neighbours lanescape_neighbours;
typedef struct lanescape_hard_spheres lanescape_hard_spheres;
typedef struct lanescape_inserter lanescape_inserter;
typedef struct lanescape_path lanescape_path;
typedef struct lanescape_short_path lanescape_short_path;
typedef struct lanescape_end_points lanescape_end_points;
typedef struct lanescape_dynamics lanescape_dynamics;
typedef struct lanescape_event_driven lanescape_event_driven;

// The message of this thread's last call that failed, "" if none has; valid until the next one fails.
const char* lanescape_last_error(void);
// What the caller's function returned in this thread's last call that ended with LANESCAPE_CALLBACK_FAILED; 0 if it threw.
int lanescape_last_callback_error(void);
// The version of the library that runs, e.g. "0.1.0"; LANESCAPE_VERSION is that of this header.
const char* lanescape_version(void);
// Words for options; NULL for an index beyond the last. Instruction sets that this processor has, best last; models by name; pair
// potentials.
const char* lanescape_instruction_set(size_t index);
const char* lanescape_model_name(size_t index);
const char* lanescape_pair_potential(size_t index);

// Called now and then by long work with the part done, 0 ... 1; anything but 0 ends the work early. As for all functions of
// the caller: it must not jump out; an exception counts as a failure.
typedef int (*lanescape_progress)(void* user, double done);

// Models: what particles are and how they interact. They do not change, and may be used by several threads at once.
// Changes of a named model; what is NULL or 0 stays.
typedef struct lanescape_model_changes {
  size_t size;
  double cutoff;                    // in units of sigma_ab
  const char *truncation, *images;  // words as in lanescape_pair_parameters
} lanescape_model_changes;

// A mixture of `species` species with a pair potential of one form. Matrices are species x species, row-major and symmetric.
typedef struct lanescape_pair_parameters {
  size_t size;
  const char* name;  // mixture, or any one line
  const char* form;  // lennard-jones, or another word of lanescape_pair_potential()
  size_t species;
  const char* const* names;          // chemical symbols
  const double *masses, *fractions;  // of each species, or NULL for 1
  const double *epsilon, *sigma;     // energy and length of each pair of species
  size_t numbers;                    // what the form has beside these, by the keys of docs/FORMATS.md
  const char* const* number_keys;
  const double* number_values;
  double cutoff;           // in units of sigma_ab, 2.5; forms of a fixed range have their own
  const char* truncation;  // shifted, plain, tail, shifted-force, smooth
  const char* images;      // all, or minimum: the nearest image of a pair only
} lanescape_pair_parameters;

// Additive hard spheres.
typedef struct lanescape_hard_sphere_parameters {
  size_t size;
  const char* name;  // hard-spheres, or any one line
  size_t species;
  const char* const* names;          // chemical symbols
  const double *masses, *fractions;  // of each species, or NULL for 1
  const double* diameters;           // of each species
} lanescape_hard_sphere_parameters;

typedef struct lanescape_model_description {
  size_t size;
  const char* name;  // valid while the model is
  size_t species;
  int is_hard;            // hard spheres: overlaps instead of energies
  int has_states;         // sites in states
  int has_diameters;      // every particle has a diameter of its own
  double largest_cutoff;  // beyond which no two particles interact; 0 for hard spheres
  double length_unit;     // a power of two near the largest diameter; default steps are given in it
} lanescape_model_description;

lanescape_status lanescape_pair_parameters_init(lanescape_pair_parameters* parameters, size_t size);
lanescape_status lanescape_hard_sphere_parameters_init(lanescape_hard_sphere_parameters* parameters, size_t size);

lanescape_status lanescape_model_named(const char* name, const lanescape_model_changes* changes, lanescape_model** model);
lanescape_status lanescape_model_mixture(const lanescape_pair_parameters* parameters, lanescape_model** model);
lanescape_status lanescape_model_hard_spheres(const lanescape_hard_sphere_parameters* parameters, lanescape_model** model);
// A model file (docs/FORMATS.md), or its text.
lanescape_status lanescape_model_from_file(const char* path, lanescape_model** model);
lanescape_status lanescape_model_from_toml(const char* text, lanescape_model** model);
// The text from which the same model is made, bit for bit. Writes up to `capacity` bytes, the last one 0, and to `needed` the
// capacity for the whole text; `text` may be NULL with capacity 0.
lanescape_status lanescape_model_to_toml(const lanescape_model* model, char* text, size_t capacity, size_t* needed);
lanescape_status lanescape_model_describe(const lanescape_model* model, lanescape_model_description* description);
// What is NULL is not written; the name is valid while the model is.
lanescape_status lanescape_model_species(const lanescape_model* model, size_t species, const char** name, double* mass,
                                         double* fraction);
lanescape_status lanescape_model_destroy(lanescape_model* model);

// The potential energy of a soft model: of pairs, or of sites in states.
typedef struct lanescape_potential_options {
  size_t size;
  int threads;                  // that share an evaluation, 1; no effect on any result
  const char* precision;        // double, or mixed: relative errors near 1e-6
  const char* instruction_set;  // auto, or a word of lanescape_instruction_set()
  const double* diameters;      // of each particle, for models that have them
} lanescape_potential_options;

// Where an evaluation writes; what is NULL is not computed. stress: xx yy zz yz xz xy, minus sum r_a f_b over the volume. energies:
// of each particle, half of each of its pairs.
typedef struct lanescape_outputs {
  size_t size;
  double *energy, *virial;
  double* stress;    // 6
  double* forces;    // 3N, -dV/dr
  double* energies;  // N
} lanescape_outputs;

lanescape_status lanescape_potential_options_init(lanescape_potential_options* options, size_t size);
// species: of each particle, from 0. options may be NULL.
lanescape_status lanescape_potential_create(const lanescape_model* model, size_t particles, const int* species, const double box[3],
                                            const lanescape_potential_options* options, lanescape_potential** potential);
// An object of its own; pair potentials have copies and exclusions, sites in states have not.
lanescape_status lanescape_potential_copy(const lanescape_potential* potential, lanescape_potential** copy);
lanescape_status lanescape_potential_particles(const lanescape_potential* potential, size_t* particles);
// Pairs of particles that do not interact, such as bonded ones, in place of those before: 2 particles of each. Only the nearest
// image of a pair is left out.
lanescape_status lanescape_potential_set_exclusions(lanescape_potential* potential, size_t pairs, const size_t* particles);
lanescape_status lanescape_potential_set_box(lanescape_potential* potential, const double box[3]);
// Positions may lie anywhere; they are wrapped.
lanescape_status lanescape_potential_evaluate(lanescape_potential* potential, const double* positions,
                                              const lanescape_outputs* outputs);
// N vectors in the caller's memory: x of particle i is x[i * stride], and so on. Separate arrays have stride 1, interleaved ones 3.
typedef struct lanescape_positions {
  size_t size;
  const double *x, *y, *z;
  ptrdiff_t stride;
} lanescape_positions;
typedef struct lanescape_forces {
  size_t size;
  double *x, *y, *z;
  ptrdiff_t stride;
} lanescape_forces;
// As lanescape_potential_evaluate(), with arrays of this shape: forces, or NULL, are in place of outputs->forces, which is NULL.
lanescape_status lanescape_potential_evaluate_strided(lanescape_potential* potential, const lanescape_positions* positions,
                                                      const lanescape_outputs* outputs, const lanescape_forces* forces);
// Of the last evaluation of sites in states: how many states sites have, order parameters, N, and probabilities, N x states. What
// is NULL is not written.
lanescape_status lanescape_potential_states(const lanescape_potential* potential, size_t* states, double* order_parameters,
                                            double* probabilities);
lanescape_status lanescape_potential_destroy(lanescape_potential* potential);

// Moves of one particle at a time, for Monte Carlo, with a pair potential. options may be NULL; threads and precision have no
// effect.
lanescape_status lanescape_moves_create(const lanescape_model* model, size_t particles, const int* species, const double* positions,
                                        const double box[3], const lanescape_potential_options* options, lanescape_moves** moves);
// By how much the energy rises if one particle goes there while all others stand still, at a cost that does not depend on N.
lanescape_status lanescape_moves_energy_change(lanescape_moves* moves, size_t particle, const double to[3], double* change);
// Makes the last move that was asked for.
lanescape_status lanescape_moves_accept(lanescape_moves* moves);
// Copies the 3N numbers, with the moves that were made.
lanescape_status lanescape_moves_positions(const lanescape_moves* moves, double* positions);
lanescape_status lanescape_moves_destroy(lanescape_moves* moves);

// Pairs within a cutoff, with ASE's conventions (neighbor_list("ijSDd")). Objects keep their memory from call to call.
typedef struct lanescape_neighbour_options {
  size_t size;
  double cutoff;                       // of all pairs, where cutoffs is NULL; to be set
  size_t species;                      // of cutoffs
  const double* cutoffs;               // species x species, symmetric; pairs of cutoff 0 are never listed
  int periodic[3];                     // axes, 1; boxes have no meaning along others
  double origin[3];                    // the box's corner, 0
  int half;                            // of (i, j) and (j, i) the one with j > i only, 0
  int sorted;                          // by i, j and shift, 1; if 0, faster, in an order that depends on the instruction set
  int shifts, separations, distances;  // are wanted, 1
  int segments;                        // are wanted, of sorted pairs, 0
  int threads;                         // 1; no effect on any result
  const char* instruction_set;         // auto, or a word of lanescape_instruction_set()
} lanescape_neighbour_options;

// Arrays of the object, valid until its next call; what is not wanted is NULL. A particle's own images are among the pairs.
typedef struct lanescape_neighbour_pairs {
  size_t size;
  size_t count;
  const int64_t *first, *second;  // i and j
  const int32_t* shift;           // 3 of each pair, whole boxes, for the positions as they were given
  const double* separation;       // 3 of each pair, r_j - r_i + shift . box
  const double* distance;
  const int64_t* segments;  // the first pair of each i, and count
} lanescape_neighbour_pairs;

lanescape_status lanescape_neighbour_options_init(lanescape_neighbour_options* options, size_t size);
lanescape_status lanescape_neighbours_create(const lanescape_neighbour_options* options, lanescape_neighbours** neighbours);
// Pairs that are never listed, such as bonded ones, in place of those before: 2 particles of each.
lanescape_status lanescape_neighbours_exclude(lanescape_neighbours* neighbours, size_t pairs, const int64_t* particles);
// species: of each particle, where there are several cutoffs, or NULL.
lanescape_status lanescape_neighbours_find(lanescape_neighbours* neighbours, size_t particles, const double* positions,
                                           const double box[3], const int* species, lanescape_neighbour_pairs* pairs);
// Prepares the neighbours of other points among these particles, which the next function gives: all of them, i numbers the points.
lanescape_status lanescape_neighbours_set_particles(lanescape_neighbours* neighbours, size_t particles, const double* positions,
                                                    const double box[3], const int* species);
lanescape_status lanescape_neighbours_of_points(lanescape_neighbours* neighbours, size_t points, const double* positions,
                                                const int* species, lanescape_neighbour_pairs* pairs);
lanescape_status lanescape_neighbours_destroy(lanescape_neighbours* neighbours);

// Overlaps of hard spheres. Touching is not overlapping.
typedef struct lanescape_hard_sphere_options {
  size_t size;
  const char* instruction_set;  // auto, or a word of lanescape_instruction_set()
  // 0; above 0, lanescape_hard_spheres_any_overlap() keeps a list of pairs with gaps below `skin` smallest diameters, for
  // configurations that follow each other in small steps.
  double skin;
} lanescape_hard_sphere_options;

// Arrays of the object, valid until its next call: all overlapping pairs, first < second, in rising order.
typedef struct lanescape_overlaps {
  size_t size;
  size_t count;
  const int64_t *first, *second;
  const double* gap;  // distance minus the sum of radii, below 0
} lanescape_overlaps;

lanescape_status lanescape_hard_sphere_options_init(lanescape_hard_sphere_options* options, size_t size);
// Edges of the box are at least two of the largest diameters. options may be NULL.
lanescape_status lanescape_hard_spheres_create(size_t particles, const double* radii, const double box[3],
                                               const lanescape_hard_sphere_options* options, lanescape_hard_spheres** spheres);
lanescape_status lanescape_hard_spheres_any_overlap(lanescape_hard_spheres* spheres, const double* positions, int* any);
lanescape_status lanescape_hard_spheres_overlaps(lanescape_hard_spheres* spheres, const double* positions,
                                                 lanescape_overlaps* overlaps);
// The smallest distance minus sum of radii; infinity for a single sphere.
lanescape_status lanescape_hard_spheres_smallest_gap(lanescape_hard_spheres* spheres, const double* positions, double* gap);
lanescape_status lanescape_hard_spheres_destroy(lanescape_hard_spheres* spheres);

// Insertion: one more particle in a fluid that stands still (doi 10.1063/1.1579475).
typedef struct lanescape_inserter_options {
  size_t size;
  int species;                  // of the particle, 0
  double diameter;              // of the particle, for models whose particles have diameters, 1
  const double* diameters;      // of the fluid's particles, likewise
  const char* instruction_set;  // auto, or a word of lanescape_instruction_set()
} lanescape_inserter_options;

typedef struct lanescape_insertion_settings {
  size_t size;
  double energy;         // U0, the target, 0
  double tolerance;      // of the error below, 0.01
  const char* measure;   // relative: |U - U0| / |U0|, |U - U0| where |U0| < 1e-6; absolute, running-mean
  const char* method;    // usher, usher-indirect, usher-near, screened, descent
  double largest_step;   // 0: the published optimum for the density
  uint64_t most_trials;  // of each insertion, 10,000
  const double* region;  // where to search: 3 of the low and 3 of the high corner; NULL: the whole box
  uint64_t seed;         // 1
  int threads;           // 1; no effect on any result
} lanescape_insertion_settings;

// Where a search for `count` positions writes; what is NULL is not written.
typedef struct lanescape_insertions {
  size_t size;
  int* found;             // count
  double* positions;      // 3 count, in the box
  double* energies;       // count, by which the fluid's rises
  double* errors;         // count, U - U0, or (U - U0) / |U0| where the measure is relative
  uint64_t* evaluations;  // count
  uint64_t* trials;       // count
} lanescape_insertions;

lanescape_status lanescape_inserter_options_init(lanescape_inserter_options* options, size_t size);
lanescape_status lanescape_insertion_settings_init(lanescape_insertion_settings* settings, size_t size);
// For models with a pair potential. options may be NULL.
lanescape_status lanescape_inserter_create(const lanescape_model* model, size_t particles, const int* species,
                                           const double* positions, const double box[3], const lanescape_inserter_options* options,
                                           lanescape_inserter** inserter);
lanescape_status lanescape_inserter_particles(const lanescape_inserter* inserter, size_t* particles);
// What the fluid's energy would rise by with a particle there, and the force on it unless that is NULL.
lanescape_status lanescape_inserter_energy(const lanescape_inserter* inserter, const double position[3], double* energy,
                                           double* force);
lanescape_status lanescape_inserter_energies(const lanescape_inserter* inserter, size_t count, const double* positions,
                                             double* energies);
// `count` independent searches in the fluid as it is.
lanescape_status lanescape_inserter_find(lanescape_inserter* inserter, const lanescape_insertion_settings* settings, size_t count,
                                         const lanescape_insertions* insertions);
// Inserts `count` particles one after the other; each becomes part of the fluid.
lanescape_status lanescape_inserter_insert(lanescape_inserter* inserter, const lanescape_insertion_settings* settings, size_t count,
                                           const lanescape_insertions* insertions);
// Puts a particle there, or takes one away; whether there was one, to the bit once wrapped, unless `removed` is NULL.
lanescape_status lanescape_inserter_add(lanescape_inserter* inserter, const double position[3]);
lanescape_status lanescape_inserter_remove(lanescape_inserter* inserter, const double position[3], int* removed);
lanescape_status lanescape_inserter_destroy(lanescape_inserter* inserter);

// A potential-energy landscape V(R) of the caller's own, for paths and dynamics.
typedef struct lanescape_landscape {
  size_t size;
  void* user;  // passed to evaluate
  size_t particles;
  // Writes V of unwrapped positions and, unless it is NULL, dV/dR, 3N numbers. Returns 0, or a code that ends the search or run
  // with LANESCAPE_CALLBACK_FAILED. Called from the caller's thread. A gradient that is not finite is LANESCAPE_BAD_INPUT, an
  // energy that is not a number above every limit.
  int (*evaluate)(void* user, const double* positions, double* gradient, double* energy);
} lanescape_landscape;

// Paths that never leave the allowed region: V(R) <= E_L, or no overlaps.
typedef struct lanescape_path_settings {
  size_t size;
  const char* method;      // contour or escape (soft), avoidance or away (hard spheres); NULL: the first of the family
  double step;             // not adaptive: length of a direct step in 3N space; 0: the method's own, in the model's unit of length
  double avoidance_step;   // of each sphere that an avoidance step moves; 0: 1e-4 of that unit
  const char* fictitious;  // force between overlapping spheres in an avoidance step: harmonic, linear, cubic
  const double* landscape_energy;  // E_L; NULL: the higher of the two ends
  int reverse;                     // search from the far end too and keep the shorter path, 0
  uint64_t max_steps;              // 1,000,000,000
  uint64_t patience;               // steps without progress after which a path is stalled, times a factor of the method, 1000
  size_t frames;                   // configurations kept between the two ends, 100
  int threads;                     // 1; no effect on any result
  const char* precision;           // double or mixed
  const char* instruction_set;     // auto, or a word of lanescape_instruction_set()
  lanescape_progress progress;     // or NULL
  void* progress_user;
  // contour: steps as long as an estimate of their error allows, the limit of short steps in fewer evaluations; avoidance: slides
  // along contacts in long steps, shorter paths; 0
  int adaptive;
} lanescape_path_settings;

typedef struct lanescape_path_summary {
  size_t size;
  const char* outcome;         // reached, step_limit, stalled, interrupted; valid while the path is
  const char* reason;          // why it ended where it did not reach its goal; likewise
  double length;               // in 3N space, of mass-weighted coordinates where masses differ
  double distance;             // of its ends, likewise
  double ratio_squared;        // (distance / length)^2, 0 for a path that did not move
  double participation_ratio;  // share of the particles that move at a time
  uint64_t direct_steps, detour_steps, evaluations;
  double landscape_energy;   // E_L of soft models
  double largest_violation;  // largest V - E_L of an accepted point, or deepest overlap; at least 0
  double seconds;
  size_t particles, frames;  // frames: ends included
  int reached, reversed;     // reversed: frames run from the finish to the start
} lanescape_path_summary;

lanescape_status lanescape_path_settings_init(lanescape_path_settings* settings, size_t size);
// Between two configurations of a model, unwrapped. diameters: of each particle, for models that have them, or NULL. A path that
// does not reach its goal is a result too, with status LANESCAPE_OK.
lanescape_status lanescape_find_path(const lanescape_model* model, size_t particles, const int* species, const double box[3],
                                     const double* start, const double* finish, const double* diameters,
                                     const lanescape_path_settings* settings, lanescape_path** path);
// On a landscape of the caller's own. masses: of each particle, or NULL for equal ones.
lanescape_status lanescape_find_path_on(const lanescape_landscape* landscape, const double* start, const double* finish,
                                        const double* masses, const lanescape_path_settings* settings, lanescape_path** path);
lanescape_status lanescape_path_summarise(const lanescape_path* path, lanescape_path_summary* summary);
// Copies the 3N numbers of one frame.
lanescape_status lanescape_path_frame(const lanescape_path* path, size_t frame, double* positions);
lanescape_status lanescape_path_destroy(lanescape_path* path);

#ifdef __cplusplus
}
#endif
#ifdef __GNUC__
#pragma GCC visibility pop
#endif

#include <lanescape/dynamics.h>
#include <lanescape/listed_potential.h>
#include <lanescape/shortening.h>
#include <lanescape/states.h>
