#include "insertion/removal.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "core/enum_words.hpp"

namespace lanescape {

namespace {

constexpr EnumWord<RemovalRule> rules[] = {{RemovalRule::random, "random"}, {RemovalRule::least_disturbance, "least-disturbance"}};

// energy_of(particle): what the fluid's energy falls by without it.
template <class EnergyOf>
Removal choose(std::span<const std::size_t> candidates, RemovalRule rule, double energy, const CounterRandom& random,
               std::uint64_t number, const EnergyOf& energy_of) {
  if (rule == RemovalRule::random) {
    const std::size_t chosen = candidates[random.below(static_cast<std::uint32_t>(candidates.size()), number, 0, 6)];
    return {chosen, energy_of(chosen)};
  }
  Removal best{candidates.front(), energy_of(candidates.front())};
  for (const std::size_t i : candidates.subspan(1)) {
    const Removal other{i, energy_of(i)};
    if (std::abs(other.energy - energy) < std::abs(best.energy - energy)) best = other;
  }
  return best;
}

double energy_in(ProbeField& field, const Point& position) {
  field.remove(position, field.species());
  const double decrease = field.energy(position);
  field.insert(position, field.species());
  return decrease;
}

}  // namespace

const char* to_string(RemovalRule rule) { return word_of(rules, rule); }
RemovalRule parse_removal_rule(std::string_view word) { return parse_word(rules, "removal", word); }

std::optional<Removal> choose_removal(const PairModel& model, const Configuration& fluid, int species, RemovalRule rule,
                                      const std::optional<Region>& region, double energy, const CounterRandom& random,
                                      std::uint64_t number, Isa isa) {
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < fluid.size(); ++i) {
    if (fluid.species[i] == species && (!region || region->contains(region->image(fluid.box, fluid.position(i)))))
      candidates.push_back(i);
  }
  if (candidates.empty()) return std::nullopt;
  if (!model.form->has_diameters) {
    ProbeField field(model, fluid, species, kernel_table(isa));
    return choose_removal(field, fluid, candidates, rule, energy, random, number);
  }
  return choose(candidates, rule, energy, random, number, [&](std::size_t i) {
    ProbeField own(model, fluid, species, kernel_table(isa), fluid.diameters[i]);
    own.remove(fluid.position(i), species);
    return own.energy(fluid.position(i));
  });
}

Removal choose_removal(ProbeField& field, const Configuration& fluid, std::span<const std::size_t> candidates, RemovalRule rule,
                       double energy, const CounterRandom& random, std::uint64_t number) {
  return choose(candidates, rule, energy, random, number, [&](std::size_t i) { return energy_in(field, fluid.position(i)); });
}

}  // namespace lanescape
