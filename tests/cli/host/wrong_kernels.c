/* Kernels with one fault each, which lanescape verify must find and name. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "right_kernel.h"

#define KERNEL(name) int name(const lanescape_kernel_input* in, lanescape_kernel_output* out)

KERNEL(without_own_images) { return evaluate_pairs(in, out, 0, 1.0); }

KERNEL(with_a_wrong_shift) { return evaluate_pairs(in, out, 1, 1.0 + 1e-6); }

KERNEL(declines_everything) {
  (void)in, (void)out;
  return LANESCAPE_KERNEL_DECLINED;
}

KERNEL(declines_all_but_one) {
  return strcmp(in->name, "lennard-jones N=9 all shifted") ? LANESCAPE_KERNEL_DECLINED : right_kernel(in, out);
}

KERNEL(crashes_in_one_case) {
  if (strcmp(in->name, "pair across a corner (box)") == 0) abort();
  return right_kernel(in, out);
}

KERNEL(ends_the_process) {
  if (strcmp(in->name, "slab kob-andersen all tail") == 0) exit(0);
  return right_kernel(in, out);
}

KERNEL(gives_nan) {
  const int status = right_kernel(in, out);
  if (in->particles > 5) out->forces[3 * 5 + 1] = NAN;
  return status;
}

KERNEL(forgets_the_virial) {
  const double before = out->virial;
  const int status = right_kernel(in, out);
  out->virial = before;
  return status;
}

KERNEL(has_no_virial) {
  out->computed &= ~(unsigned)LANESCAPE_KERNEL_VIRIAL;
  return forgets_the_virial(in, out);
}

KERNEL(computes_nothing) {
  out->computed = 0;
  return right_kernel(in, out);
}

KERNEL(writes_beyond_its_forces) {
  const int status = right_kernel(in, out);
  out->forces[3 * in->particles] = 0.0;
  return status;
}

KERNEL(returns_seven) {
  right_kernel(in, out);
  return 7;
}

KERNEL(never_returns) {
  if (in->particles == 0) return right_kernel(in, out);
  alarm(1); /* in place of the program's, which a test would wait for */
  for (;;) pause();
}

KERNEL(leaves_a_child) {
  if (fork() == 0) return LANESCAPE_KERNEL_DONE;
  return right_kernel(in, out);
}

KERNEL(chats) {
  printf("case %s\n", in->name);
  return right_kernel(in, out);
}
