#include "io/model_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/overloaded.hpp"

namespace lanescape {
namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;  // [bytes]
constexpr std::size_t most_species = 64;

// Fractions are typed with few digits; the first species takes the rest anyway.
constexpr double fraction_tolerance = 1e-3;

struct Range {
  bool (*contains)(double);
  const char* words;
};
constexpr Range positive{[](double x) { return std::isfinite(x) && x > 0.0; }, "a finite number above 0"};
constexpr Range non_negative{[](double x) { return std::isfinite(x) && x >= 0.0; }, "a finite number of at least 0"};
constexpr Range diameter_range{[](double x) { return x >= smallest_diameter && x <= largest_diameter; },
                               "a number from 1e-6 to 1e6"};
constexpr Range finite{[](double x) { return std::isfinite(x); }, "a finite number"};
constexpr Range unit_interval{[](double x) { return x >= 0.0 && x <= 1.0; }, "a number from 0 to 1"};

// Typed, checked access to a parsed file; every refusal carries the line of the node at fault.
class ModelParser {
 public:
  ModelParser(std::string file, const toml::table& root) : file_(std::move(file)), root_(root) {}

  Model parse(const std::string& default_name) const;

 private:
  [[noreturn]] void refuse(const toml::node& at, const std::string& what_and_allowed) const {
    throw_bad_input(fmt::format("{}:{}: {}", file_, std::max<std::size_t>(at.source().begin.line, 1), what_and_allowed));
  }
  void allow_keys(const toml::table& table, std::initializer_list<std::string_view> keys) const;
  const toml::node& need(const toml::table& table, std::string_view key) const;
  double number(const toml::node& node, std::string_view key, Range range) const;
  std::string text(const toml::node& node, std::string_view key) const;
  std::vector<const toml::table*> tables(std::string_view key) const { return tables(root_, key); }
  std::vector<const toml::table*> tables(const toml::table& within, std::string_view key) const;
  PairModel parse_lennard_jones(const std::string& name) const;
  HardSphereModel parse_hard_sphere(const std::string& name) const;
  StateMixtureModel parse_state_mixture(const std::string& name) const;
  StateMixtureModel::States parse_states(const toml::table& species) const;
  void parse_filters(StateMixtureModel& model) const;
  void parse_state_pairs(StateMixtureModel& model) const;
  StateMixtureModel::Potential parse_potential(const toml::table& pair) const;
  std::array<std::size_t, 2> parse_state_numbers(const toml::table& pair, const StateMixtureModel& model,
                                                 const std::array<std::size_t, 2>& species) const;
  std::array<std::size_t, 2> parse_species_pair(const toml::table& pair, const Mixture& mixture) const;
  std::vector<Species> parse_species(std::initializer_list<std::string_view> keys) const;
  void parse_pairs(PairModel& model) const;
  std::size_t species_index(const toml::node& node, const Mixture& mixture) const;
  // For library checks that know the model but not the file.
  template <class Action>
  auto located(const toml::node& at, Action action) const {
    try {
      return action();
    } catch (const Error& error) {
      refuse(at, error.what());
    }
  }

  std::string file_;
  const toml::table& root_;
};

void ModelParser::allow_keys(const toml::table& table, std::initializer_list<std::string_view> keys) const {
  for (const auto& [key, node] : table)
    if (std::find(keys.begin(), keys.end(), key.str()) == keys.end()) {
      const std::size_t line = key.source().begin.line;
      throw_bad_input(fmt::format("{}:{}: unknown key '{}': allowed are {}", file_, line, key.str(), fmt::join(keys, ", ")));
    }
}

const toml::node& ModelParser::need(const toml::table& table, std::string_view key) const {
  const toml::node* node = table.get(key);
  if (!node) refuse(table, fmt::format("'{}' is missing: it is needed here", key));
  return *node;
}

double ModelParser::number(const toml::node& node, std::string_view key, Range range) const {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !range.contains(*value))
    refuse(node, value ? fmt::format("{} = {} is not allowed: {} is needed", key, *value, range.words)
                       : fmt::format("{} is no number: {} is needed", key, range.words));
  return *value;
}

