#pragma once

#include <lanescape/host_kernel.h>

/* All pairs and images, without a particle's own images or with them; the shift of the truncation `shifted` times a factor. */
int evaluate_pairs(const lanescape_kernel_input* in, lanescape_kernel_output* out, int own_images, double shift_factor);
int right_kernel(const lanescape_kernel_input* in, lanescape_kernel_output* out);
