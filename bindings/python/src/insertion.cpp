#include <lanescape/insertion.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>

#include "arguments.hpp"
#include "guarded.hpp"
#include "module.hpp"

namespace lanescape::python {
namespace {

using BoundInserter = Guarded<Inserter>;

int probe_of(const Model& model, nb::handle given) {
  nb::list one;
  one.append(given);
  return species_of(model, given.is_none() ? nb::object(nb::none()) : nb::object(one), 1).front();
}

void make(BoundInserter* self, const Model& model, ArrayLike species, ArrayLike positions, ArrayLike box, nb::handle probe,
          double diameter, ArrayLike diameters, const std::string& instruction_set) {
  const Numbers given = Numbers::vectors(positions, "positions");
  const std::vector<int> indices = species_of(model, species, given.rows());
  const auto edges = box_of(box);
  const Inserter::Options options{probe_of(model, probe), diameter, Numbers::list(diameters, "diameters").copy(), instruction_set};
  const nb::gil_scoped_release others_may_run;
  new (self) BoundInserter(model, indices, given.values(), edges, options);
}

InsertionSettings settings_of(double energy, double tolerance, const std::string& measure, const std::string& method,
                              double largest_step, std::uint64_t most_trials, ArrayLike region, std::uint64_t seed, int threads) {
  InsertionSettings settings{energy, tolerance, measure, method, largest_step, most_trials, {}, seed, threads_of(threads)};
  if (region.is_none()) return settings;
  const Numbers corners = Numbers::vectors(region, "region");
  if (corners.rows() != 2) throw Error(ErrorCode::bad_input, "region: shape (2, 3) is needed, the low and the high corner");
  settings.region.emplace();
  for (std::size_t k = 0; k < 6; ++k) (*settings.region)[k / 3][k % 3] = corners.values()[k];
  return settings;
}

using Search = std::vector<InsertedParticle> (Inserter::*)(const InsertionSettings&, std::size_t);

template <Search search>
nb::typed<nb::list, InsertedParticleObject> found_by(BoundInserter& self, double energy, std::size_t count, double tolerance,
                                                     const std::string& measure, const std::string& method, double largest_step,
                                                     std::uint64_t most_trials, ArrayLike region, std::uint64_t seed, int threads) {
  const InsertionSettings settings =
      settings_of(energy, tolerance, measure, method, largest_step, most_trials, region, seed, threads);
  const auto found = unlocked(self.lock, [&] { return (self.object.*search)(settings, count); });
  nb::typed<nb::list, InsertedParticleObject> results;
  for (const InsertedParticle& particle : found) {
    nb::dict members;
    members["found"] = particle.found;
    members["position"] = new_list(particle.position);
    members["energy"] = particle.energy;
    members["error"] = particle.error;
    members["evaluations"] = particle.evaluations;
    members["trials"] = particle.trials;
    results.append(new_result<InsertedParticleObject>(members));
  }
  return results;
}

double energy(BoundInserter& self, ArrayLike position) {
  const auto point = point_of(position, "position");
  return unlocked(self.lock, [&] { return self.object.energy(point); });
}

nb::typed<nb::tuple, double, Array> energy_and_force(BoundInserter& self, ArrayLike position) {
  const auto point = point_of(position, "position");
  std::array<double, 3> force{};
  const double energy = unlocked(self.lock, [&] { return self.object.energy_and_force(point, force); });
  return nb::make_tuple(energy, new_list(force));
}

Array energies(BoundInserter& self, ArrayLike positions, ArrayLike out) {
  const Numbers given = Numbers::vectors(positions, "positions");
  Room room = Room::list(out, given.rows(), "out");
  unlocked(self.lock, [&] { self.object.energies(given.values(), room.values()); });
  return room.array();
}

template <Search search>
void define_search(nb::class_<BoundInserter>& type, const char* name, const char* text) {
  using namespace nb::literals;
  type.def(name, &found_by<search>, "energy"_a, "count"_a = 1, nb::kw_only(), "tolerance"_a = 0.01, "measure"_a = "relative",
           "method"_a = "usher", "largest_step"_a = 0.0, "most_trials"_a = 10'000, "region"_a = nb::none(), "seed"_a = 1,
           "threads"_a = 1, text);
}

}  // namespace

void bind_insertion(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<BoundInserter> type(
      module, "Inserter",
      "One more particle in a fluid that stands still: its energy anywhere, and positions at which it has a given energy\n"
      "(USHER, doi 10.1063/1.1579475). For models with a pair potential. Threads may share an object.");
  type.def(
      "__init__", &make, "model"_a, "species"_a.none(), "positions"_a, "box"_a, nb::kw_only(), "probe"_a = nb::none(),
      "diameter"_a = 1.0, "diameters"_a = nb::none(), "instruction_set"_a = "auto",
      "species: of the fluid, names or indices, (N,); None for a model of one species. positions: (N, 3). box: edges, (3,).\n"
      "probe: species of the particle; None where there is one. diameter, diameters: of the particle and of the fluid, (N,), for\n"
      "models whose particles have them.\n\nRaises InputError.");
  define_search<&Inserter::find>(
      type, "find",
      "`count` independent searches for positions at which the energy rises by `energy`: a list of\n"
      "InsertedParticle. tolerance: of the error by `measure`, relative, absolute or running-mean. method: usher,\n"
      "usher-indirect, usher-near, screened or descent. largest_step: 0 for the published optimum.\n"
      "most_trials: of each search. region: low and high corner, (2, 3); None: the whole box.\n\nRaises InputError.");
  define_search<&Inserter::insert>(type, "insert", "As find, one after the other: each particle becomes part of the fluid.");
  type.def("energy", &energy, "position"_a, "What the fluid's energy rises by with a particle there. position: (3,).")
      .def("energy_and_force", &energy_and_force, "position"_a, "(energy, force on the particle, (3,)).")
      .def("energies", &energies, "positions"_a, "out"_a = nb::none(),
           "Of many positions, (M, 3): (M,), written to `out` if it is given.")
      .def(
          "add",
          [](BoundInserter& self, ArrayLike position) {
            const auto point = point_of(position, "position");
            unlocked(self.lock, [&] { self.object.add(point); });
          },
          "position"_a, "Puts a particle of the probe's species there.")
      .def(
          "remove",
          [](BoundInserter& self, ArrayLike position) {
            const auto point = point_of(position, "position");
            return unlocked(self.lock, [&] { return self.object.remove(point); });
          },
          "position"_a, "Takes a particle of the probe's species away; whether there was one.")
      .def_prop_ro("particles", [](const BoundInserter& self) { return self.object.particles(); }, "Of the fluid.");
}

}  // namespace lanescape::python
