#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <lanescape/potential.hpp>

#include <string>
#include <utility>

#include "arguments.hpp"
#include "guarded.hpp"
#include "module.hpp"

namespace lanescape::python {
namespace {

// With what its pickle needs and the library's class does not tell again.
struct BoundMoves : Guarded<ParticleMoves> {
  BoundMoves(Model with_model, std::vector<int> with_species, const Numbers& positions, const std::array<double, 3>& with_box,
             ParticleMoves::Options with_options)
      : Guarded<ParticleMoves>(with_model, with_species, positions.values(), with_box, with_options),
        model(std::move(with_model)),
        species(std::move(with_species)),
        box(with_box),
        options(std::move(with_options)) {}

  Model model;
  std::vector<int> species;
  std::array<double, 3> box;
  ParticleMoves::Options options;
};

void make(BoundMoves* self, const Model& model, ArrayLike species, ArrayLike positions, ArrayLike box,
          const std::string& instruction_set, ArrayLike diameters) {
  const Numbers given = Numbers::vectors(positions, "positions");
  new (self) BoundMoves(model, species_of(model, species, given.rows()), given, box_of(box),
                        {instruction_set, Numbers::list(diameters, "diameters").copy()});
}

double energy_change(BoundMoves& self, std::size_t particle, ArrayLike to) {
  const auto there = point_of(to, "to");
  return unlocked(self.lock, [&] { return self.object.energy_change(particle, there); });
}

Array positions_of(BoundMoves& self) {
  const std::vector<double> numbers = unlocked(self.lock, [&] {
    const auto now = self.object.positions();
    return std::vector<double>(now.begin(), now.end());
  });
  return new_vectors(numbers);
}

nb::tuple state(BoundMoves& self) {
  const std::vector<std::int64_t> species(self.species.begin(), self.species.end());
  return nb::make_tuple(self.model, new_list(species), positions_of(self), new_list(self.box), self.options.instruction_set,
                        new_list_or_none(self.options.diameters));
}

}  // namespace

void bind_particle_moves(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<BoundMoves>(module, "ParticleMoves",
                         "Moves of one particle at a time, for Monte Carlo: what a move changes costs the particle's neighbours, "
                         "whatever N. For models\n"
                         "with a pair potential, in double precision. Threads may share an object. A pickle holds the positions, "
                         "not a move that waits.")
      .def(
          "__init__", &make, "model"_a, "species"_a.none(), "positions"_a, "box"_a, nb::kw_only(), "instruction_set"_a = "auto",
          "diameters"_a = nb::none(),
          "species: names or indices, (N,); None for a model of one species. positions: (N, 3), wrapped or not. box: edges, (3,).\n"
          "diameters: (N,), for models whose particles have them.\n\nRaises InputError.")
      .def("energy_change", &energy_change, "particle"_a, "to"_a,
           "By how much the energy rises if particle `particle`, from 0, goes to `to`, (3,), while all others stand "
           "still.\n\nRaises InputError.")
      .def(
          "accept", [](BoundMoves& self) { unlocked(self.lock, [&] { self.object.accept(); }); },
          "Makes the last move that was asked for; the next one starts from there.")
      .def_prop_ro("positions", &positions_of, "A copy, (N, 3), with the moves that were made.")
      .def_prop_ro(
          "particles", [](const BoundMoves& self) { return self.species.size(); }, "N.")
      .def("__getstate__", &state)
      .def("__setstate__", [](BoundMoves* self, const nb::tuple& kept) {
        check_state(kept, 6);
        make(self, nb::cast<Model>(kept[0]), kept[1], kept[2], kept[3], nb::cast<std::string>(kept[4]), kept[5]);
      });
}

}  // namespace lanescape::python
