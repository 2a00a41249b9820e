/* A host's kernel for every case: plain loops over all pairs and images, written from docs/HOST_KERNELS.md. REAL is its arithmetic.
 */
#include "right_kernel.h"

#include <string.h>
#include <tgmath.h>

#ifndef REAL
#define REAL double
#endif

struct value {
  REAL u, slope, curvature;
};

/* The potential of one pair: sum of factor (sigma/r)^exponent, or the form of `kind`; and what the truncation adds. */
struct potential {
  enum { powers, yukawa, overlap } kind;
  REAL epsilon, sigma, cutoff;
  REAL factor[4], exponent[4]; /* of overlap the first ones: factor (1 - r/sigma)^exponent */
  REAL kappa;
  REAL c0, c1, c2, c4;
};

static struct value untruncated(const struct potential* p, REAL r) {
  struct value v = {0, 0, 0};
  if (p->kind == yukawa) {
    v.u = p->epsilon * p->sigma / r * exp(-p->kappa * (r - p->sigma));
    v.slope = -v.u * (1 / r + p->kappa);
    v.curvature = v.u * (2 / (r * r) + 2 * p->kappa / r + p->kappa * p->kappa);
  } else if (p->kind == overlap) {
    const REAL depth = 1 - r / p->sigma, f = p->factor[0], n = p->exponent[0];
    v.u = f * pow(depth, n);
    v.slope = -n * f / p->sigma * pow(depth, n - 1);
    v.curvature = n * (n - 1) * f / (p->sigma * p->sigma) * pow(depth, n - 2);
  } else {
    for (int k = 0; k < 4; ++k) {
      const REAL n = p->exponent[k], u = p->factor[k] * pow(p->sigma / r, n);
      v.u += u;
      v.slope -= n * u / r;
      v.curvature += n * (n + 1) * u / (r * r);
    }
  }
  return v;
}

static void set_powers(struct potential* p, REAL f0, REAL n0, REAL f1, REAL n1, REAL f2, REAL n2, REAL f3) {
  const REAL factor[4] = {f0, f1, f2, f3}, exponent[4] = {n0, n1, n2, 0};
  p->kind = powers;
  memcpy(p->factor, factor, sizeof factor);
  memcpy(p->exponent, exponent, sizeof exponent);
}

/* 0 for a form that is not known here. */
static int set_form(struct potential* p, const char* form, const double* numbers) {
  const REAL e = p->epsilon;
  if (strcmp(form, "lennard-jones") == 0) {
    set_powers(p, 4 * e, 12, -4 * e, 6, 0, 0, 0);
  } else if (strcmp(form, "mie") == 0) {
    const REAL n = numbers[0], m = numbers[1], c = n / (n - m) * pow(n / m, m / (n - m)) * e;
    set_powers(p, c, n, -c, m, 0, 0, 0);
  } else if (strcmp(form, "inverse-power") == 0) {
    set_powers(p, e, numbers[0], 0, 0, 0, 0, 0);
  } else if (strcmp(form, "lennard-jones-12-6-4") == 0) {
    set_powers(p, 4 * e, 12, -4 * e, 6, -4 * e * numbers[0], 4, 0);
  } else if (strcmp(form, "polydisperse") == 0) {
    p->cutoff = p->cutoff * p->sigma;
    set_powers(p, e, 12, 48 * e / pow(1.25, 14), -2, -21 * e / pow(1.25, 16), -4, -28 * e / pow(1.25, 12));
  } else if (strcmp(form, "yukawa") == 0) {
    p->kind = yukawa;
    p->kappa = numbers[0];
  } else if (strcmp(form, "harmonic") == 0 || strcmp(form, "hertzian") == 0) {
    const int is_harmonic = strcmp(form, "harmonic") == 0;
    p->kind = overlap;
    p->factor[0] = is_harmonic ? e / 2 : 2 * e / 5;
    p->exponent[0] = is_harmonic ? 2 : 2.5;
  } else {
    return 0;
  }
  return 1;
}

static void set_truncation(struct potential* p, int truncation, REAL shift_factor) {
  const REAL rc = p->cutoff;
  const struct value v = untruncated(p, rc);
  p->c0 = p->c1 = p->c2 = p->c4 = 0;
  if (truncation == LANESCAPE_KERNEL_SHIFTED) p->c0 = -v.u * shift_factor;
  if (truncation == LANESCAPE_KERNEL_SHIFTED_FORCE) {
    p->c0 = -v.u + rc * v.slope;
    p->c1 = -v.slope;
  }
  if (truncation == LANESCAPE_KERNEL_SMOOTH) {
    p->c4 = (rc * v.slope - rc * rc * v.curvature) / (8 * rc * rc * rc * rc);
    p->c2 = -2 * p->c4 * rc * rc - v.slope / (2 * rc);
    p->c0 = -v.u - p->c2 * rc * rc - p->c4 * rc * rc * rc * rc;
  }
}

