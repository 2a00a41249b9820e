#include "insertion/removal.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "core/enum_words.hpp"

namespace lanescape {

namespace {

constexpr EnumWord<RemovalRule> rules[] = {{RemovalRule::random, "random"}, {RemovalRule::least_disturbance, "least-disturbance"}};

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
  ProbeField field(model, fluid, species, kernel_table(isa));
  const auto energy_of = [&](std::size_t i) {
    if (model.form->has_diameters) {
      ProbeField own(model, fluid, species, kernel_table(isa), fluid.diameters[i]);
      own.remove(fluid.position(i), species);
      return own.energy(fluid.position(i));
    }
    field.remove(fluid.position(i), species);
    const double decrease = field.energy(fluid.position(i));
    field.insert(fluid.position(i), species);
    return decrease;
  };
  if (rule == RemovalRule::random) {
    const std::size_t chosen = candidates[random.below(static_cast<std::uint32_t>(candidates.size()), number, 0, 6)];
    return Removal{chosen, energy_of(chosen)};
  }
  Removal best{candidates.front(), energy_of(candidates.front())};
  for (const std::size_t i : candidates) {
    const Removal other{i, energy_of(i)};
    if (std::abs(other.energy - energy) < std::abs(best.energy - energy)) best = other;
  }
  return best;
}

}  // namespace lanescape
