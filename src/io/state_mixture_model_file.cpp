#include <array>
#include <cstdint>

#include "core/overloaded.hpp"
#include "io/model_file_kinds.hpp"
#include "io/model_sections.hpp"

namespace lanescape {
namespace {

// The local density of a species and its states, the densest first.
StateMixtureModel::States read_states(const TomlReader& toml, const toml::table& species) {
  const toml::node& node = toml.need(species, "density");
  const toml::table* density = node.as_table();
  if (!density) toml.refuse(node, "density is not allowed: a section [species.density] is needed");
  toml.allow_keys(*density, {"threshold", "width", "cutoff"});
  StateMixtureModel::States states;
  auto& [threshold, width, cutoff] = states.switching;
  threshold = toml.number(*density, "threshold", positive_number);
  width = toml.number_or(*density, "width", positive_number, 0.1 * threshold);
  cutoff = toml.number(*density, "cutoff", positive_number);
  const auto sections = toml.tables(species, "state");
  for (const toml::table* state : sections) {
    const bool last = state == sections.back();
    toml.allow_keys(*state, {"mu", "threshold", "width"});
    states.mu.push_back(toml.number_or(*state, "mu", finite_number, 0.0));
    if (const toml::node* extra = state->get("threshold"); last && extra)
      toml.refuse(*extra, "threshold is not allowed for the last state: it takes what is left");
    if (last) break;
    const double above = toml.number(*state, "threshold", finite_number);
    states.steps.push_back({above, toml.number_or(*state, "width", positive_number, 0.1 * above)});
  }
  return states;
}

void read_filters(const TomlReader& toml, StateMixtureModel& model) {
  model.filter.assign(model.species.size() * model.species.size(), 1.0);
  if (!toml.root().get("filter")) return;
  std::vector<bool> given(model.filter.size(), false);
  for (const toml::table* section : toml.tables(toml.root(), "filter")) {
    toml.allow_keys(*section, {"of", "counts", "weight"});
    const std::size_t k = model.pair(species_index(toml, toml.need(*section, "of"), model),
                                     species_index(toml, toml.need(*section, "counts"), model));
    if (given[k]) toml.refuse(*section, "this filter is given twice: each once is allowed");
    given[k] = true;
    model.filter[k] = toml.number(*section, "weight", non_negative_number);
  }
}

std::array<std::size_t, 2> read_state_numbers(const TomlReader& toml, const toml::table& pair, const StateMixtureModel& model,
                                              const std::array<std::size_t, 2>& species) {
  const std::array<std::size_t, 2> there = {model.states_of(species[0]), model.states_of(species[1])};
  const toml::node* node = pair.get("states");
  if (!node && there[0] == 1 && there[1] == 1) return {0, 0};
  const toml::array* numbers = toml.need(pair, "states").as_array();
  if (!numbers || numbers->size() != 2) toml.refuse(*node, "states is not allowed: a list of two numbers is needed, [0, 1]");
  std::array<std::size_t, 2> states{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto value = numbers->get(k)->value_exact<std::int64_t>();
    if (!value || *value < 0 || static_cast<std::size_t>(*value) >= there[k])
      toml.refuse(*numbers->get(k), fmt::format("states: species {} has {} of them: a whole number from 0 to {} is needed",
                                                model.species[species[k]].name, there[k], there[k] - 1));
    states[k] = static_cast<std::size_t>(*value);
  }
  return states;
}

StateMixtureModel::Potential read_potential(const TomlReader& toml, const toml::table& pair) {
  const toml::node* node = pair.get("values");
  if (!node) {
    toml.allow_keys(pair, {"species", "states", "epsilon", "sigma"});
    return StateMixtureModel::LennardJones{toml.number(pair, "epsilon", non_negative_number),
                                           toml.number(pair, "sigma", positive_number)};
  }
  toml.allow_keys(pair, {"species", "states", "first", "last", "values"});
  const toml::array* values = node->as_array();
  if (!values) toml.refuse(*node, "values is not allowed: a list of numbers is needed");
  StateMixtureModel::Table table{toml.number(pair, "first", non_negative_number), toml.number(pair, "last", positive_number), {}};
  for (const toml::node& value : *values) table.values.push_back(toml.number(value, "values", finite_number));
  return table;
}

void read_state_pairs(const TomlReader& toml, StateMixtureModel& model) {
  const std::size_t n = model.species.size(), most = model.most_states();
  model.potentials.assign(n * n * most * most, StateMixtureModel::LennardJones{0.0, 1.0});
  std::vector<bool> given(model.potentials.size(), false);
  for (const toml::table* section : toml.tables(toml.root(), "pair")) {
    const auto species = read_species_pair(toml, *section, model);
    const auto states = read_state_numbers(toml, *section, model, species);
    const std::size_t k = model.potential_at(species[0], states[0], species[1], states[1]);
    const std::size_t mirrored = model.potential_at(species[1], states[1], species[0], states[0]);
    if (given[k])
      toml.refuse(*section, fmt::format("pair {}-{}, states {} and {}, is given twice: each pair once, in either order, is allowed",
                                        model.species[species[0]].name, model.species[species[1]].name, states[0], states[1]));
    given[k] = given[mirrored] = true;
    model.potentials[k] = model.potentials[mirrored] = read_potential(toml, *section);
  }
  for (std::size_t s = 0; s < n; ++s)
    for (std::size_t t = s; t < n; ++t)
      for (std::size_t a = 0; a < model.states_of(s); ++a)
        for (std::size_t b = 0; b < model.states_of(t); ++b)
          if (!given[model.potential_at(s, a, t, b)])
            toml.refuse(toml.need(toml.root(), "pair"),
                        fmt::format("pair {}-{}, states {} and {}, is missing: every pair of states is needed once",
                                    model.species[s].name, model.species[t].name, a, b));
}

std::string to_toml(const StateMixtureModel::Potential& potential) {
  return std::visit(
      Overloaded{
          [](const StateMixtureModel::LennardJones& lj) { return fmt::format("epsilon = {}\nsigma = {}\n", lj.epsilon, lj.sigma); },
          [](const StateMixtureModel::Table& table) {
            return fmt::format("first = {}\nlast = {}\nvalues = [{}]\n", table.first, table.last, fmt::join(table.values, ", "));
          }},
      potential);
}

}  // namespace

StateMixtureModel read_state_mixture_model(const TomlReader& toml, const std::string& name) {
  toml.allow_keys(toml.root(), {"kind", "name", "cutoff", "entropy_temperature", "species", "filter", "pair"});
  StateMixtureModel model;
  model.name = name;
  model.cutoff = toml.number_or(toml.root(), "cutoff", positive_number, model.cutoff);
  model.entropy_temperature = toml.number_or(toml.root(), "entropy_temperature", non_negative_number, model.entropy_temperature);
  model.species = read_species(toml, {"name", "mass", "fraction", "density", "state"});
  for (const toml::table* section : toml.tables(toml.root(), "species")) model.states.push_back(read_states(toml, *section));
  read_filters(toml, model);
  read_state_pairs(toml, model);
  toml.located(toml.root(), [&] { model.check(); });
  return model;
}

std::string to_toml(const StateMixtureModel& model) {
  std::string text = model_header(model, "ucg");
  text += fmt::format("cutoff = {}\nentropy_temperature = {}\n", model.cutoff, model.entropy_temperature);
  const std::size_t n = model.species.size();
  for (std::size_t s = 0; s < n; ++s) {
    const auto& states = model.states[s];
    text += species_section(model.species[s]);
    text += fmt::format("[species.density]\nthreshold = {}\nwidth = {}\ncutoff = {}\n", states.switching.threshold,
                        states.switching.width, states.switching.cutoff);
    for (std::size_t a = 0; a < states.mu.size(); ++a) {
      text += fmt::format("[[species.state]]\nmu = {}\n", states.mu[a]);
      if (a < states.steps.size())
        text += fmt::format("threshold = {}\nwidth = {}\n", states.steps[a].threshold, states.steps[a].width);
    }
  }
  for (std::size_t s = 0; s < n; ++s)
    for (std::size_t t = 0; t < n; ++t)
      text += fmt::format("\n[[filter]]\nof = {}\ncounts = {}\nweight = {}\n", quoted(model.species[s].name),
                          quoted(model.species[t].name), model.filter[model.pair(s, t)]);
  for (std::size_t s = 0; s < n; ++s)
    for (std::size_t t = s; t < n; ++t)
      for (std::size_t a = 0; a < model.states_of(s); ++a)
        for (std::size_t b = s == t ? a : 0; b < model.states_of(t); ++b)
          text += fmt::format("\n[[pair]]\nspecies = [{}, {}]\nstates = [{}, {}]\n", quoted(model.species[s].name),
                              quoted(model.species[t].name), a, b) +
                  to_toml(model.potentials[model.potential_at(s, a, t, b)]);
  return text;
}

}  // namespace lanescape
