#include <lanescape/states.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>

#include "bound_landscapes.hpp"
#include "evaluations.hpp"
#include "module.hpp"

namespace lanescape::python {
namespace {

void make(BoundStates* self, const Model& model, ArrayLike species, ArrayLike box, int threads, const std::string& instruction_set,
          nb::handle order_parameter, nb::handle response) {
  if (species.is_none()) throw nb::type_error("species: one for each site is needed");
  new (self) BoundStates(StateParameters{model, species_of(model, species, 0), box_of(box), threads_of(threads), instruction_set,
                                         nb::borrow(order_parameter), nb::borrow(response)});
}

Array order_parameters(BoundStates& self) {
  const std::vector<double> values = unlocked(self.lock, [&] { return self.object.order_parameters(); });
  return new_list(values);
}

Array probabilities(BoundStates& self) {
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
  const auto& [model, species, box, threads, instruction_set, order_parameter, response] = self.parameters;
  const std::vector<std::int64_t> indices(species.begin(), species.end());
  return nb::make_tuple(model, new_list(indices), new_list(box), threads, instruction_set, order_parameter, response);
}

constexpr const char* parameters_text =
    "model: one with states (Model.has_states). species: names or indices, (N,). box: edges, (3,).\n\n"
    "In place of the model's, both or none, on one thread:\n"
    "order_parameter: an object with reach(first_species, second_species), the distance within which it looks at such pairs;\n"
    "evaluate(pairs, species, values), which overwrites values, (N,); and add_gradient(pairs, species, multipliers, gradient, "
    "virial),\n"
    "which adds sum_k multipliers[k] d value[k]/dr_i to gradient, (N, 3), and to virial, (6,), what that adds to sum r_a f_b, xx "
    "yy\n"
    "zz yz xz xy. pairs: SitePairs. species: indices, (N,).\n"
    "response: an object with states(), their number S, and evaluate(species, value, states), which writes to states, (S, 3), "
    "each\n"
    "state's probability, its slope with respect to the value, and its logarithm. Probabilities add up to one.\n"
    "Their arrays are views of the library's memory, valid during the call: keep copies.\n\n"
    "Raises InputError; exceptions of these objects pass through.";

// Objects of the user's may hold the system that holds them: Python's collector of garbage has to see that.
int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (!nb::inst_ready(self)) return 0;
  const StateParameters& parameters = nb::inst_ptr<BoundStates>(self)->parameters;
  Py_VISIT(parameters.order_parameter.ptr());
  Py_VISIT(parameters.response.ptr());
  return 0;
}

PyType_Slot slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(traverse)}, {0, nullptr}};

}  // namespace

void bind_states(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<BoundStates> system(
      module, "StateSystem", nb::type_slots(slots),
      "Sites whose states follow their surroundings (ultra-coarse-graining), in a periodic orthorhombic box. A landscape. Threads "
      "may\n"
      "share an object. Pickles by its parameters.");
  define_evaluations(system);
  system
      .def("__init__", &make, "model"_a, "species"_a, "box"_a, nb::kw_only(), "threads"_a = 1, "instruction_set"_a = "auto",
           "order_parameter"_a = nb::none(), "response"_a = nb::none(), parameters_text)
      .def_prop_rw(
          "box", [](const BoundStates& self) { return new_list(self.parameters.box); }, &set_box,
          "Edges, (3,). A new box holds for the calls that follow.")
      .def_prop_ro(
          "particles", [](const BoundStates& self) { return self.object.particles(); }, "N.")
      .def_prop_ro(
          "states", [](const BoundStates& self) { return self.object.states(); }, "Of a site.")
      .def("order_parameters", &order_parameters, "Of the last evaluation, (N,).")
      .def("probabilities", &probabilities, "Of the last evaluation, (N, states).")
      .def("__getstate__", &state)
      .def("__setstate__", [](BoundStates* self, const nb::tuple& kept) {
        check_state(kept, 7);
        make(self, nb::cast<Model>(kept[0]), kept[1], kept[2], nb::cast<int>(kept[3]), nb::cast<std::string>(kept[4]), kept[5],
             kept[6]);
      });
}

}  // namespace lanescape::python
