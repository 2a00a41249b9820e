#pragma once

#include <memory>

#include "configuration/model.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/pair_interaction.hpp"
#include "landscape/soft_landscape.hpp"

namespace lanescape {

// The landscape of a soft model, whichever it is. Throws Error(bad_input) for hard spheres, and for mixed precision where a model
// has none.
std::unique_ptr<SoftLandscape> make_landscape(const Model& model, const Box& box, const ParticleLayout& layout, Isa isa,
                                              const PairSearchOptions& options = {});

}  // namespace lanescape