std::string ModelParser::text(const toml::node& node, std::string_view key) const {
  const auto value = node.value_exact<std::string>();
  if (!value || value->empty()) refuse(node, fmt::format("{} is not allowed: a text in quotes is needed", key));
  return *value;
}

std::vector<const toml::table*> ModelParser::tables(const toml::table& within, std::string_view key) const {
  const toml::node& node = need(within, key);
  const toml::array* array = node.as_array();
  if (!array || array->empty()) refuse(node, fmt::format("{} is not allowed: [[{}]] sections are needed", key, key));
  std::vector<const toml::table*> result;
  for (const toml::node& element : *array) {
    if (!element.is_table()) refuse(element, fmt::format("{} is not allowed: [[{}]] sections are needed", key, key));
    result.push_back(element.as_table());
  }
  return result;
}

// `keys` are those that a species of this kind of model may have.
std::vector<Species> ModelParser::parse_species(std::initializer_list<std::string_view> keys) const {
  const auto sections = tables("species");
  if (sections.size() > most_species)
    refuse(*sections.back(), fmt::format("{} species are not allowed: at most {} are", sections.size(), most_species));
  std::vector<Species> result;
  std::size_t with_fraction = 0;
  double sum = 0.0;
  for (const toml::table* section : sections) {
    allow_keys(*section, keys);
    Species species;
    const toml::node& name = need(*section, "name");
    species.name = text(name, "name");
    if (std::any_of(species.name.begin(), species.name.end(), [](unsigned char c) { return c <= ' ' || c == 127; }))
      refuse(name, "the name of a species is a column in files: blanks are not allowed in it");
    for (const Species& other : result)
      if (other.name == species.name) refuse(name, fmt::format("species {} is given twice: each once is allowed", species.name));
    if (const toml::node* mass = section->get("mass")) species.mass = number(*mass, "mass", positive);
    if (const toml::node* fraction = section->get("fraction")) {
      sum += species.fraction = number(*fraction, "fraction", unit_interval);
      ++with_fraction;
    } else {
      species.fraction = 1.0 / static_cast<double>(sections.size());
    }
    result.push_back(species);
  }
  if (with_fraction != 0 && with_fraction != sections.size())
    refuse(*sections.front(),
           fmt::format("{} of {} species have a fraction: all or none is allowed", with_fraction, sections.size()));
  if (with_fraction != 0 && std::abs(sum - 1.0) > fraction_tolerance)
    refuse(*sections.front(), fmt::format("the fractions add up to {}: a sum of 1 is needed", sum));
  return result;
}

std::size_t ModelParser::species_index(const toml::node& node, const Mixture& mixture) const {
  const std::string name = text(node, "species");
  return located(node, [&] { return static_cast<std::size_t>(mixture.find_species(name)); });
}

std::array<std::size_t, 2> ModelParser::parse_species_pair(const toml::table& pair, const Mixture& mixture) const {
  const toml::node& node = need(pair, "species");
  const toml::array* names = node.as_array();
  if (!names || names->size() != 2) refuse(node, "species is not allowed: a list of two names is needed, [\"A\", \"B\"]");
  return {species_index(*names->get(0), mixture), species_index(*names->get(1), mixture)};
}

void ModelParser::parse_pairs(PairModel& model) const {
  const std::size_t n = model.species.size();
  model.epsilon.assign(n * n, 0.0);
  model.sigma.assign(n * n, 0.0);  // 0: not given yet
  for (const toml::table* section : tables("pair")) {
    allow_keys(*section, {"species", "epsilon", "sigma"});
    const toml::node& node = need(*section, "species");
    const auto [a, b] = parse_species_pair(*section, model);
    if (model.sigma[model.pair(a, b)] != 0.0)
      refuse(node, fmt::format("pair {}-{} is given twice: each pair once, in either order, is allowed", model.species[a].name,
                               model.species[b].name));
    model.epsilon[model.pair(a, b)] = model.epsilon[model.pair(b, a)] = number(need(*section, "epsilon"), "epsilon", non_negative);
    model.sigma[model.pair(a, b)] = model.sigma[model.pair(b, a)] = number(need(*section, "sigma"), "sigma", positive);
  }
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a; b < n; ++b)
      if (model.sigma[model.pair(a, b)] == 0.0)
        refuse(need(root_, "pair"), fmt::format("pair {}-{} is missing: every pair of species is needed once",
                                                model.species[a].name, model.species[b].name));
}

