#pragma once

#include <nanobind/nanobind.h>

#include <tuple>
#include <utility>

#include <lanescape/potential.hpp>

#include "arguments.hpp"
#include "guarded.hpp"

// What Potential and StateSystem have in common in Python.
namespace lanescape::python {

using EnergyAndArray = nb::typed<nb::tuple, double, Array>;

template <class Bound>
double energy(Bound& system, ArrayLike positions) {
  const Numbers given = Numbers::vectors(positions, "positions");
  return unlocked(system.lock, [&] { return system.object.energy(given.values()); });
}

template <class Bound>
EnergyAndArray energy_and_gradient(Bound& system, ArrayLike positions, ArrayLike out) {
  const Numbers given = Numbers::vectors(positions, "positions");
  Room gradient = Room::vectors(out, given.rows(), "out");
  const double energy = unlocked(system.lock, [&] { return system.object.energy_and_gradient(given.values(), gradient.values()); });
  return nb::make_tuple(energy, gradient.array());
}

template <class Bound>
EnergyAndArray energy_and_forces(Bound& system, ArrayLike positions, ArrayLike out) {
  const Numbers given = Numbers::vectors(positions, "positions");
  Room forces = Room::vectors(out, given.rows(), "out");
  const Outputs outputs{.forces = Vectors<double>::interleaved(forces.values())};
  const Evaluation e = unlocked(system.lock, [&] { return system.object.evaluate(given.values(), outputs); });
  return nb::make_tuple(e.energy, forces.array());
}

// False and None: not wanted; True: in a new array; else the array to write to.
inline bool wanted(nb::handle request) { return !request.is_none() && !request.is(nb::bool_(false)); }
inline nb::object room(nb::handle request) { return request.is(nb::bool_(true)) ? nb::none() : nb::borrow(request); }

template <class Bound>
EvaluationObject evaluate(Bound& system, ArrayLike positions, nb::handle forces, bool stress, nb::handle energies) {
  const Numbers given = Numbers::vectors(positions, "positions");
  Outputs outputs;
  outputs.stress = stress;
  nb::dict members;
  members["forces"] = members["energies"] = nb::none();
  if (wanted(forces)) {
    Room to = Room::vectors(room(forces), given.rows(), "forces");
    outputs.forces = Vectors<double>::interleaved(to.values());
    members["forces"] = to.array();
  }
  if (wanted(energies)) {
    Room to = Room::list(room(energies), given.rows(), "energies");
    outputs.energies = to.values();
    members["energies"] = to.array();
  }
  const Evaluation e = unlocked(system.lock, [&] { return system.object.evaluate(given.values(), outputs); });
  members["energy"] = e.energy;
  members["virial"] = stress || wanted(forces) ? nb::object(nb::float_(e.virial)) : nb::none();
  members["stress"] = stress ? nb::object(new_list(e.stress)) : nb::object(nb::none());
  return new_result<EvaluationObject>(members);
}

// The methods above, for a class.
template <class Bound>
void define_evaluations(nb::class_<Bound>& type) {
  using namespace nb::literals;
  type.def("energy", &energy<Bound>, "positions"_a, "V. positions: (N, 3), wrapped or not.\n\nRaises InputError.")
      .def("energy_and_gradient", &energy_and_gradient<Bound>, "positions"_a, "out"_a = nb::none(),
           "(V, dV/dR). positions: (N, 3). The gradient, (N, 3), is written to `out` and returned; None: to a new array.\n\nRaises "
           "InputError.")
      .def("energy_and_forces", &energy_and_forces<Bound>, "positions"_a, "out"_a = nb::none(),
           "(V, -dV/dR), as energy_and_gradient.")
      .def("evaluate", &evaluate<Bound>, "positions"_a, nb::kw_only(), "forces"_a = true, "stress"_a = false, "energies"_a = false,
           "An Evaluation of what is asked for. forces: (N, 3), energies: (N,); each True, False or the array to write to. stress: "
           "(6,),\n"
           "xx yy zz yz xz xy, minus sum r_a f_b over the volume.\n\nRaises InputError.");
}

}  // namespace lanescape::python
