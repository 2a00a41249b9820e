#pragma once

#include <cstddef>
#include <cstdint>

#include "views/grid.hpp"
#include "views/pair.hpp"

// A particle outside the fluid.
namespace lanescape::kernels {

// Points of one species around a probe, sorted by the cells of a grid, one array per coordinate. There is free space between
// columns of cells so that points can be inserted; points of one column are never read as those of another.
struct ProbeSpecies : GridShape {
  const std::uint32_t* first;  // cells[2] + 1 per column: start of each cell's points, and the column's end
  const double *x, *y, *z;     // slot_padding entries past the end are readable
  const double* diameters;     // also padded; where the form has diameters, else null [sigma]
  PairParameters pair;         // of the probe with this species [sigma]; `images` is ignored: images are points of their own
  double reach;                // points further away are out of range [sigma]
};

// The fluid around a probe particle.
struct ProbeInput {
  const ProbeSpecies* species;
  std::size_t species_count;
  double diameter;  // of the probe, where the form has diameters [sigma]
};

struct ProbeOutput {
  double energy;       // the sum over all points, in full, not halved [epsilon]
  double gradient[3];  // [epsilon/sigma]
};

}  // namespace lanescape::kernels
