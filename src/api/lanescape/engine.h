#pragma once

// An engine whose energies are a landscape for `lanescape path --landscape NAME:INPUT`: a module that the program loads. C11.
// NAME is the path of the module, or `lammps` for lanescape-lammps.so in a folder of LANESCAPE_ENGINES.
//
// A module may run on several processes, each of which is this program: one of them searches, the others serve it in
// lanescape_engine_open() until it closes the engine.

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lanescape_engine {
  size_t size;  // of this struct, as the program knows it
  void* user;   // the module's own, handed to its functions
  size_t particles;
  double box[3];         // edge lengths; periodic
  const int* types;      // of each particle
  const double* masses;  // of each particle, or NULL
  const char* units;     // of the engine's lengths and energies, a word
  // V and its gradient (3N) at positions x0 y0 z0 x1 ..., which may lie anywhere. 0, or another number after a failure.
  int (*evaluate)(void* user, const double* positions, double* energy, double* gradient);
  // Numbers on which the last bits of V depend besides the positions, such as where lists were made. An engine that has
  // restored them goes on with the same bits; without any it is as if it were new.
  size_t (*state_size)(void* user);
  void (*save)(void* user, double* state);
  int (*restore)(void* user, const double* state, size_t count);
  const char* (*message)(void* user);  // one line about the last failure
  void (*close)(void* user);
} lanescape_engine;

enum {
  LANESCAPE_ENGINE_OPEN = 0,
  LANESCAPE_ENGINE_FAILED = 1,  // one line is in `message`
  LANESCAPE_ENGINE_SERVED = 2   // this process has served another one, and is done
};

// What a module has under this name. Fills in `engine`, whose size is set; `message` has room for `capacity` bytes.
int lanescape_engine_open(const char* input, lanescape_engine* engine, char* message, size_t capacity);

#ifdef __cplusplus
}
#endif