PairModel ModelParser::parse_lennard_jones(const std::string& name) const {
  allow_keys(root_, {"kind", "name", "cutoff", "truncation", "images", "species", "pair"});
  PairModel model;
  model.name = name;
  if (const toml::node* node = root_.get("cutoff")) model.cutoff = number(*node, "cutoff", positive);
  if (const toml::node* node = root_.get("truncation")) {
    const std::string word = text(*node, "truncation");
    model.truncation = located(*node, [&] { return parse_truncation(word); });
  }
  if (const toml::node* node = root_.get("images")) {
    const std::string word = text(*node, "images");
    model.images = located(*node, [&] { return parse_image_rule(word); });
  }
  model.species = parse_species({"name", "mass", "fraction"});
  parse_pairs(model);
  located(root_, [&] { model.check(); });
  return model;
}

HardSphereModel ModelParser::parse_hard_sphere(const std::string& name) const {
  allow_keys(root_, {"kind", "name", "species"});
  HardSphereModel model;
  model.name = name;
  model.species = parse_species({"name", "mass", "fraction", "diameter"});
  for (const toml::table* section : tables("species"))
    model.diameters.push_back(number(need(*section, "diameter"), "diameter", diameter_range));
  located(root_, [&] { model.check(); });
  return model;
}

// A species' local density and its states, the densest first.
StateMixtureModel::States ModelParser::parse_states(const toml::table& species) const {
  const toml::node& node = need(species, "density");
  const toml::table* density = node.as_table();
  if (!density) refuse(node, "density is not allowed: a section [species.density] is needed");
  allow_keys(*density, {"threshold", "width", "cutoff"});
  StateMixtureModel::States states;
  auto& [threshold, width, cutoff] = states.switching;
  threshold = number(need(*density, "threshold"), "threshold", positive);
  const toml::node* given = density->get("width");
  width = given ? number(*given, "width", positive) : 0.1 * threshold;
  cutoff = number(need(*density, "cutoff"), "cutoff", positive);
  const auto sections = tables(species, "state");
  for (const toml::table* state : sections) {
    const bool last = state == sections.back();
    allow_keys(*state, {"mu", "threshold", "width"});
    const toml::node* mu = state->get("mu");
    states.mu.push_back(mu ? number(*mu, "mu", finite) : 0.0);
    if (const toml::node* extra = state->get("threshold"); last && extra)
      refuse(*extra, "threshold is not allowed for the last state: it takes what is left");
    if (last) break;
    const double above = number(need(*state, "threshold"), "threshold", finite);
    const toml::node* step = state->get("width");
    states.steps.push_back({above, step ? number(*step, "width", positive) : 0.1 * above});
  }
  return states;
}

void ModelParser::parse_filters(StateMixtureModel& model) const {
  model.filter.assign(model.species.size() * model.species.size(), 1.0);
  if (!root_.get("filter")) return;
  std::vector<bool> given(model.filter.size(), false);
  for (const toml::table* section : tables("filter")) {
    allow_keys(*section, {"of", "counts", "weight"});
    const std::size_t k = model.pair(species_index(need(*section, "of"), model), species_index(need(*section, "counts"), model));
    if (given[k]) refuse(*section, "this filter is given twice: each once is allowed");
    given[k] = true;
    model.filter[k] = number(need(*section, "weight"), "weight", non_negative);
  }
}

