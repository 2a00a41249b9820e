#include <cmath>
#include <string_view>
#include <vector>

#include "io/model_file_kinds.hpp"
#include "io/model_sections.hpp"

namespace lanescape {
namespace {

void read_pairs(const TomlReader& toml, PairModel& model) {
  const std::size_t n = model.species.size();
  model.epsilon.assign(n * n, 0.0);
  model.sigma.assign(n * n, 0.0);  // 0: not given yet
  for (const toml::table* section : toml.tables(toml.root(), "pair")) {
    toml.allow_keys(*section, {"species", "epsilon", "sigma"});
    const toml::node& node = toml.need(*section, "species");
    const auto [a, b] = read_species_pair(toml, *section, model);
    if (model.sigma[model.pair(a, b)] != 0.0)
      toml.refuse(node, fmt::format("pair {}-{} is given twice: each pair once, in either order, is allowed", model.species[a].name,
                                    model.species[b].name));
    model.epsilon[model.pair(a, b)] = model.epsilon[model.pair(b, a)] = toml.number(*section, "epsilon", non_negative_number);
    model.sigma[model.pair(a, b)] = model.sigma[model.pair(b, a)] = toml.number(*section, "sigma", positive_number);
  }
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a; b < n; ++b)
      if (model.sigma[model.pair(a, b)] == 0.0)
        toml.refuse(toml.need(toml.root(), "pair"), fmt::format("pair {}-{} is missing: every pair of species is needed once",
                                                                model.species[a].name, model.species[b].name));
}

}  // namespace

PairModel read_pair_model(const TomlReader& toml, const PairForm& form, const std::string& name) {
  std::vector<std::string_view> keys = {"kind", "name", "cutoff", "truncation", "images", "species", "pair"};
  for (const FormNumber& number : form.numbers) keys.emplace_back(number.key);
  toml.allow_keys(toml.root(), keys);
  PairModel model;
  model.name = name;
  model.form = &form;
  if (std::isfinite(form.range)) model.cutoff = form.range;
  for (const FormNumber& number : form.numbers)
    model.form_numbers.push_back(number.preset ? toml.number_or(toml.root(), number.key, finite_number, *number.preset)
                                               : toml.number(toml.root(), number.key, finite_number));
  model.cutoff = toml.number_or(toml.root(), "cutoff", positive_number, model.cutoff);
  if (const toml::node* node = toml.root().get("truncation")) {
    const std::string word = toml.text(*node, "truncation");
    model.truncation = toml.located(*node, [&] { return parse_truncation(word); });
  }
  if (const toml::node* node = toml.root().get("images")) {
    const std::string word = toml.text(*node, "images");
    model.images = toml.located(*node, [&] { return parse_image_rule(word); });
  }
  model.species = read_species(toml, {"name", "mass", "fraction"});
  read_pairs(toml, model);
  toml.located(toml.root(), [&] { model.check(); });
  return model;
}

std::string to_toml(const PairModel& model) {
  std::string text = model_header(model, model.form->word);
  for (std::size_t k = 0; k < model.form_numbers.size(); ++k)
    text += fmt::format("{} = {}\n", model.form->numbers[k].key, model.form_numbers[k]);
  text += fmt::format("cutoff = {}\ntruncation = \"{}\"\nimages = \"{}\"\n", model.cutoff, to_string(model.truncation),
                      to_string(model.images));
  for (const Species& species : model.species) text += species_section(species);
  for (std::size_t a = 0; a < model.species.size(); ++a)
    for (std::size_t b = a; b < model.species.size(); ++b)
      text += fmt::format("\n[[pair]]\nspecies = [{}, {}]\nepsilon = {}\nsigma = {}\n", quoted(model.species[a].name),
                          quoted(model.species[b].name), model.epsilon[model.pair(a, b)], model.sigma[model.pair(a, b)]);
  return text;
}

}  // namespace lanescape
