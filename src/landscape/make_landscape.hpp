#pragma once

#include <memory>

#include "configuration/model.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "landscape/soft_landscape.hpp"
#include "landscape/state_mixture_landscape.hpp"

namespace lanescape {

// Makes the landscape of any soft model. Throws Error(bad_input) for hard spheres, and for mixed precision with a model that does
// not support it.
std::unique_ptr<SoftLandscape> make_landscape(const AnyModel& model, const Box& box, const ParticleLayout& layout, Isa isa,
                                              const PairSearchOptions& options = {});

// The same for sites in states.
std::unique_ptr<StateMixtureLandscape> make_state_landscape(const StateMixtureModel& model, const Box& box,
                                                            const ParticleLayout& layout, Isa isa,
                                                            const PairSearchOptions& options = {});

}  // namespace lanescape
