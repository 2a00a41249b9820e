/* What lanescape verify calls: it declines what the kernel does not do, and passes the rest on. */
#include <lanescape/host_kernel.h>
#include <string.h>

#include "kernel.h"

int my_kernel_for_verification(const lanescape_kernel_input* input, lanescape_kernel_output* output) {
  if (strcmp(input->form, "lennard-jones") != 0 || input->species_count != 1) return LANESCAPE_KERNEL_DECLINED;
  if (input->truncation != LANESCAPE_KERNEL_SHIFTED || input->images != LANESCAPE_KERNEL_ALL_IMAGES)
    return LANESCAPE_KERNEL_DECLINED;
  output->energy =
      my_lennard_jones(input->particles, input->positions, input->box, input->cutoff[0], output->forces, &output->virial);
  return LANESCAPE_KERNEL_DONE;
}
