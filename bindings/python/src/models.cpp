#include <nanobind/nanobind.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <lanescape/model.hpp>

#include <utility>

#include "arguments.hpp"
#include "module.hpp"

namespace lanescape::python {
namespace {

std::vector<ModelSpecies> species_list(const std::vector<std::string>& names, ArrayLike masses, ArrayLike fractions) {
  const Numbers mass = Numbers::list(masses, "masses"), fraction = Numbers::list(fractions, "fractions");
  const auto check = [&](const Numbers& numbers, nb::handle given, const char* what) {
    if (!given.is_none() && numbers.rows() != names.size())
      throw Error(ErrorCode::bad_input, std::string(what) + ": " + std::to_string(numbers.rows()) + " were given for " +
                                            std::to_string(names.size()) + " species: one for each is needed");
  };
  check(mass, masses, "masses");
  check(fraction, fractions, "fractions");
  std::vector<ModelSpecies> species;
  for (std::size_t s = 0; s < names.size(); ++s)
    species.push_back({names[s], masses.is_none() ? 1.0 : mass.values()[s],
                       fractions.is_none() ? 1.0 / static_cast<double>(names.size()) : fraction.values()[s]});
  return species;
}

// A number for one species, or a matrix.
std::vector<double> matrix_of(nb::handle given, const char* what) {
  const nb::object numpy = nb::module_::import_("numpy");
  const nb::object array = numpy.attr("atleast_2d")(given);
  if (nb::cast<std::size_t>(array.attr("ndim")) != 2 || !array.attr("shape")[0].equal(array.attr("shape")[1]))
    throw Error(ErrorCode::bad_input, std::string(what) + ": shape " + text(nb::object(array.attr("shape"))) +
                                          " is not allowed: (S, S) is needed for S species");
  return Numbers::list(array.attr("ravel")(), what).copy();
}

Model named(const std::string& name, double cutoff, const std::string& truncation, const std::string& images) {
  return Model::named(name, {cutoff, truncation, images});
}

Model mixture(const std::vector<std::string>& species, ArrayLike epsilon, ArrayLike sigma, const std::string& form,
              const std::map<std::string, double>& numbers, double cutoff, const std::string& truncation, const std::string& images,
              ArrayLike masses, ArrayLike fractions, const std::string& name) {
  return Model::mixture({.form = form,
                         .species = species_list(species, masses, fractions),
                         .epsilon = matrix_of(epsilon, "epsilon"),
                         .sigma = matrix_of(sigma, "sigma"),
                         .numbers = numbers,
                         .cutoff = cutoff,
                         .truncation = truncation,
                         .images = images,
                         .name = name});
}

Model hard_spheres(const std::vector<std::string>& species, ArrayLike diameters, ArrayLike masses, ArrayLike fractions,
                   const std::string& name) {
  return Model::hard_spheres({species_list(species, masses, fractions), Numbers::list(diameters, "diameters").copy(), name});
}

nb::tuple of_each_species(const Model& model, auto&& member) {
  nb::list members;
  for (const ModelSpecies& species : model.species()) members.append(member(species));
  return nb::tuple(members);
}

void bind_makers(nb::class_<Model>& model) {
  using namespace nb::literals;
  model.def_static(
      "named", &named, "name"_a, nb::kw_only(), "cutoff"_a = 0.0, "truncation"_a = "", "images"_a = "",
      "A model of `lanescape.model_names()`, in reduced units. `cutoff` (in units of sigma_ab), `truncation` and `images`\n"
      "change those of the model.\n\nRaises InputError for a name that is not there.");
  model.def_static("mixture", &mixture, "species"_a, "epsilon"_a, "sigma"_a, nb::kw_only(), "form"_a = "lennard-jones",
                   "numbers"_a = std::map<std::string, double>{}, "cutoff"_a = 2.5, "truncation"_a = "shifted", "images"_a = "all",
                   "masses"_a = nb::none(), "fractions"_a = nb::none(), "name"_a = "mixture",
                   "A mixture with a pair potential of one form, in any consistent units.\n\nspecies: names of S species. epsilon, "
                   "sigma: (S, S)\n"
                   "symmetric, or a number for S = 1. form: a word of `lanescape.pair_potentials()`. numbers: what the form has "
                   "beside these, by the\n"
                   "keys of docs/FORMATS.md. cutoff: in units of sigma_ab. truncation: shifted, plain, tail, shifted-force or "
                   "smooth. images: all, or\n"
                   "minimum for the nearest image of a pair only. masses, fractions: (S,); fractions are those of "
                   "starts.\n\nRaises InputError.");
  model.def_static("hard_spheres", &hard_spheres, "species"_a, "diameters"_a, nb::kw_only(), "masses"_a = nb::none(),
                   "fractions"_a = nb::none(), "name"_a = "hard-spheres",
                   "Additive hard spheres. species: names of S species. diameters, masses, fractions: (S,).\n\nRaises InputError.");
  model.def_static(
      "from_file",
      [](nb::handle path) { return Model::from_file(nb::cast<std::string>(nb::module_::import_("os").attr("fsdecode")(path))); },
      "path"_a, nb::sig("def from_file(path: str | os.PathLike) -> Model"), "A model file (docs/FORMATS.md). Raises InputError.");
  model.def_static(
      "from_toml", [](const std::string& text) { return Model::from_toml(text); }, "text"_a,
      "A model from the text of a model file. Raises InputError.");
}

void bind_members(nb::class_<Model>& model) {
  using namespace nb::literals;
  model.def("to_toml", &Model::to_toml, "The text from which `from_toml` makes the same model, bit for bit.")
      .def_prop_ro("name", [](const Model& m) { return m.name(); })
      .def_prop_ro(
          "species", [](const Model& m) { return of_each_species(m, [](const ModelSpecies& s) { return s.name; }); }, "Names, S.")
      .def_prop_ro(
          "masses", [](const Model& m) { return of_each_species(m, [](const ModelSpecies& s) { return s.mass; }); },
          "Of species, S.")
      .def_prop_ro(
          "fractions", [](const Model& m) { return of_each_species(m, [](const ModelSpecies& s) { return s.fraction; }); },
          "Of the particles, S.")
      .def(
          "find_species", [](const Model& m, const std::string& name) { return m.find_species(name); }, "name"_a,
          "Index of a species. Raises InputError.")
      .def_prop_ro("is_hard", &Model::is_hard, "Hard spheres: overlaps instead of energies.")
      .def_prop_ro("has_states", &Model::has_states, "Sites in states: see StateSystem.")
      .def_prop_ro("has_diameters", &Model::has_diameters, "Every particle has a diameter of its own.")
      .def_prop_ro("largest_cutoff", &Model::largest_cutoff, "Distance beyond which no two particles interact; 0 for hard spheres.")
      .def_prop_ro("length_unit", &Model::length_unit, "The unit of length in which default steps are given.")
      .def(
          "__eq__", [](const Model& a, const Model& b) { return a == b; }, nb::is_operator())
      .def("__hash__", [](const Model& m) { return nb::hash(nb::str(m.to_toml().c_str())); })
      .def("__repr__", [](const Model& m) { return "<lanescape.Model " + m.name() + ">"; })
      .def("__getstate__", &Model::to_toml)
      .def("__setstate__", [](Model* self, const std::string& text) { new (self) Model(Model::from_toml(text)); });
}

}  // namespace

void bind_models(nb::module_& module) {
  nb::class_<Model> model(module, "Model",
                          "What particles are and how they interact. Does not change; equal models compare equal; pickles.");
  bind_makers(model);
  bind_members(model);
  module.def("model_names", &model_names, "The names that Model.named takes.");
  module.def("pair_potentials", &pair_potentials, "The words that Model.mixture takes as its form.");
}

}  // namespace lanescape::python
