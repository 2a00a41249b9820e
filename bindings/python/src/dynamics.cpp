#include <lanescape/dynamics.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <string>

#include "arguments.hpp"
#include "module.hpp"
#include "python_landscape.hpp"

namespace lanescape::python {
namespace {

struct BoundDynamics {
  BoundDynamics(nb::handle landscape, std::vector<double> masses_given, const Numbers& positions, double step)
      : held(landscape, positions.rows()),
        masses(std::move(masses_given)),
        time_step(step),
        dynamics(unlocked(lock, held, [&] { return MolecularDynamics(*held.landscape, masses, positions.values(), time_step); })) {}

  HeldLandscape held;
  std::vector<double> masses;
  double time_step;
  Lock lock;
  MolecularDynamics dynamics;
};

Array vectors(BoundDynamics& self, std::vector<double> (MolecularDynamics::*member)() const) {
  const std::vector<double> values = unlocked(self.lock, [&] { return (self.dynamics.*member)(); });
  return new_vectors(values);
}

void make(BoundDynamics* self, nb::handle landscape, ArrayLike positions, double time_step, ArrayLike masses) {
  new (self) BoundDynamics(landscape, Numbers::list(masses, "masses").copy(), Numbers::vectors(positions, "positions"), time_step);
}

// In pieces, so that Ctrl-C is seen.
void run(BoundDynamics& self, std::uint64_t steps) {
  const std::uint64_t piece = std::max<std::uint64_t>(1, 100'000 / std::max<std::size_t>(1, self.held.landscape->particles()));
  for (std::uint64_t done = 0; done < steps; done += piece) {
    unlocked(self.lock, self.held, [&] { self.dynamics.run(std::min(piece, steps - done)); });
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }
}

nb::tuple state(BoundDynamics& self) {
  const std::string bytes = unlocked(self.lock, [&] { return self.dynamics.state(); });
  return nb::make_tuple(self.held.given, vectors(self, &MolecularDynamics::positions), self.time_step,
                        new_list_or_none(self.masses), nb::bytes(bytes.data(), bytes.size()));
}

void restore(BoundDynamics* self, const nb::tuple& kept) {
  check_state(kept, 5);
  make(self, kept[0], kept[1], nb::cast<double>(kept[2]), kept[3]);
  const auto bytes = nb::cast<nb::bytes>(kept[4]);
  unlocked(self->lock, self->held, [&] { self->dynamics.restore(std::string(bytes.c_str(), bytes.size())); });
}

// A landscape in Python may hold the dynamics that holds it: Python's collector of garbage has to see that.
int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (!nb::inst_ready(self)) return 0;
  const HeldLandscape& held = nb::inst_ptr<BoundDynamics>(self)->held;
  Py_VISIT(held.given.ptr());
  if (held.in_python)
    for (PyObject* reference : held.in_python->references()) Py_VISIT(reference);
  return 0;
}

PyType_Slot slots[] = {{Py_tp_traverse, reinterpret_cast<void*>(traverse)}, {0, nullptr}};

void define_state(nb::class_<BoundDynamics>& type) {
  using namespace nb::literals;
  const auto number = [&](const char* name, auto member, const char* text) {
    type.def_prop_ro(
        name, [member](BoundDynamics& self) { return unlocked(self.lock, self.held, [&] { return (self.dynamics.*member)(); }); },
        text);
  };
  number("steps", &MolecularDynamics::steps, "Done so far.");
  number("temperature", &MolecularDynamics::temperature, "2 K / (3 N).");
  number("kinetic_energy", &MolecularDynamics::kinetic_energy, "K.");
  number("potential_energy", &MolecularDynamics::potential_energy, "V.");
  type.def_prop_ro(
          "positions", [](BoundDynamics& self) { return vectors(self, &MolecularDynamics::positions); },
          "A copy, (N, 3), unwrapped.")
      .def_prop_rw(
          "velocities", [](BoundDynamics& self) { return vectors(self, &MolecularDynamics::velocities); },
          [](BoundDynamics& self, ArrayLike given) {
            const Numbers velocities = Numbers::vectors(given, "velocities");
            unlocked(self.lock, [&] { self.dynamics.set_velocities(velocities.values()); });
          },
          "(N, 3).")
      .def("__getstate__", &state)
      .def("__setstate__", &restore);
}

}  // namespace

void bind_dynamics(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<BoundDynamics> type(module, "MolecularDynamics", nb::type_slots(slots),
                                 "Newton's equations on a landscape by the velocity Verlet algorithm (doi 10.1063/1.442716). "
                                 "Starts at rest. Threads may share an\n"
                                 "object. A pickle holds the whole state, and the landscape.");
  type.def("__init__", &make, "landscape"_a, "positions"_a, "time_step"_a, "masses"_a = nb::none(),
           "landscape: a Potential, a StateSystem, an object with energy(R) and energy_and_gradient(R) or a function of R, (N, 3), "
           "that\n"
           "returns (energy, gradient). positions: (N, 3). masses: (N,), None for 1.\n\nRaises InputError; exceptions of the "
           "landscape pass "
           "through.")
      .def(
          "draw_velocities",
          [](BoundDynamics& self, double temperature, std::uint64_t seed) {
            unlocked(self.lock, [&] { self.dynamics.draw_velocities(temperature, seed); });
          },
          "temperature"_a, "seed"_a = 1, "Maxwell's distribution without total momentum, scaled so that sum m v^2 / 2 = (3/2) N T.")
      .def("run", &run, "steps"_a, "Advances by that many steps.");
  define_state(type);
}

}  // namespace lanescape::python
