#include <lanescape/hard_spheres.hpp>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>

#include "arguments.hpp"
#include "guarded.hpp"
#include "module.hpp"

namespace lanescape::python {
namespace {

struct SphereParameters {
  std::vector<double> radii;
  std::array<double, 3> box;
  std::string instruction_set;
  double skin;
};

struct BoundSpheres : Guarded<HardSpheres> {
  explicit BoundSpheres(SphereParameters with)
      : Guarded<HardSpheres>(with.radii, with.box, HardSpheres::Options{with.instruction_set, with.skin}),
        parameters(std::move(with)) {}
  SphereParameters parameters;
};

void make(BoundSpheres* self, ArrayLike radii, ArrayLike box, const std::string& instruction_set, double skin) {
  if (radii.is_none()) throw nb::type_error("radii: one for each sphere is needed");
  new (self) BoundSpheres(SphereParameters{Numbers::list(radii, "radii").copy(), box_of(box), instruction_set, skin});
}

bool any_overlap(BoundSpheres& self, ArrayLike positions) {
  const Numbers given = Numbers::vectors(positions, "positions");
  return unlocked(self.lock, [&] { return self.object.any_overlap(given.values()); });
}

nb::typed<nb::tuple, Array, Array> overlaps(BoundSpheres& self, ArrayLike positions) {
  const Numbers given = Numbers::vectors(positions, "positions");
  std::vector<std::int64_t> pairs;
  std::vector<double> gaps;
  unlocked(self.lock, [&] {
    for (const Overlap& overlap : self.object.overlaps(given.values())) {
      pairs.insert(pairs.end(), {overlap.first, overlap.second});
      gaps.push_back(overlap.gap);
    }
  });
  return nb::make_tuple(new_array(std::span<const std::int64_t>(pairs), {gaps.size(), 2}), new_list(gaps));
}

double smallest_gap(BoundSpheres& self, ArrayLike positions) {
  const Numbers given = Numbers::vectors(positions, "positions");
  return unlocked(self.lock, [&] { return self.object.smallest_gap(given.values()); });
}

nb::tuple state(const BoundSpheres& self) {
  const auto& [radii, box, instruction_set, skin] = self.parameters;
  return nb::make_tuple(new_list(radii), new_list(box), instruction_set, skin);
}

}  // namespace

void bind_hard_spheres(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<BoundSpheres>(
      module, "HardSpheres",
      "Overlaps of hard spheres in a periodic orthorhombic box. Touching is not overlapping; decisions are exact.\n"
      "Threads may share an object. Pickles by its parameters.")
      .def("__init__", &make, "radii"_a, "box"_a, nb::kw_only(), "instruction_set"_a = "auto", "skin"_a = 0.0,
           "radii: (N,). box: edges, (3,), at least two of the largest diameters. skin: above 0, any_overlap() keeps a list of "
           "pairs with\n"
           "gaps below `skin` smallest diameters, for configurations that follow each other in small steps.\n\nRaises InputError.")
      .def("any_overlap", &any_overlap, "positions"_a, "Whether two spheres overlap. positions: (N, 3), wrapped or not.")
      .def("overlaps", &overlaps, "positions"_a,
           "All overlapping pairs: (i, j), int64 of shape (K, 2) with i < j in rising order, and gaps r_ij - s_ij < 0 of shape "
           "(K,).")
      .def("smallest_gap", &smallest_gap, "positions"_a, "The smallest r_ij - s_ij; infinity for a single sphere.")
      .def_prop_ro(
          "particles", [](const BoundSpheres& self) { return self.object.particles(); }, "N.")
      .def("__getstate__", &state)
      .def("__setstate__", [](BoundSpheres* self, const nb::tuple& kept) {
        check_state(kept, 4);
        make(self, kept[0], kept[1], nb::cast<std::string>(kept[2]), nb::cast<double>(kept[3]));
      });
}

}  // namespace lanescape::python
