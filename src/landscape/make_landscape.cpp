#include "landscape/make_landscape.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "landscape/pair_landscape.hpp"
#include "landscape/state_mixture_landscape.hpp"

namespace lanescape {

std::unique_ptr<SoftLandscape> make_landscape(const Model& model, const Box& box, const ParticleLayout& layout, Isa isa,
                                              const PairSearchOptions& options) {
  if (const auto* lennard_jones = std::get_if<PairModel>(&model))
    return std::make_unique<PairLandscape>(*lennard_jones, box, layout, isa, options);
  const auto* states = std::get_if<StateMixtureModel>(&model);
  if (states == nullptr)
    throw_bad_input(fmt::format("model {} has no soft landscape: its spheres are hard", mixture_of(model).name));
  if (options.precision == Precision::mixed)
    throw_bad_input(fmt::format("mixed precision is not allowed with model {}: Lennard-Jones mixtures have it", states->name));
  check_cutoff(*states, box);
  StateMixture::Options with;
  with.threads = options.threads;
  with.skin = options.skin;
  if (options.search == PairSearch::all_pairs) with.search = PairSearch::all_pairs;
  return std::make_unique<StateMixtureLandscape>(*states, box, layout, isa, with);
}

}  // namespace lanescape
