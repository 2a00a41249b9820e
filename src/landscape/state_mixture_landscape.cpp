#include "landscape/state_mixture_landscape.hpp"

namespace lanescape {

StateMixtureLandscape::StateMixtureLandscape(StateMixtureParts parts, const Box& box, const ParticleLayout& layout, Isa isa,
                                             const StateMixture::Options& options)
    : dimension_(layout.dimension()),
      particles_(layout.size()),
      algebra_(kernel_table(isa), options.threads),
      interaction_(std::move(parts), box, layout, kernel_table(isa), options) {}

}  // namespace lanescape
