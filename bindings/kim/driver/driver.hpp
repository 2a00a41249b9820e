#pragma once

#include <lanescape/lanescape.hpp>

#include "particles.hpp"

namespace KIM {
class ModelCompute;
class ModelComputeArguments;
class ModelComputeArgumentsCreate;
class ModelComputeArgumentsDestroy;
}  // namespace KIM

namespace lanescape_kim {

// What a KIM model keeps: its potential's model and what the KIM API asks of it.
struct PairDriver {
  lanescape::Model model;
  Units units;
  double influence_distance;  // in the simulator's unit
  // Of the simulator's lists, of which the KIM API needs one and the driver none: short ones cost little. Very short ones cost
  // simulators more, by the number of their cells.
  double list_cutoff;
  int contributing_only = 1;  // no lists of other particles are asked for
};

// Routines of the KIM API: 0, or 1 after one line in the simulator's log.
int create_arguments(const KIM::ModelCompute* model, KIM::ModelComputeArgumentsCreate* arguments);
int compute(const KIM::ModelCompute* model, const KIM::ModelComputeArguments* arguments);
int destroy_arguments(const KIM::ModelCompute* model, KIM::ModelComputeArgumentsDestroy* arguments);

}  // namespace lanescape_kim
