#pragma once

#include <cstddef>
#include <cstdint>

#include "views/grid.hpp"
#include "views/pair.hpp"

// A particle that is not in the fluid.
namespace lanescape::kernels {

// Points of one species around a probe, sorted by the cells of a grid, coordinates in columns. Columns of cells have room between
// them, so that points can be put in; no column's points are read as another's.
struct ProbeSpecies : GridShape {
  const std::uint32_t* first;  // cells[2] + 1 per column: of each cell's points, and the column's end
  const double *x, *y, *z;     // slot_padding more than there are can be read
  const double* diameters;     // likewise, where the form has diameters, else null [sigma]
  PairParameters pair;         // of the probe with this species [sigma]; `images` is not looked at: images are points
  double reach;                // no point further away is in range [sigma]
};

// The fluid around a particle that is not in it.
struct ProbeInput {
  const ProbeSpecies* species;
  std::size_t species_count;
  double diameter;  // of the probe, where the form has diameters [sigma]
};

struct ProbeOutput {
  double energy;       // the sum over all points, never half of it [epsilon]
  double gradient[3];  // [epsilon/sigma]
};

}  // namespace lanescape::kernels
