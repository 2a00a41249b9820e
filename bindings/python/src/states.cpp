#include <lanescape/states.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>

#include "bound_landscapes.hpp"
#include "evaluations.hpp"
#include "module.hpp"

namespace lanescape::python {
namespace {

void make(BoundStates* self, const Model& model, ArrayLike species, ArrayLike box, int threads,
          const std::string& instruction_set) {
  if (species.is_none()) throw nb::type_error("species: one for each site is needed");
  new (self) BoundStates(StateParameters{model, species_of(model, species, 0), box_of(box), threads_of(threads), instruction_set});
}

nb::object order_parameters(BoundStates& self) {
  const std::vector<double> values = unlocked(self.lock, [&] { return self.object.order_parameters(); });
  return new_array(std::span<const double>(values), {values.size()});
}

nb::object probabilities(BoundStates& self) {
  const std::vector<double> values = unlocked(self.lock, [&] { return self.object.probabilities(); });
  const std::size_t states = self.object.states();
  return new_array(std::span<const double>(values), {values.size() / states, states});
}

void set_box(BoundStates& self, ArrayLike box) {
  const auto edges = box_of(box);
  unlocked(self.lock, [&] { self.object.set_box(edges); });
  self.parameters.box = edges;
}

nb::tuple state(const BoundStates& self) {
  const auto& [model, species, box, threads, instruction_set] = self.parameters;
  const std::vector<std::int64_t> indices(species.begin(), species.end());
  return nb::make_tuple(model, new_array(std::span<const std::int64_t>(indices), {indices.size()}),
                        new_array(std::span<const double>(box), {3}), threads, instruction_set);
}

}  // namespace

void bind_states(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<BoundStates> system(
      module, "StateSystem",
      "Sites whose states follow their surroundings (ultra-coarse-graining), in a periodic orthorhombic box. A landscape. Threads "
      "may\n"
      "share an object. Pickles by its parameters.");
  define_evaluations(system);
  system
      .def("__init__", &make, "model"_a, "species"_a, "box"_a, nb::kw_only(), "threads"_a = 1, "instruction_set"_a = "auto",
           "model: one with states (Model.has_states). species: names or indices, (N,). box: edges, (3,).\n\nRaises InputError.")
      .def_prop_rw(
          "box", [](const BoundStates& self) { return new_array(std::span<const double>(self.parameters.box), {3}); }, &set_box,
          "Edges, (3,). A new box holds for the calls that follow.")
      .def_prop_ro(
          "particles", [](const BoundStates& self) { return self.object.particles(); }, "N.")
      .def_prop_ro(
          "states", [](const BoundStates& self) { return self.object.states(); }, "Of a site.")
      .def("order_parameters", &order_parameters, "Of the last evaluation, (N,).")
      .def("probabilities", &probabilities, "Of the last evaluation, (N, states).")
      .def("__getstate__", &state)
      .def("__setstate__", [](BoundStates* self, const nb::tuple& kept) {
        make(self, nb::cast<Model>(kept[0]), kept[1], kept[2], nb::cast<int>(kept[3]), nb::cast<std::string>(kept[4]));
      });
}

}  // namespace lanescape::python
