#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "core/random.hpp"
#include "dispatch/isa.hpp"
#include "insertion/insertion.hpp"
#include "interaction/pair/probe_field.hpp"

namespace lanescape {

enum class RemovalRule {
  random,             // any particle
  least_disturbance,  // the particle with the energy nearest to a given one
};
const char* to_string(RemovalRule rule);
RemovalRule parse_removal_rule(std::string_view word);  // throws Error(bad_input)

struct Removal {
  std::size_t particle = 0;  // index in the configuration
  double energy = 0.0;       // decrease of the fluid's energy [epsilon]
};

// Chooses a particle of a species to remove from a region, or from the box; returns nothing if there is none. Different values of
// `number` give independent random choices. Cost O(N), or O(N^2) for the least disturbance with diameters per particle.
std::optional<Removal> choose_removal(const PairModel& model, const Configuration& fluid, int species, RemovalRule rule,
                                      const std::optional<Region>& region, double energy, const CounterRandom& random,
                                      std::uint64_t number, Isa isa);
// Chooses one of some particles, at least one, all of the field's species and in the field; it is still there afterwards.
Removal choose_removal(ProbeField& field, const Configuration& fluid, std::span<const std::size_t> candidates, RemovalRule rule,
                       double energy, const CounterRandom& random, std::uint64_t number);

}  // namespace lanescape
