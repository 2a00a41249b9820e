#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "core/random.hpp"
#include "dispatch/isa.hpp"
#include "insertion/insertion.hpp"

namespace lanescape {

enum class RemovalRule {
  random,             // any particle
  least_disturbance,  // the one whose energy is nearest to a given one
};
const char* to_string(RemovalRule rule);
RemovalRule parse_removal_rule(std::string_view word);  // throws Error(bad_input)

struct Removal {
  std::size_t particle = 0;  // its place in the configuration
  double energy = 0.0;       // what the fluid's falls by [epsilon]
};

// Which particle of a species to take out of a region, or the box; nothing where there is none. `number` tells draws apart. O(N);
// by least disturbance among particles with diameters O(N^2).
std::optional<Removal> choose_removal(const PairModel& model, const Configuration& fluid, int species, RemovalRule rule,
                                      const std::optional<Region>& region, double energy, const CounterRandom& random,
                                      std::uint64_t number, Isa isa);

}  // namespace lanescape
