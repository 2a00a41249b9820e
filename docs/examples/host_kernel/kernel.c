/* The project's own kernel: the code that its users run. */
#include "kernel.h"

#include <math.h>

struct sums {
  double energy, virial;
};

/* One image of a pair at the separation d. The force on i goes to f_i, its opposite to f_j; a particle and its own image feel none.
 */
static void add_pair(const double d[3], double weight, double cutoff, double shift, double* f_i, double* f_j, struct sums* sums) {
  const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  if (r2 >= cutoff * cutoff) return;
  const double rinv6 = 1.0 / (r2 * r2 * r2);
  const double force_over_r = 24.0 * rinv6 * (2.0 * rinv6 - 1.0) / r2;
  sums->energy += weight * (4.0 * rinv6 * (rinv6 - 1.0) - shift);
  sums->virial += weight * force_over_r * r2;
  for (int axis = 0; axis < 3; ++axis) {
    f_i[axis] += force_over_r * d[axis];
    f_j[axis] -= force_over_r * d[axis];
  }
}

/* All images of the pair i, j: the nearest, and as many boxes around it as the cutoff reaches. */
static void add_images(const double* r_i, const double* r_j, int own, const double box[3], double cutoff, double shift, double* f_i,
                       double* f_j, struct sums* sums) {
  double nearest[3];
  int most[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double d = r_i[axis] - r_j[axis];
    nearest[axis] = d - box[axis] * nearbyint(d / box[axis]);
    most[axis] = (int)ceil(cutoff / box[axis] + 0.5);
  }
  for (int x = -most[0]; x <= most[0]; ++x)
    for (int y = -most[1]; y <= most[1]; ++y)
      for (int z = -most[2]; z <= most[2]; ++z) {
        const double d[3] = {nearest[0] + x * box[0], nearest[1] + y * box[1], nearest[2] + z * box[2]};
        if (own && x == 0 && y == 0 && z == 0) continue;
        add_pair(d, own ? 0.5 : 1.0, cutoff, shift, f_i, f_j, sums);
      }
}

double my_lennard_jones(size_t particles, const double* positions, const double box[3], double cutoff, double* forces,
                        double* virial) {
  const double s6 = pow(cutoff, -6), shift = 4.0 * s6 * (s6 - 1.0);
  struct sums sums = {0.0, 0.0};
  for (size_t k = 0; k < 3 * particles; ++k) forces[k] = 0.0;
  for (size_t i = 0; i < particles; ++i)
    for (size_t j = i; j < particles; ++j)
      add_images(positions + 3 * i, positions + 3 * j, i == j, box, cutoff, shift, forces + 3 * i, forces + 3 * j, &sums);
  *virial = sums.virial;
  return sums.energy;
}