std::array<std::size_t, 2> ModelParser::parse_state_numbers(const toml::table& pair, const StateMixtureModel& model,
                                                            const std::array<std::size_t, 2>& species) const {
  const std::array<std::size_t, 2> there = {model.states_of(species[0]), model.states_of(species[1])};
  const toml::node* node = pair.get("states");
  if (!node && there[0] == 1 && there[1] == 1) return {0, 0};
  const toml::array* numbers = need(pair, "states").as_array();
  if (!numbers || numbers->size() != 2) refuse(*node, "states is not allowed: a list of two numbers is needed, [0, 1]");
  std::array<std::size_t, 2> states{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto value = numbers->get(k)->value_exact<std::int64_t>();
    if (!value || *value < 0 || static_cast<std::size_t>(*value) >= there[k])
      refuse(*numbers->get(k), fmt::format("states: species {} has {} of them: a whole number from 0 to {} is needed",
                                           model.species[species[k]].name, there[k], there[k] - 1));
    states[k] = static_cast<std::size_t>(*value);
  }
  return states;
}

StateMixtureModel::Potential ModelParser::parse_potential(const toml::table& pair) const {
  const toml::node* node = pair.get("values");
  if (!node) {
    allow_keys(pair, {"species", "states", "epsilon", "sigma"});
    return StateMixtureModel::LennardJones{number(need(pair, "epsilon"), "epsilon", non_negative),
                                           number(need(pair, "sigma"), "sigma", positive)};
  }
  allow_keys(pair, {"species", "states", "first", "last", "values"});
  const toml::array* values = node->as_array();
  if (!values) refuse(*node, "values is not allowed: a list of numbers is needed");
  StateMixtureModel::Table table{
      number(need(pair, "first"), "first", non_negative), number(need(pair, "last"), "last", positive), {}};
  for (const toml::node& value : *values) table.values.push_back(number(value, "values", finite));
  return table;
}

void ModelParser::parse_state_pairs(StateMixtureModel& model) const {
  const std::size_t n = model.species.size(), most = model.most_states();
  model.potentials.assign(n * n * most * most, StateMixtureModel::LennardJones{0.0, 1.0});
  std::vector<bool> given(model.potentials.size(), false);
  for (const toml::table* section : tables("pair")) {
    const auto species = parse_species_pair(*section, model);
    const auto states = parse_state_numbers(*section, model, species);
    const std::size_t k = model.potential_at(species[0], states[0], species[1], states[1]);
    const std::size_t mirrored = model.potential_at(species[1], states[1], species[0], states[0]);
    if (given[k])
      refuse(*section, fmt::format("pair {}-{}, states {} and {}, is given twice: each pair once, in either order, is allowed",
                                   model.species[species[0]].name, model.species[species[1]].name, states[0], states[1]));
    given[k] = given[mirrored] = true;
    model.potentials[k] = model.potentials[mirrored] = parse_potential(*section);
  }
  for (std::size_t s = 0; s < n; ++s)
    for (std::size_t t = s; t < n; ++t)
      for (std::size_t a = 0; a < model.states_of(s); ++a)
        for (std::size_t b = 0; b < model.states_of(t); ++b)
          if (!given[model.potential_at(s, a, t, b)])
            refuse(need(root_, "pair"), fmt::format("pair {}-{}, states {} and {}, is missing: every pair of states is needed once",
                                                    model.species[s].name, model.species[t].name, a, b));
}

StateMixtureModel ModelParser::parse_state_mixture(const std::string& name) const {
  allow_keys(root_, {"kind", "name", "cutoff", "entropy_temperature", "species", "filter", "pair"});
  StateMixtureModel model;
  model.name = name;
  if (const toml::node* node = root_.get("cutoff")) model.cutoff = number(*node, "cutoff", positive);
  if (const toml::node* node = root_.get("entropy_temperature"))
    model.entropy_temperature = number(*node, "entropy_temperature", non_negative);
  model.species = parse_species({"name", "mass", "fraction", "density", "state"});
  for (const toml::table* section : tables("species")) model.states.push_back(parse_states(*section));
  parse_filters(model);
  parse_state_pairs(model);
  located(root_, [&] { model.check(); });
  return model;
}

