#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <lanescape/potential.hpp>

#include <algorithm>
#include <string>
#include <tuple>

#include "bound_landscapes.hpp"
#include "evaluations.hpp"
#include "module.hpp"

namespace lanescape::python {
namespace {

constexpr std::size_t most_particles = std::size_t{1} << 31;

std::size_t count_of(ArrayLike species, nb::handle particles) {
  if (!species.is_none()) return 0;
  if (particles.is_none())
    throw Error(ErrorCode::bad_input, "species: one for each particle is needed, or `particles`, their number");
  std::size_t count = 0;
  if (!nb::try_cast(particles, count) || count > most_particles)
    throw Error(ErrorCode::bad_input, "particles: " + text(nb::repr(particles)) + " is not allowed: a whole number from 0 to " +
                                          std::to_string(most_particles) + " is needed");
  return count;
}

void make(BoundPotential* self, const Model& model, ArrayLike species, ArrayLike box, nb::handle particles, int threads,
          const std::string& precision, const std::string& instruction_set, ArrayLike diameters) {
  const std::vector<int> indices = species_of(model, species, count_of(species, particles));
  new (self) BoundPotential(
      model, indices, box_of(box),
      Potential::Options{threads_of(threads), precision, instruction_set, Numbers::list(diameters, "diameters").copy()});
}

Array species_array(const Potential& potential) {
  const std::vector<std::int64_t> species(potential.species().begin(), potential.species().end());
  return new_list(species);
}

Array box_array(const Potential& potential) { return new_list(potential.box()); }

void set_exclusions(BoundPotential& self, ArrayLike given) {
  std::vector<std::array<std::size_t, 2>> pairs;
  for (const auto& [i, j] : pairs_of(given, "exclusions")) {
    if (i < 0 || j < 0) throw Error(ErrorCode::bad_input, "exclusions: " + std::to_string(std::min(i, j)) + " is no particle");
    pairs.push_back({static_cast<std::size_t>(i), static_cast<std::size_t>(j)});
  }
  unlocked(self.lock, [&] { self.object.set_exclusions(pairs); });
  self.exclusions = std::move(pairs);
}

Array exclusions_of(const BoundPotential& self) {
  std::vector<std::int64_t> indices;
  for (const auto& [i, j] : self.exclusions)
    indices.insert(indices.end(), {static_cast<std::int64_t>(i), static_cast<std::int64_t>(j)});
  return new_array(std::span<const std::int64_t>(indices), {self.exclusions.size(), 2});
}

// What a pickle holds: the parameters.
nb::tuple parameters(const BoundPotential& self) {
  const auto& [threads, precision, instruction_set, diameters] = self.object.options();
  return nb::make_tuple(self.object.model(), species_array(self.object), box_array(self.object), nb::none(), threads, precision,
                        instruction_set, new_list_or_none(diameters), exclusions_of(self));
}

void restore(BoundPotential* self, const nb::tuple& state) {
  check_state(state, 9);
  make(self, nb::cast<Model>(state[0]), state[1], state[2], state[3], nb::cast<int>(state[4]), nb::cast<std::string>(state[5]),
       nb::cast<std::string>(state[6]), state[7]);
  if (nb::len(nb::object(state[8])) != 0) set_exclusions(*self, state[8]);
}

void set_box(BoundPotential& self, ArrayLike box) {
  const auto edges = box_of(box);
  unlocked(self.lock, [&] { self.object.set_box(edges); });
}

}  // namespace

void bind_potentials(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<BoundPotential> type(
      module, "Potential",
      "The energy of a model with a pair potential, in a periodic orthorhombic box. A landscape. Threads may share an object: "
      "their calls\n"
      "follow each other. It keeps its memory and its neighbour list. Pickles and copies by its parameters.");
  type.def(
      "__init__", &make, "model"_a, "species"_a.none(), "box"_a, nb::kw_only(), "particles"_a = nb::none(), "threads"_a = 1,
      "precision"_a = "double", "instruction_set"_a = "auto", "diameters"_a = nb::none(),
      "model: one with a pair potential. species: names or indices, (N,); None for a model of one species, with `particles` of it. "
      "box: edges, (3,). threads share "
      "an\n"
      "evaluation and change no result. precision: double or mixed (pairs in single precision). instruction_set: auto or one of\n"
      "`lanescape.instruction_sets()`. diameters: (N,), for models whose particles have them.\n\nRaises InputError.");
  define_evaluations(type);
  type.def_prop_rw(
          "box", [](const BoundPotential& self) { return box_array(self.object); }, &set_box,
          "Edges, (3,). A new box holds for the calls that follow.")
      .def_prop_rw(
          "exclusions", &exclusions_of, &set_exclusions,
          "Pairs (i, j) that do not interact, such as bonded ones, (K, 2), int64. Only the nearest image of a pair is left out.")
      .def_prop_ro(
          "species", [](const BoundPotential& self) { return species_array(self.object); }, "Indices, (N,), int64.")
      .def_prop_ro(
          "particles", [](const BoundPotential& self) { return self.object.particles(); }, "N.")
      .def_prop_ro("model", [](const BoundPotential& self) { return self.object.model(); })
      .def("__getstate__", &parameters)
      .def("__setstate__", &restore);
}

}  // namespace lanescape::python
