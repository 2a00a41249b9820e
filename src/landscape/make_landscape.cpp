#include "landscape/make_landscape.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/overloaded.hpp"
#include "landscape/pair_landscape.hpp"

namespace lanescape {

std::unique_ptr<StateMixtureLandscape> make_state_landscape(const StateMixtureModel& model, const Box& box,
                                                            const ParticleLayout& layout, Isa isa,
                                                            const PairSearchOptions& options) {
  if (options.precision == Precision::mixed)
    throw_bad_input(fmt::format("mixed precision is not allowed with model {}: Lennard-Jones mixtures have it", model.name));
  check_cutoff(model, box);
  StateMixture::Options state_options;
  state_options.threads = options.threads;
  state_options.skin = options.skin;
  if (options.search == PairSearch::all_pairs) state_options.search = PairSearch::all_pairs;
  return std::make_unique<StateMixtureLandscape>(model, box, layout, isa, state_options);
}

std::unique_ptr<SoftLandscape> make_landscape(const AnyModel& model, const Box& box, const ParticleLayout& layout, Isa isa,
                                              const PairSearchOptions& options) {
  using Result = std::unique_ptr<SoftLandscape>;
  return std::visit(
      Overloaded{
          [&](const PairModel& pairs) -> Result { return std::make_unique<PairLandscape>(pairs, box, layout, isa, options); },
          [&](const StateMixtureModel& states) -> Result { return make_state_landscape(states, box, layout, isa, options); },
          [](const HardSphereModel& spheres) -> Result {
            throw_bad_input(fmt::format("model {} has no soft landscape: its spheres are hard", spheres.name));
          }},
      model);
}

}  // namespace lanescape
