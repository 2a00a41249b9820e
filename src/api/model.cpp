#include <lanescape/model.hpp>

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "api/access.hpp"
#include "configuration/model_traits.hpp"
#include "core/error.hpp"
#include "core/overloaded.hpp"
#include "io/model_file.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN
namespace {

std::vector<Species> species_of(const std::vector<ModelSpecies>& given) {
  std::vector<Species> species;
  for (const ModelSpecies& s : given) species.push_back({s.name, s.mass, s.fraction});
  return species;
}

std::vector<double> numbers_of(const PairForm& form, std::map<std::string, double> given) {
  std::vector<double> numbers;
  std::string keys;
  for (const FormNumber& number : form.numbers) {
    keys += fmt::format("{}{}", keys.empty() ? "" : ", ", number.key);
    const auto found = given.extract(number.key);
    if (!found && !number.preset) throw_bad_input(fmt::format("number '{}' of potential {} is missing", number.key, form.word));
    numbers.push_back(found ? found.mapped() : *number.preset);
  }
  if (!given.empty())
    throw_bad_input(
        fmt::format("potential {} has no number '{}': it has {}", form.word, given.begin()->first, keys.empty() ? "none" : keys));
  return numbers;
}

void check_size(const char* matrix, std::size_t given, std::size_t species) {
  if (given != species * species)
    throw_bad_input(fmt::format("{} has {} entries: {} are needed, one for each pair of {} species", matrix, given,
                                species * species, species));
}

}  // namespace

Model::Model(std::shared_ptr<const detail::ModelData> data) : data_(std::move(data)) {}

Model Model::named(std::string_view name, const ModelChanges& changes) {
  AnyModel model = named_model(name);
  if (changes.cutoff == 0.0 && changes.truncation.empty() && changes.images.empty()) return detail::Access::make(std::move(model));
  auto* pairs = std::get_if<PairModel>(&model);
  if (pairs == nullptr)
    throw_bad_input(fmt::format("model {} has no cutoff, truncation or images to change: models of pair potentials have", name));
  if (changes.cutoff != 0.0) pairs->cutoff = changes.cutoff;
  if (!changes.truncation.empty()) pairs->truncation = parse_truncation(changes.truncation);
  if (!changes.images.empty()) pairs->images = parse_image_rule(changes.images);
  pairs->check();
  return detail::Access::make(std::move(model));
}

Model Model::mixture(const PairParameters& parameters) {
  PairModel model;
  model.name = parameters.name;
  model.form = &pair_form(parameters.form);
  model.species = species_of(parameters.species);
  check_size("epsilon", parameters.epsilon.size(), model.species.size());
  check_size("sigma", parameters.sigma.size(), model.species.size());
  model.epsilon = parameters.epsilon;
  model.sigma = parameters.sigma;
  model.form_numbers = numbers_of(*model.form, parameters.numbers);
  model.cutoff = std::isfinite(model.form->range) ? model.form->range : parameters.cutoff;
  model.truncation = parse_truncation(parameters.truncation);
  model.images = parse_image_rule(parameters.images);
  model.check();
  return detail::Access::make(std::move(model));
}

Model Model::hard_spheres(const HardSphereParameters& parameters) {
  HardSphereModel model;
  model.name = parameters.name;
  model.species = species_of(parameters.species);
  model.diameters = parameters.diameters;
  model.check();
  return detail::Access::make(std::move(model));
}

Model Model::from_file(const std::string& path) { return detail::Access::make(read_model_file(path)); }
Model Model::from_toml(std::string_view text) { return detail::Access::make(read_model_text(std::string(text))); }

std::string Model::to_toml() const {
  std::ostringstream out;
  write_model_file(out, data_->model);
  return out.str();
}

const std::string& Model::name() const { return mixture_of(data_->model).name; }

std::vector<ModelSpecies> Model::species() const {
  std::vector<ModelSpecies> species;
  for (const Species& s : mixture_of(data_->model).species) species.push_back({s.name, s.mass, s.fraction});
  return species;
}

std::size_t Model::species_count() const { return mixture_of(data_->model).species.size(); }
int Model::find_species(std::string_view name) const { return mixture_of(data_->model).find_species(name); }
bool Model::is_hard() const { return lanescape::is_hard(data_->model); }
bool Model::has_states() const { return traits_of(data_->model).has_states; }
bool Model::has_diameters() const { return traits_of(data_->model).sizes == SizeColumn::diameter; }

double Model::largest_cutoff() const {
  return std::visit(
      Overloaded{[](const PairModel& pairs) { return pairs.largest_cutoff(); }, [](const HardSphereModel&) { return 0.0; },
                 [](const StateMixtureModel& sites) {
                   double largest = 0.0;
                   for (std::size_t s = 0; s < sites.species.size(); ++s)
                     for (std::size_t t = 0; t < sites.species.size(); ++t) largest = std::max(largest, sites.reach(s, t));
                   return largest;
                 }},
      data_->model);
}

double Model::length_unit() const { return lanescape::length_unit(data_->model); }
bool operator==(const Model& a, const Model& b) { return a.data_ == b.data_ || a.to_toml() == b.to_toml(); }

std::vector<std::string> model_names() { return known_models(); }

std::vector<std::string> pair_potentials() {
  std::vector<std::string> words;
  for (const PairForm& form : pair_forms()) words.emplace_back(form.word);
  return words;
}

LANESCAPE_ABI_END
}  // namespace lanescape
