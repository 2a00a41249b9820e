#include "interaction/state/state_block.hpp"

namespace lanescape {

void add_rows(const Sites& sites, const kernels::NeighbourRows& rows, const double* records, AlignedArray& gradient) {
  const std::size_t slots = sites.layout().slots();
  for_each_row(sites.list(), rows, [&](std::size_t row, std::size_t slot) {
    for (std::size_t axis = 0; axis < 3; ++axis) gradient[axis * slots + slot] += records[kernels::point_width * row + axis];
  });
}

void add_blocks(const std::vector<kernels::PairOutput>& blocks, StateSums& sums) {
  double energy = 0.0, virial = 0.0;
  for (const kernels::PairOutput& block : blocks) {
    energy += block.energy;
    virial += block.virial;
    if (sums.wanted == StateSums::Wanted::stress)
      for (std::size_t k = 0; k < 6; ++k) sums.virial_tensor[k] += block.virial_tensor[k];
  }
  sums.energy += energy;
  sums.virial += virial;
}

}  // namespace lanescape
