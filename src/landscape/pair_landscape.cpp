#include "landscape/pair_landscape.hpp"

namespace lanescape {

PairLandscape::PairLandscape(const PairModel& model, const Box& box, const ParticleLayout& layout, Isa isa,
                             const PairSearchOptions& options)
    : dimension_(layout.dimension()),
      particles_(layout.size()),
      algebra_(kernel_table(isa), options.threads),
      interaction_(model, box, layout, kernel_table(isa), options) {}

double PairLandscape::energy_and_gradient(const AlignedArray& position, AlignedArray& gradient) {
  return interaction_.energy_and_gradient(position, gradient).energy;
}

}  // namespace lanescape
