#pragma once

#include <vector>

#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "views/pair.hpp"

namespace lanescape {

// The largest diameter of particles that have one, by which cutoffs grow; 1 for a form without diameters. Throws Error(bad_input)
// where the form needs diameters and the layout has none.
double diameter_scale(const PairModel& model, const ParticleLayout& layout);

// Each species pair's potential as the kernels take it, species x species; lengths in a unit of so many sigma, the nearest image
// only.
std::vector<kernels::PairParameters> pair_parameters(const PairModel& model, double unit = 1.0);
void put_pair_parameters(const PairModel& model, double unit, std::vector<kernels::PairParameters>& pairs);

// The same for kernels in mixed precision, whose separations are in `fixed_unit` [sigma].
std::vector<kernels::SinglePairParameters> single_pair_parameters(const std::vector<kernels::PairParameters>& pairs,
                                                                  double fixed_unit);

// Throws Error(bad_input) where single precision does not resolve the pairs of a model: the largest reach is more than 32 times the
// smallest diameter, or an epsilon is out of range.
void check_single_precision(const PairModel& model);
void check_single_precision(const PairModel& model, const ParticleLayout& layout);  // particles may have diameters of their own

}  // namespace lanescape
