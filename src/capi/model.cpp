#include "capi/model.hpp"

#include <cstring>

#include "capi/arguments.hpp"

using namespace lanescape;
using namespace lanescape::capi;

namespace {

NamedModel named(const Model& model) { return {model, model.species()}; }

std::vector<ModelSpecies> species_of(std::size_t count, const char* const* names, const double* masses, const double* fractions) {
  const auto symbols = array(names, count, "names");
  std::vector<ModelSpecies> species;
  for (std::size_t s = 0; s < symbols.size(); ++s)
    species.push_back({&given(symbols[s], "names"), masses ? masses[s] : 1.0, fractions ? fractions[s] : 1.0});
  return species;
}

std::vector<double> numbers(const double* data, std::size_t count, const char* argument) {
  const auto given = array(data, count, argument);
  return {given.begin(), given.end()};
}

PairParameters parameters_of(const lanescape_pair_parameters& given_parameters) {
  const lanescape_pair_parameters& p = given_parameters;
  check_species(p.species);
  PairParameters parameters;
  parameters.form = word(p.form, parameters.form.c_str());
  parameters.species = species_of(p.species, p.names, p.masses, p.fractions);
  parameters.epsilon = numbers(p.epsilon, p.species * p.species, "epsilon");
  parameters.sigma = numbers(p.sigma, p.species * p.species, "sigma");
  const auto keys = array(p.number_keys, p.numbers, "number_keys");
  const auto values = array(p.number_values, p.numbers, "number_values");
  for (std::size_t k = 0; k < keys.size(); ++k) parameters.numbers.emplace(&given(keys[k], "number_keys"), values[k]);
  parameters.cutoff = p.cutoff;
  parameters.truncation = word(p.truncation, parameters.truncation.c_str());
  parameters.images = word(p.images, parameters.images.c_str());
  parameters.name = word(p.name, parameters.name.c_str());
  return parameters;
}

}  // namespace

lanescape_status lanescape_pair_parameters_init(lanescape_pair_parameters* parameters, size_t size) {
  return guarded([&] {
    lanescape_pair_parameters presets{};
    presets.cutoff = PairParameters{}.cutoff;
    initialise(parameters, size, "parameters", "lanescape_pair_parameters", presets);
  });
}

lanescape_status lanescape_hard_sphere_parameters_init(lanescape_hard_sphere_parameters* parameters, size_t size) {
  return guarded([&] { initialise(parameters, size, "parameters", "lanescape_hard_sphere_parameters", {}); });
}

lanescape_status lanescape_model_named(const char* name, const lanescape_model_changes* changes, lanescape_model** model) {
  return guarded([&] {
    create(model, "model", [&] {
      ModelChanges wanted;
      if (changes != nullptr) {
        const auto& c = sized(changes, "changes", "lanescape_model_changes");
        wanted = {c.cutoff, word(c.truncation, ""), word(c.images, "")};
      }
      return named(Model::named(&given(name, "name"), wanted));
    });
  });
}

lanescape_status lanescape_model_mixture(const lanescape_pair_parameters* parameters, lanescape_model** model) {
  return guarded([&] {
    create(model, "model",
           [&] { return named(Model::mixture(parameters_of(sized(parameters, "parameters", "lanescape_pair_parameters")))); });
  });
}

lanescape_status lanescape_model_hard_spheres(const lanescape_hard_sphere_parameters* parameters, lanescape_model** model) {
  return guarded([&] {
    create(model, "model", [&] {
      const auto& p = sized(parameters, "parameters", "lanescape_hard_sphere_parameters");
      check_species(p.species);
      HardSphereParameters spheres;
      spheres.species = species_of(p.species, p.names, p.masses, p.fractions);
      spheres.diameters = numbers(p.diameters, p.species, "diameters");
      spheres.name = word(p.name, spheres.name.c_str());
      return named(Model::hard_spheres(spheres));
    });
  });
}

lanescape_status lanescape_model_from_file(const char* path, lanescape_model** model) {
  return guarded([&] { create(model, "model", [&] { return named(Model::from_file(&given(path, "path"))); }); });
}

lanescape_status lanescape_model_from_toml(const char* text, lanescape_model** model) {
  return guarded([&] { create(model, "model", [&] { return named(Model::from_toml(&given(text, "text"))); }); });
}

lanescape_status lanescape_model_to_toml(const lanescape_model* model, char* text, size_t capacity, size_t* needed) {
  return guarded([&] {
    const std::string toml = object_of(model, "model").model.to_toml();
    given(needed, "needed") = toml.size() + 1;
    if (capacity == 0) return;
    char* const out = &given(text, "text");
    const std::size_t length = std::min(toml.size(), capacity - 1);
    std::memcpy(out, toml.data(), length);
    out[length] = '\0';
  });
}

lanescape_status lanescape_model_describe(const lanescape_model* model, lanescape_model_description* description) {
  return guarded([&] {
    const Model& m = object_of(model, "model").model;
    auto& out = sized(description, "description", "lanescape_model_description");
    out = {out.size,
           m.name().c_str(),
           m.species_count(),
           m.is_hard() ? 1 : 0,
           m.has_states() ? 1 : 0,
           m.has_diameters() ? 1 : 0,
           m.largest_cutoff(),
           m.length_unit()};
  });
}

lanescape_status lanescape_model_species(const lanescape_model* model, size_t species, const char** name, double* mass,
                                         double* fraction) {
  return guarded([&] {
    const auto& known = object_of(model, "model").species;
    if (species >= known.size())
      refuse("species " + std::to_string(species) + " is not allowed: the model has " + std::to_string(known.size()) +
             ", numbered from 0");
    const ModelSpecies& one = known[species];
    if (name != nullptr) *name = one.name.c_str();
    if (mass != nullptr) *mass = one.mass;
    if (fraction != nullptr) *fraction = one.fraction;
  });
}

lanescape_status lanescape_model_destroy(lanescape_model* model) { return destroy(model, "model"); }
