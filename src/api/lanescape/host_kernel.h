#pragma once

/* A kernel of a host's own, as `lanescape verify --library FILE --symbol NAME` calls it: one C function in a shared library. The
   header declares types only; nothing has to be linked. docs/HOST_KERNELS.md has the formulas and an example. */

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How u(r) ends at the cutoff r_c. */
enum lanescape_kernel_truncation {
  LANESCAPE_KERNEL_SHIFTED = 0,       /* u(r) - u(r_c) */
  LANESCAPE_KERNEL_PLAIN = 1,         /* u(r) */
  LANESCAPE_KERNEL_TAIL = 2,          /* u(r); energy and virial get the integrals over a uniform fluid beyond the cutoff */
  LANESCAPE_KERNEL_SHIFTED_FORCE = 3, /* u(r) - u(r_c) - (r - r_c) u'(r_c) */
  LANESCAPE_KERNEL_SMOOTH = 4         /* u(r) + c0 + c2 r^2 + c4 r^4: value, slope and curvature vanish at the cutoff */
};

/* Which periodic images of a pair interact, if they are nearer than the cutoff. */
enum lanescape_kernel_images {
  LANESCAPE_KERNEL_ALL_IMAGES = 0,   /* all; a particle and its own images too, each such pair with weight 1/2 */
  LANESCAPE_KERNEL_MINIMUM_IMAGE = 1 /* per axis the nearest; none of the particle itself */
};

/* What a kernel computes: bits of lanescape_kernel_output.computed. */
enum lanescape_kernel_quantity { LANESCAPE_KERNEL_ENERGY = 1, LANESCAPE_KERNEL_FORCES = 2, LANESCAPE_KERNEL_VIRIAL = 4 };

/* What a kernel returns. Any other value is a failure of this case. */
enum lanescape_kernel_status {
  LANESCAPE_KERNEL_DONE = 0,
  LANESCAPE_KERNEL_DECLINED = 1 /* "I do not do this case": it is counted, and not compared */
};

/* One case, in reduced units. Pointers are never null, except diameters. */
typedef struct lanescape_kernel_input {
  size_t size;             /* bytes of this struct in the calling program; later versions add members at the end */
  const char* name;        /* of the case, as reports show it */
  size_t particles;        /* N, 0 included */
  const double* positions; /* 3N: x0 y0 z0 x1 ...; particles may lie several boxes away */
  const int* species;      /* N, each from 0 to species_count - 1 */
  double box[3];           /* edges of an orthorhombic box, periodic along each axis; may be far below the cutoff */
  size_t species_count;    /* S */
  const char* form;        /* the pair potential: "lennard-jones", "yukawa", ... */
  size_t number_count;     /* of the numbers that the form has beside epsilon and sigma */
  const double* numbers;   /* in the order of docs/HOST_KERNELS.md */
  const double* epsilon;   /* S x S, row by row, symmetric, as are sigma and cutoff */
  const double* sigma;     /* S x S; 1 if particles have diameters */
  const double* cutoff;    /* S x S, a length; in units of sigma_ij if particles have diameters */
  int truncation;          /* enum lanescape_kernel_truncation */
  int images;              /* enum lanescape_kernel_images */
  const double* diameters; /* N, of the form "polydisperse"; null with the others */
} lanescape_kernel_input;

/* The results, which are NaN before the call. */
typedef struct lanescape_kernel_output {
  size_t size;       /* bytes of this struct in the calling program */
  unsigned computed; /* all bits of enum lanescape_kernel_quantity; the kernel clears those of what it does not compute */
  double energy;
  double* forces; /* 3N: F_x0 F_y0 F_z0 F_x1 ..., F = -dE/dr */
  double virial;  /* sum of r.F over pairs, each once: positive where pairs repel */
} lanescape_kernel_output;

/* The function behind the symbol. It is called in one process for one case after the other. */
typedef int lanescape_kernel(const lanescape_kernel_input* input, lanescape_kernel_output* output);

#ifdef __cplusplus
}
#endif
