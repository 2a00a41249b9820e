#pragma once

#include <stddef.h>

/* Energy and forces of a one-component Lennard-Jones fluid (epsilon = sigma = 1) whose potential is cut and shifted at `cutoff`;
   all periodic images count. Positions and forces are x0 y0 z0 x1 ..., the virial is the sum of r.F over pairs. */
double my_lennard_jones(size_t particles, const double* positions, const double box[3], double cutoff, double* forces,
                        double* virial);
