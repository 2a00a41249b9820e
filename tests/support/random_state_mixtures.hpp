#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/state_mixture_model.hpp"
#include "interaction/pair/pair_search.hpp"
#include "random_draws.hpp"

namespace lanescape::testing {

// Sites in states, in any unit of length.
struct RandomStateMixture {
  StateMixtureModel model;
  Configuration configuration;
  PairSearch search;
  int threads;
  double unit;  // [sigma]
};

// One to five species of one to five states each, any filter, Lennard-Jones, tables or both.
class RandomStateMixtures : private RandomDraws {
 public:
  using RandomDraws::RandomDraws;

  RandomStateMixture make() {
    RandomStateMixture made{
        {}, {}, chance(0.3) ? PairSearch::all_pairs : PairSearch::list, chance(0.2) ? 2 : 1, std::pow(10.0, between(-12.0, 12.0))};
    made.model = model(made.unit);
    Configuration& c = made.configuration;
    std::vector<double> reaches;
    for (std::size_t k = 0; k < made.model.filter.size(); ++k)
      reaches.push_back(made.model.reach(k / made.model.species.size(), k % made.model.species.size()));
    c.box = box(reaches, made.unit);
    const std::size_t wanted = chance(0.15) ? 100 + below(100) : 1 + below(40);
    fill(c, wanted, made.model.species.size(), 0.75 * made.unit, made.unit, reaches);
    return made;
  }

 private:
  StateMixtureModel model(double unit) {
    StateMixtureModel model;
    model.name = "random";
    model.cutoff = unit * between(1.2, 2.8);
    model.entropy_temperature = chance(0.5) ? between(0.1, 2.0) : 0.0;
    const std::size_t species = 1 + below(5);
    for (std::size_t s = 0; s < species; ++s) {
      model.species.push_back({std::string(1, static_cast<char>('A' + s)), 1.0, 1.0 / static_cast<double>(species)});
      model.states.push_back(states(unit));
    }
    model.filter = filter(species);
    const double tables = chance(0.4) ? 0.0 : chance(0.5) ? 1.0 : 0.5;
    model.potentials.resize(species * species * model.most_states() * model.most_states());
    for (std::size_t s = 0; s < species; ++s)
      for (std::size_t t = s; t < species; ++t) put_potentials(model, s, t, tables, unit);
    return model;
  }

  StateMixtureModel::States states(double unit) {
    const double cutoff = unit * between(1.3, 2.6);
    StateMixtureModel::States states{{cutoff * between(0.45, 0.8), cutoff * between(0.05, 0.15), cutoff}, {}, {}};
    const std::size_t count = 1 + below(5);
    const bool saturated = chance(0.05);
    for (std::size_t a = 0; a < count; ++a) {
      states.mu.push_back(between(-1.5, 1.5));
      if (a + 1 < count) states.steps.push_back({saturated ? between(500.0, 3000.0) : between(0.5, 12.0), between(0.7, 3.0)});
    }
    return states;
  }

  // Every species counts, its own, others, or each by another weight.
  std::vector<double> filter(std::size_t species) {
    const std::size_t kind = below(4);
    std::vector<double> filter;
    for (std::size_t s = 0; s < species; ++s)
      for (std::size_t t = 0; t < species; ++t) {
        const bool counts = kind == 0 || (kind == 1 && s == t) || (kind == 2 && s != t);
        filter.push_back(kind == 3 ? (chance(0.2) ? 0.0 : between(0.1, 1.5)) : counts ? 1.0 : 0.0);
      }
    return filter;
  }

  void put_potentials(StateMixtureModel& model, std::size_t s, std::size_t t, double tables, double unit) {
    const double first = unit * between(0.5, 0.7), last = unit * between(1.5, 2.6);
    const std::size_t values = 20 + below(80);
    for (std::size_t a = 0; a < model.states_of(s); ++a)
      for (std::size_t b = s == t ? a : 0; b < model.states_of(t); ++b) {
        StateMixtureModel::Potential u =
            StateMixtureModel::LennardJones{chance(0.1) ? 0.0 : between(0.3, 2.0), unit * between(0.8, 1.0)};
        if (chance(tables)) u = table(first, last, values);
        model.potentials[model.potential_at(s, a, t, b)] = u;
        model.potentials[model.potential_at(t, b, s, a)] = u;
      }
  }

  // A soft core and a well, or a shoulder, that ends with slope zero.
  StateMixtureModel::Table table(double first, double last, std::size_t count) {
    StateMixtureModel::Table table{first, last, {}};
    const double strength = between(5.0, 60.0), well = between(-0.1, 0.2);
    for (std::size_t k = 0; k + 1 < count; ++k) {
      const double x = static_cast<double>(k) / static_cast<double>(count - 1), left = 1.0 - x;
      table.values.push_back(strength * left * left * left * (std::exp(-5.0 * x) - well));
    }
    table.values.push_back(0.0);
    return table;
  }
};

}  // namespace lanescape::testing
