#include <lanescape/dynamics.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <string>

#include "arguments.hpp"
#include "guarded.hpp"
#include "module.hpp"

namespace lanescape::python {
namespace {

struct EventParameters {
  std::vector<double> radii, masses;
  // At the start: those of later touch to rounding, and would be refused as overlaps.
  std::vector<double> positions;
  std::array<double, 3> box;
  std::string instruction_set;
};

struct BoundEvents : Guarded<EventDrivenDynamics> {
  explicit BoundEvents(EventParameters with)
      : Guarded<EventDrivenDynamics>(with.radii, with.masses, with.positions, with.box, with.instruction_set),
        parameters(std::move(with)) {}
  EventParameters parameters;
};

void make(BoundEvents* self, ArrayLike radii, ArrayLike positions, ArrayLike box, ArrayLike masses,
          const std::string& instruction_set) {
  if (radii.is_none()) throw nb::type_error("radii: one for each sphere is needed");
  new (self) BoundEvents(EventParameters{Numbers::list(radii, "radii").copy(), Numbers::list(masses, "masses").copy(),
                                         Numbers::vectors(positions, "positions").copy(), box_of(box), instruction_set});
}

Array vectors(BoundEvents& self, std::vector<double> (EventDrivenDynamics::*member)() const) {
  const std::vector<double> values = unlocked(self.lock, [&] { return (self.object.*member)(); });
  return new_vectors(values);
}

// In pieces, so that Ctrl-C is seen.
void collide(BoundEvents& self, std::uint64_t collisions) {
  constexpr std::uint64_t piece = 100'000;
  for (std::uint64_t done = 0; done < collisions; done += piece) {
    unlocked(self.lock, [&] { self.object.collide(std::min(piece, collisions - done)); });
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }
}

nb::tuple state(BoundEvents& self) {
  const std::string bytes = unlocked(self.lock, [&] { return self.object.state(); });
  const auto& [radii, masses, positions, box, instruction_set] = self.parameters;
  return nb::make_tuple(new_list(radii), new_vectors(positions), new_list(box), new_list_or_none(masses), instruction_set,
                        nb::bytes(bytes.data(), bytes.size()));
}

void restore(BoundEvents* self, const nb::tuple& kept) {
  check_state(kept, 6);
  make(self, kept[0], kept[1], kept[2], kept[3], nb::cast<std::string>(kept[4]));
  const auto bytes = nb::cast<nb::bytes>(kept[5]);
  self->object.restore(std::string(bytes.c_str(), bytes.size()));
}

void define_state(nb::class_<BoundEvents>& type) {
  const auto number = [&](const char* name, auto member, const char* text) {
    type.def_prop_ro(
        name, [member](BoundEvents& self) { return unlocked(self.lock, [&] { return (self.object.*member)(); }); }, text);
  };
  number("collisions", &EventDrivenDynamics::collisions, "Done so far.");
  number("time", &EventDrivenDynamics::time, "In sigma sqrt(m / k_B T).");
  number("kinetic_energy", &EventDrivenDynamics::kinetic_energy, "sum m v^2 / 2.");
  number("compressibility", &EventDrivenDynamics::compressibility, "Z = p V / (N k_B T) since the start.");
  type.def_prop_ro(
          "positions", [](BoundEvents& self) { return vectors(self, &EventDrivenDynamics::positions); },
          "A copy, (N, 3), unwrapped.")
      .def_prop_rw(
          "velocities", [](BoundEvents& self) { return vectors(self, &EventDrivenDynamics::velocities); },
          [](BoundEvents& self, ArrayLike given) {
            const Numbers velocities = Numbers::vectors(given, "velocities");
            unlocked(self.lock, [&] { self.object.set_velocities(velocities.values()); });
          },
          "(N, 3).")
      .def("__getstate__", &state)
      .def("__setstate__", &restore);
}

}  // namespace

void bind_event_driven(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<BoundEvents> type(module, "EventDrivenDynamics",
                               "Hard spheres: free flight between elastic collisions, event by event. Time in sigma sqrt(m / k_B "
                               "T), with T = 1. Threads may share\n"
                               "an object. A pickle holds the whole state; taking one brings all spheres to one time, so that the "
                               "trajectory goes on with other bits.");
  type.def("__init__", &make, "radii"_a, "positions"_a, "box"_a, "masses"_a = nb::none(), nb::kw_only(),
           "instruction_set"_a = "auto",
           "radii, masses: (N,), masses None for 1. positions: (N, 3), without overlaps beyond rounding. box: edges, (3,), at "
           "least 2.05 of the "
           "largest\n"
           "diameter.\n\nRaises InputError.")
      .def(
          "draw_velocities",
          [](BoundEvents& self, std::uint64_t seed) { unlocked(self.lock, [&] { self.object.draw_velocities(seed); }); },
          "seed"_a = 1, "At T = 1.")
      .def("collide", &collide, "collisions"_a, "Advances by that many collisions.")
      .def(
          "advance_to", [](BoundEvents& self, double time) { unlocked(self.lock, [&] { self.object.advance_to(time); }); },
          "time"_a, "Advances to that time.");
  define_state(type);
}

}  // namespace lanescape::python