Model ModelParser::parse(const std::string& default_name) const {
  const toml::node& kind = need(root_, "kind");
  const std::string word = text(kind, "kind");
  const toml::node* name = root_.get("name");
  const std::string model_name = name ? text(*name, "name") : default_name;
  if (word == "lennard-jones") return parse_lennard_jones(model_name);
  if (word == "hard-sphere") return parse_hard_sphere(model_name);
  if (word == "ucg") return parse_state_mixture(model_name);
  refuse(kind, fmt::format("unknown kind '{}': allowed are lennard-jones, hard-sphere, ucg", word));
}

std::string read_text(const std::filesystem::path& path) {
  const auto refuse = [&](std::string_view what) {
    throw_bad_input(fmt::format("{}: {}: a readable TOML file of at most {} bytes is needed", path.string(), what, largest_file));
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) refuse("it is a folder");
  if (!std::filesystem::exists(status)) refuse("there is no such file");
  std::ifstream in(path, std::ios::binary);
  if (!in) refuse("it cannot be opened");
  std::string content(largest_file + 1, '\0');
  in.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (in.bad()) refuse("reading failed");
  content.resize(static_cast<std::size_t>(in.gcount()));
  if (content.size() > largest_file) refuse("it is too large");
  return content;
}

std::string quoted(const std::string& text) {
  std::ostringstream out;
  out << toml::value<std::string>(text);
  return out.str();
}

Model parse_model(const std::string& content, const std::string& file, const std::string& default_name) {
  try {
    return ModelParser(file, toml::parse(content)).parse(default_name);
  } catch (const toml::parse_error& error) {
    std::string what(error.description());
    std::replace_if(what.begin(), what.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    throw_bad_input(fmt::format("{}:{}: {}: valid TOML is needed", file, error.source().begin.line, what));
  }
}

std::string header(const Mixture& mixture, std::string_view kind) {
  return fmt::format("kind = \"{}\"\n", kind) + (mixture.name.empty() ? "" : fmt::format("name = {}\n", quoted(mixture.name)));
}

std::string section(const Species& species) {
  return fmt::format("\n[[species]]\nname = {}\nmass = {}\nfraction = {}\n", quoted(species.name), species.mass, species.fraction);
}

std::string to_toml(const PairModel& model) {
  std::string text = header(model, "lennard-jones");
  text += fmt::format("cutoff = {}\ntruncation = \"{}\"\nimages = \"{}\"\n", model.cutoff, to_string(model.truncation),
                      to_string(model.images));
  for (const Species& species : model.species) text += section(species);
  for (std::size_t a = 0; a < model.species.size(); ++a)
    for (std::size_t b = a; b < model.species.size(); ++b)
      text += fmt::format("\n[[pair]]\nspecies = [{}, {}]\nepsilon = {}\nsigma = {}\n", quoted(model.species[a].name),
                          quoted(model.species[b].name), model.epsilon[model.pair(a, b)], model.sigma[model.pair(a, b)]);
  return text;
}

std::string to_toml(const HardSphereModel& model) {
  std::string text = header(model, "hard-sphere");
  for (std::size_t s = 0; s < model.species.size(); ++s)
    text += section(model.species[s]) + fmt::format("diameter = {}\n", model.diameters[s]);
  return text;
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

std::string to_toml(const StateMixtureModel& model) {
  std::string text = header(model, "ucg");
  text += fmt::format("cutoff = {}\nentropy_temperature = {}\n", model.cutoff, model.entropy_temperature);
  const std::size_t n = model.species.size();
  for (std::size_t s = 0; s < n; ++s) {
    const auto& states = model.states[s];
    text += section(model.species[s]);
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

}  // namespace

Model read_model_file(const std::filesystem::path& path) {
  return parse_model(read_text(path), path.string(), path.stem().string());
}

void write_model_file(std::ostream& out, const Model& model) {
  const std::string text = std::visit(
      [](const auto& m) {
        m.check();
        return to_toml(m);
      },
      model);
  // The reader is stricter than check() on names and fractions; what it would refuse is not written.
  const std::string& name = mixture_of(model).name;
  parse_model(text, "model " + name, name);
  out << text;
}

}  // namespace lanescape
