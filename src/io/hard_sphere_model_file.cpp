#include "io/model_file_kinds.hpp"
#include "io/model_sections.hpp"

namespace lanescape {
namespace {

const NumberRange diameter_range{[](double x) { return x >= smallest_diameter && x <= largest_diameter; },
                                 "a number from 1e-6 to 1e6"};

}  // namespace

HardSphereModel read_hard_sphere_model(const TomlReader& toml, const std::string& name) {
  toml.allow_keys(toml.root(), {"kind", "name", "species"});
  HardSphereModel model;
  model.name = name;
  model.species = read_species(toml, {"name", "mass", "fraction", "diameter"});
  for (const toml::table* section : toml.tables(toml.root(), "species"))
    model.diameters.push_back(toml.number(*section, "diameter", diameter_range));
  toml.located(toml.root(), [&] { model.check(); });
  return model;
}

std::string to_toml(const HardSphereModel& model) {
  std::string text = model_header(model, "hard-sphere");
  for (std::size_t s = 0; s < model.species.size(); ++s)
    text += species_section(model.species[s]) + fmt::format("diameter = {}\n", model.diameters[s]);
  return text;
}

}  // namespace lanescape