static struct potential potential_of(const lanescape_kernel_input* in, size_t i, size_t j, REAL shift_factor) {
  const size_t ab = (size_t)in->species[i] * in->species_count + (size_t)in->species[j];
  struct potential p = {.epsilon = in->epsilon[ab], .sigma = in->sigma[ab], .cutoff = in->cutoff[ab]};
  if (in->diameters) {
    const REAL a = in->diameters[i], b = in->diameters[j];
    p.sigma = (a + b) / 2 * (1 - (REAL)in->numbers[0] * fabs(a - b));
  }
  set_form(&p, in->form, in->numbers);
  set_truncation(&p, in->truncation, shift_factor);
  return p;
}

struct sums {
  REAL energy, virial;
};

/* d = r_i - r_j of one image. */
static void add_image(const struct potential* p, const REAL d[3], size_t i, size_t j, double* forces, struct sums* sums) {
  const REAL r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  if (r >= p->cutoff) return;
  struct value v = untruncated(p, r);
  const REAL r2 = r * r, weight = i == j ? 0.5 : 1;
  v.u += p->c0 + p->c1 * r + p->c2 * r2 + p->c4 * r2 * r2;
  v.slope += p->c1 + 2 * p->c2 * r + 4 * p->c4 * r2 * r;
  sums->energy += weight * v.u;
  sums->virial -= weight * r * v.slope;
  if (i == j) return;
  for (int axis = 0; axis < 3; ++axis) {
    forces[3 * i + axis] -= v.slope / r * d[axis];
    forces[3 * j + axis] += v.slope / r * d[axis];
  }
}

static void add_pair(const lanescape_kernel_input* in, int own_images, size_t i, size_t j, const struct potential* p,
                     double* forces, struct sums* sums) {
  REAL nearest[3], edge[3];
  int most[3];
  for (int axis = 0; axis < 3; ++axis) {
    edge[axis] = in->box[axis];
    nearest[axis] = (REAL)in->positions[3 * i + axis] - (REAL)in->positions[3 * j + axis];
    nearest[axis] -= edge[axis] * nearbyint(nearest[axis] / edge[axis]);
    most[axis] = in->images == LANESCAPE_KERNEL_MINIMUM_IMAGE ? 0 : (int)ceil(p->cutoff / edge[axis] + 0.5);
  }
  for (int x = -most[0]; x <= most[0]; ++x)
    for (int y = -most[1]; y <= most[1]; ++y)
      for (int z = -most[2]; z <= most[2]; ++z) {
        const REAL d[3] = {nearest[0] + x * edge[0], nearest[1] + y * edge[1], nearest[2] + z * edge[2]};
        if (i == j && (!own_images || (x == 0 && y == 0 && z == 0))) continue;
        add_image(p, d, i, j, forces, sums);
      }
}

/* The integrals from the cutoff to infinity of r^2 u and of -r^3 u' = r_c^3 u(r_c) + 3 times the first. */
static void add_tail(const lanescape_kernel_input* in, const struct potential* p, struct sums* sums) {
  const REAL rc = p->cutoff, volume = in->box[0] * in->box[1] * in->box[2], weight = 2 * 3.14159265358979323846 / volume;
  REAL tail = 0;
  if (p->kind == yukawa)
    tail = p->epsilon * p->sigma * exp(-p->kappa * (rc - p->sigma)) * (rc / p->kappa + 1 / (p->kappa * p->kappa));
  for (int k = 0; p->kind == powers && k < 4; ++k)
    if (p->factor[k] != 0) tail += p->factor[k] * pow(p->sigma / rc, p->exponent[k]) * rc * rc * rc / (p->exponent[k] - 3);
  sums->energy += weight * tail;
  sums->virial += weight * (rc * rc * rc * untruncated(p, rc).u + 3 * tail);
}

int evaluate_pairs(const lanescape_kernel_input* in, lanescape_kernel_output* out, int own_images, double shift_factor) {
  struct sums sums = {0, 0}, tails = {0, 0};
  struct potential probe = {.epsilon = 1, .sigma = 1, .cutoff = 1};
  if (in->size < sizeof *in || out->size < sizeof *out) return -1;
  if (!set_form(&probe, in->form, in->numbers)) return LANESCAPE_KERNEL_DECLINED;
  memset(out->forces, 0, 3 * in->particles * sizeof *out->forces);
  for (size_t i = 0; i < in->particles; ++i)
    for (size_t j = 0; j < in->particles; ++j) {
      const struct potential p = potential_of(in, i, j, shift_factor);
      if (j >= i) add_pair(in, own_images, i, j, &p, out->forces, &sums);
      if (in->truncation == LANESCAPE_KERNEL_TAIL) add_tail(in, &p, &tails);
    }
  out->energy = sums.energy + tails.energy;
  out->virial = sums.virial + tails.virial;
  return LANESCAPE_KERNEL_DONE;
}

int right_kernel(const lanescape_kernel_input* in, lanescape_kernel_output* out) { return evaluate_pairs(in, out, 1, 1.0); }
