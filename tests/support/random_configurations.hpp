#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "interaction/pair/pair_search.hpp"
#include "random_draws.hpp"

namespace lanescape::testing {

// A model with a pair potential, and a configuration in any unit of length.
struct RandomConfiguration {
  PairModel model;
  Configuration configuration;
  PairSearchOptions options;
  double unit;  // [sigma]
};

class RandomConfigurations : private RandomDraws {
 public:
  using RandomDraws::RandomDraws;

  RandomConfiguration make() {
    RandomConfiguration made{{}, {}, {}, std::pow(10.0, between(-12.0, 12.0))};
    made.model = model(made.unit);
    made.configuration = configuration(made.model, made.unit);
    const double kind = between(0.0, 1.0);
    made.options.precision = kind < 0.3 ? Precision::mixed : Precision::double_precision;
    if (kind >= 0.3 && kind < 0.6) made.options.search = PairSearch::list;
    if (kind >= 0.6 && kind < 0.8) made.options.search = PairSearch::all_pairs;
    open_axes(made);
    return made;
  }

  // As hosts can have it: a periodic box, and the search that the library takes.
  RandomConfiguration make_for_hosts() {
    RandomConfiguration made = make();
    made.configuration.box.periodic = {true, true, true};
    made.options.search = PairSearch::automatic;
    return made;
  }

 private:
  // Particles that are boxes away are then truly far. What open axes cannot have is refused; here and there that is wanted too.
  void open_axes(RandomConfiguration& made) {
    const bool can = made.options.search != PairSearch::all_pairs && made.model.truncation != Truncation::tail &&
                     made.model.images == ImageRule::all;
    if (!chance(can ? 0.4 : 0.02)) return;
    for (bool& periodic : made.configuration.box.periodic) periodic = chance(0.5);
  }

  PairModel model(double unit) {
    PairModel model;
    model.name = "random";
    model.form = &pair_forms()[below(pair_forms().size())];
    const std::size_t count = 1 + below(5);
    for (std::size_t s = 0; s < count; ++s)
      model.species.push_back({std::string(1, static_cast<char>('A' + s)), 1.0, 1.0 / static_cast<double>(count)});
    model.epsilon.assign(count * count, 0.0);
    model.sigma.assign(count * count, 1.0);
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a; b < count; ++b) {
        model.epsilon[model.pair(a, b)] = model.epsilon[model.pair(b, a)] = chance(0.1) ? 0.0 : between(0.3, 2.0);
        if (!model.form->has_diameters) model.sigma[model.pair(a, b)] = model.sigma[model.pair(b, a)] = unit * between(0.8, 1.0);
      }
    for (const FormNumber& number : model.form->numbers)
      model.form_numbers.push_back(number.preset.value_or(1.7) / (number.per_length ? unit : 1.0));
    model.cutoff = std::isfinite(model.form->range) ? model.form->range : between(1.1, 3.0);
    constexpr Truncation truncations[] = {Truncation::shifted, Truncation::plain, Truncation::tail, Truncation::shifted_force,
                                          Truncation::smooth};
    model.truncation = truncations[below(5)];
    if (model.form->has_diameters) model.truncation = chance(0.5) ? Truncation::shifted : Truncation::plain;
    model.images = chance(0.3) ? ImageRule::minimum : ImageRule::all;
    return model;
  }

  Configuration configuration(const PairModel& model, double unit) {
    Configuration c;
    std::vector<double> cutoffs;
    for (const double sigma : model.sigma) cutoffs.push_back(model.cutoff * (model.form->has_diameters ? unit : sigma));
    c.box = box(cutoffs, unit);
    fill(c, chance(0.3) ? 200 + below(60) : 1 + below(60), model.species.size(), 0.7 * unit, unit, cutoffs);
    if (model.form->has_diameters)
      for (std::size_t i = 0; i < c.size(); ++i) c.diameters.push_back(unit * between(0.8, 1.3));
    return c;
  }
};

}  // namespace lanescape::testing
