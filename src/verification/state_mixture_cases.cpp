#include "verification/state_mixture_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace lanescape {
namespace {

using Variant = StateMixtureVariant;
using Filter = Variant::Filter;
using Potentials = Variant::Potentials;

double filter_of(Filter filter, std::size_t s, std::size_t t) {
  switch (filter) {
    case Filter::every:
      return 1.0;
    case Filter::own:
      return s == t ? 1.0 : 0.0;
    case Filter::cross:
      return s == t ? 0.0 : 1.0;
    case Filter::asymmetric:
      return s == 0 ? 1.0 : 0.3 * static_cast<double>(t);
  }
  return 0.0;
}

// A soft core and a well that goes to zero with zero slope at its end.
StateMixtureModel::Table table_of(double strength, double cutoff) {
  StateMixtureModel::Table table{0.6, cutoff, {}};
  constexpr int count = 60;
  for (int k = 0; k < count; ++k) {
    const double r = table.first + (cutoff - table.first) * k / (count - 1), left = 1.0 - r / cutoff;
    table.values.push_back(k + 1 == count ? 0.0 : 40.0 * strength * left * left * left * (std::exp(-3.0 * (r - 0.6)) - 0.15));
  }
  return table;
}

Configuration in_box(const Box& box, std::size_t n, std::size_t species) {
  const CounterRandom jitter(1, RandomStream::displacements);
  std::array<int, 3> cells{1, 1, 1};
  const auto spacing = [&](std::size_t axis) { return box.length[axis] / cells[axis]; };
  while (static_cast<std::size_t>(cells[0] * cells[1] * cells[2]) < n) {
    std::size_t widest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (spacing(axis) > spacing(widest)) widest = axis;
    ++cells[widest];
  }
  Configuration fluid{box, {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const auto c = static_cast<int>(i);
    const std::array<int, 3> cell{c % cells[0], c / cells[0] % cells[1], c / cells[0] / cells[1]};
    fluid.species.push_back(static_cast<int>(i % species));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Some are boxes away, as in a long run.
      const double away = i % 3 == 2 ? static_cast<double>(i % 5) - 2.0 : 0.0;
      const double displacement = 0.16 * (jitter.uniform(n, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(axis)) - 0.5);
      fluid.positions.push_back((cell[axis] + 0.5) * spacing(axis) + displacement + away * box.length[axis]);
    }
  }
  return fluid;
}

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const std::size_t species : {1U, 2U, 3U})
    for (const std::size_t states : {1U, 2U, 3U, 5U})
      for (const Filter filter : {Filter::every, Filter::own, Filter::cross, Filter::asymmetric})
        for (const Potentials potentials : {Potentials::lennard_jones, Potentials::tables, Potentials::both}) {
          if (species == 1 && filter != Filter::every) continue;
          all.push_back({species, states, filter, potentials, states % 2 == 0 ? 0.7 : 0.0, false});
        }
  all.push_back({1, 3, Filter::every, Potentials::lennard_jones, 1.0, true});
  all.push_back({2, 2, Filter::every, Potentials::tables, 1.0, true});
  return all;
}

}  // namespace

StateMixtureModel state_mixture_model(const Variant& v, double cutoff) {
  StateMixtureModel model;
  model.name = "states";
  model.cutoff = cutoff;
  model.entropy_temperature = v.entropy_temperature;
  constexpr const char* names[] = {"Ar", "Kr", "Xe"};
  for (std::size_t s = 0; s < v.species; ++s) {
    const auto x = static_cast<double>(s);
    model.species.push_back({names[s], 1.0, 1.0 / static_cast<double>(v.species)});
    StateMixtureModel::States states{{1.4, 0.14, 2.1 - 0.2 * x}, {}, {}};
    // If there are several species, the last has one state less.
    const std::size_t count = s > 0 && s + 1 == v.species ? std::max<std::size_t>(v.states, 2) - 1 : v.states;
    for (std::size_t a = 0; a < count; ++a) {
      const auto y = static_cast<double>(a);
      if (a + 1 < count) states.steps.push_back({v.saturated ? 3000.0 : 6.5 - 2.0 * y, v.saturated ? 2.0 : 2.5});
      states.mu.push_back(0.7 * y - 0.4 * x);
    }
    model.states.push_back(states);
  }
  for (std::size_t s = 0; s < v.species; ++s)
    for (std::size_t t = 0; t < v.species; ++t) model.filter.push_back(filter_of(v.filter, s, t));
  const std::size_t most = model.most_states();
  for (std::size_t s = 0; s < v.species; ++s)
    for (std::size_t t = 0; t < v.species; ++t)
      for (std::size_t a = 0; a < most; ++a)
        for (std::size_t b = 0; b < most; ++b) {
          const double strength = 1.0 + 0.3 * static_cast<double>(a + b) - 0.2 * static_cast<double>(s + t);
          const bool table = v.potentials == Potentials::tables || (v.potentials == Potentials::both && (a + b) % 2 == 1);
          if (table)
            model.potentials.emplace_back(table_of(strength, 2.2 + 0.05 * static_cast<double>(s + t)));
          else
            model.potentials.emplace_back(StateMixtureModel::LennardJones{strength, 1.0 - 0.02 * static_cast<double>(a * b)});
        }
  return model;
}

std::string describe(const Variant& v) {
  constexpr const char *filters[] = {"every", "own", "cross", "asymmetric"}, *potentials[] = {"lj", "tables", "lj and tables"};
  return fmt::format("{} species, {} states, {}, {}{}{}", v.species, v.states, filters[static_cast<std::size_t>(v.filter)],
                     potentials[static_cast<std::size_t>(v.potentials)], v.entropy_temperature > 0.0 ? ", entropy" : "",
                     v.saturated ? ", saturated" : "");
}

Configuration state_mixture_fluid(std::size_t n, std::size_t species, double density) {
  const double length = std::cbrt(static_cast<double>(std::max<std::size_t>(n, 1)) / density);
  return in_box({{length, length, length}}, n, species);
}

std::vector<StateMixtureCase> state_mixture_cases() {
  std::vector<StateMixtureCase> cases;
  for (const Variant& v : variants())
    cases.push_back({describe(v) + ", N=64", state_mixture_model(v), state_mixture_fluid(64, v.species)});
  for (const std::size_t n : {0U, 1U, 2U, 3U, 7U, 8U, 9U, 31U, 107U})
    for (const Variant& v : {Variant{1, 2}, Variant{2, 3, Filter::asymmetric, Potentials::both, 0.5}})
      cases.push_back({fmt::format("{}, N={}", describe(v), n), state_mixture_model(v), state_mixture_fluid(n, v.species)});
  for (const auto& [name, box, n] : {std::tuple{"wide box", Box{{6.5, 5.5, 7.2}}, 150U},
                                     std::tuple{"slab", Box{{6.5, 5.7, 1.1}}, 30U}, std::tuple{"needle", Box{{1.2, 1.3, 9.0}}, 9U}})
    for (const Variant& v : {Variant{1, 2, Filter::every, Potentials::lennard_jones, 0.4},
                             Variant{2, 2, Filter::asymmetric, Potentials::tables}, Variant{2, 3, Filter::cross, Potentials::both}})
      cases.push_back({fmt::format("{}, {}", name, describe(v)), state_mixture_model(v), in_box(box, n, v.species)});
  return cases;
}

}  // namespace lanescape
