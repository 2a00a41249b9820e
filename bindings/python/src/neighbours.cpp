#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <lanescape/neighbours.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arguments.hpp"
#include "guarded.hpp"
#include "module.hpp"

namespace lanescape::python {
namespace {

using Arrays = nb::typed<nb::tuple, Array, nb::ellipsis>;
using Excluded = std::pair<std::int64_t, std::int64_t>;

constexpr const char* all_quantities = "ijSDds";

// The arrays that a call returns are the finder's memory. Each holds the finder, so that they outlive this object; a call that
// finds some still held takes another finder.
class NeighbourList {
 public:
  explicit NeighbourList(NeighbourFinder::Options options) : options_(std::move(options)) { NeighbourFinder check(options_); }

  Arrays compute(ArrayLike points, ArrayLike box, nb::handle periodic, const std::string& quantities, ArrayLike species);
  Arrays compute_around(ArrayLike queries, ArrayLike points, ArrayLike box, nb::handle periodic, const std::string& quantities,
                        ArrayLike query_species, ArrayLike species);
  // Pairs that are never listed.
  void exclude(std::vector<Excluded> pairs);
  Array exclusions() const;
  nb::tuple state() const;

 private:
  void prepare(const NeighbourFinder::Options& wanted);

  NeighbourFinder::Options options_;
  std::vector<Excluded> exclusions_;
  std::shared_ptr<NeighbourFinder> finder_;
  Lock lock_;
};

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::bad_input, message); }

// Edges, (3,), or the matrix of an orthorhombic cell.
std::array<double, 3> cell_of(nb::handle given) {
  const nb::object array = nb::module_::import_("numpy").attr("asarray")(given);
  if (nb::cast<std::size_t>(array.attr("ndim")) != 2) return box_of(array);
  const Numbers rows = Numbers::vectors(array, "box");
  if (rows.rows() != 3) refuse("box: shape (3,) or (3, 3) is needed");
  constexpr double rounding = 1e-12;
  const double largest = std::max({rows.values()[0], rows.values()[4], rows.values()[8]});
  for (std::size_t k = 0; k < 9; ++k)
    if (k % 4 != 0 && !(std::abs(rows.values()[k]) <= rounding * largest))
      refuse("box: the cell is not orthorhombic: edges along x, y and z are needed");
  return {rows.values()[0], rows.values()[4], rows.values()[8]};
}

std::array<bool, 3> periodic_of(nb::handle given) {
  const nb::object axes = nb::module_::import_("numpy").attr("ravel")(given).attr("tolist")();
  const std::size_t count = nb::len(axes);
  if (count != 1 && count != 3) refuse("periodic: one value or one for each axis is needed, not " + std::to_string(count));
  std::array<bool, 3> periodic{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const nb::object one = axes[count == 1 ? 0 : axis];
    if (!nb::isinstance<nb::bool_>(one) && !nb::isinstance<nb::int_>(one))
      throw nb::type_error("periodic: True or False is needed");
    periodic[axis] = nb::cast<bool>(nb::bool_(one));
  }
  return periodic;
}

NeighbourFinder::Quantities quantities_of(const std::string& words) {
  for (const char c : words)
    if (std::string(all_quantities).find(c) == std::string::npos)
      refuse(std::string("quantities: '") + c + "' is not allowed: i, j, S, D, d and s are");
  const auto has = [&](char c) { return words.find(c) != std::string::npos; };
  return {has('i'), has('j'), has('S'), has('D'), has('d'), has('s')};
}

template <class Number>
nb::object view(const std::shared_ptr<NeighbourFinder>& finder, std::span<const Number> numbers, std::size_t columns) {
  auto* kept = new std::shared_ptr<NeighbourFinder>(finder);
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::shared_ptr<NeighbourFinder>*>(p); });
  const std::size_t shape[2] = {numbers.size() / columns, columns};
  return nb::cast(nb::ndarray<nb::numpy, Number>(const_cast<Number*>(numbers.data()), columns == 1 ? 1 : 2, shape, owner));
}

Arrays arrays_of(const std::shared_ptr<NeighbourFinder>& finder, const NeighbourFinder::Pairs& pairs,
                 const std::string& quantities) {
  nb::list arrays;
  for (const char c : quantities) {
    if (c == 'i') arrays.append(view(finder, pairs.i, 1));
    if (c == 'j') arrays.append(view(finder, pairs.j, 1));
    if (c == 'S') arrays.append(view(finder, pairs.S, 3));
    if (c == 'D') arrays.append(view(finder, pairs.D, 3));
    if (c == 'd') arrays.append(view(finder, pairs.d, 1));
    if (c == 's') arrays.append(view(finder, pairs.segments, 1));
  }
  return nb::tuple(arrays);
}

std::vector<std::int32_t> kinds_of(ArrayLike species) {
  std::vector<std::int32_t> kinds;
  if (!species.is_none())
    for (const std::int64_t s : integers_of(species, "species")) kinds.push_back(s < 0 || s > 1'000'000 ? -1 : static_cast<int>(s));
  return kinds;
}

void NeighbourList::prepare(const NeighbourFinder::Options& wanted) {
  const auto same = [](const NeighbourFinder::Quantities& a, const NeighbourFinder::Quantities& b) {
    return a.i == b.i && a.j == b.j && a.S == b.S && a.D == b.D && a.d == b.d && a.segments == b.segments;
  };
  if (finder_ && finder_.use_count() == 1 && wanted.periodic == options_.periodic && same(wanted.quantities, options_.quantities))
    return;
  finder_ = std::make_shared<NeighbourFinder>(wanted);
  finder_->exclude(exclusions_);
  options_ = wanted;
}

void NeighbourList::exclude(std::vector<Excluded> pairs) {
  unlocked(lock_, [&] {
    NeighbourFinder(options_).exclude(pairs);
    exclusions_ = std::move(pairs);
    finder_.reset();
  });
}

Array NeighbourList::exclusions() const {
  std::vector<std::int64_t> indices;
  for (const auto& [i, j] : exclusions_) indices.insert(indices.end(), {i, j});
  return new_array(std::span<const std::int64_t>(indices), {exclusions_.size(), 2});
}

std::vector<Excluded> excluded_of(ArrayLike given) {
  std::vector<Excluded> pairs;
  for (const auto& [i, j] : pairs_of(given, "exclusions")) pairs.emplace_back(i, j);
  return pairs;
}

Arrays NeighbourList::compute(ArrayLike points, ArrayLike box, nb::handle periodic, const std::string& quantities,
                              ArrayLike species) {
  const Numbers given = Numbers::vectors(points, "points");
  const auto edges = cell_of(box);
  const std::vector<std::int32_t> kinds = kinds_of(species);
  NeighbourFinder::Options wanted = options_;
  wanted.periodic = periodic_of(periodic);
  wanted.quantities = quantities_of(quantities);
  std::shared_ptr<NeighbourFinder> finder;
  const NeighbourFinder::Pairs pairs = unlocked(lock_, [&] {
    prepare(wanted);
    finder = finder_;
    return finder_->find(given.values(), edges, kinds);
  });
  return arrays_of(finder, pairs, quantities);
}

Arrays NeighbourList::compute_around(ArrayLike queries, ArrayLike points, ArrayLike box, nb::handle periodic,
                                     const std::string& quantities, ArrayLike query_species, ArrayLike species) {
  const Numbers around = Numbers::vectors(queries, "queries"), given = Numbers::vectors(points, "points");
  const auto edges = cell_of(box);
  const std::vector<std::int32_t> query_kinds = kinds_of(query_species), kinds = kinds_of(species);
  NeighbourFinder::Options wanted = options_;
  wanted.periodic = periodic_of(periodic);
  wanted.quantities = quantities_of(quantities);
  std::shared_ptr<NeighbourFinder> finder;
  const NeighbourFinder::Pairs pairs = unlocked(lock_, [&] {
    prepare(wanted);
    finder = finder_;
    finder_->set_particles(given.values(), edges, kinds);
    return finder_->neighbours(around.values(), query_kinds);
  });
  return arrays_of(finder, pairs, quantities);
}

NeighbourFinder::Options options_of(ArrayLike cutoff, bool full_list, bool sorted, int threads,
                                    const std::string& instruction_set) {
  NeighbourFinder::Options options;
  const nb::object numbers = nb::module_::import_("numpy").attr("ravel")(cutoff);
  options.cutoffs = Numbers::list(numbers, "cutoff").copy();
  options.members = full_list ? NeighbourFinder::Members::full : NeighbourFinder::Members::half;
  options.order = sorted ? NeighbourFinder::Order::sorted : NeighbourFinder::Order::any;
  options.threads = threads_of(threads);
  options.instruction_set = instruction_set;
  return options;
}

nb::tuple NeighbourList::state() const {
  return nb::make_tuple(new_list(options_.cutoffs), options_.members == NeighbourFinder::Members::full,
                        options_.order == NeighbourFinder::Order::sorted, options_.threads, options_.instruction_set, exclusions());
}

}  // namespace

void bind_neighbours(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<NeighbourList>(module, "NeighbourList",
                            "Pairs of particles within a cutoff, in orthorhombic boxes with periodic or open axes, with ASE's "
                            "conventions. The signature is\n"
                            "vesin's. An object keeps its memory where the arrays of the last call are gone. Threads may share it. "
                            "Pickles by its parameters.")
      .def(
          "__init__",
          [](NeighbourList* self, ArrayLike cutoff, bool full_list, bool sorted, int threads, const std::string& instruction_set) {
            new (self) NeighbourList(options_of(cutoff, full_list, sorted, threads, instruction_set));
          },
          "cutoff"_a, "full_list"_a = true, "sorted"_a = false, nb::kw_only(), "threads"_a = 1, "instruction_set"_a = "auto",
          "cutoff: a number, or a symmetric (S, S) matrix for S species, where 0 means that such pairs are never listed.\n"
          "full_list: (i, j, S) and (j, i, -S), or one of the two. sorted: by i, j and S.\n\nRaises InputError.")
      .def("compute", &NeighbourList::compute, "points"_a, "box"_a, "periodic"_a = true, "quantities"_a = "ijSDd",
           "species"_a = nb::none(),
           "A tuple of arrays, one for each letter of quantities, P pairs: i, j (P,) int64; S (P, 3) int32, whole boxes; D (P, 3) "
           "and\n"
           "d (P,), r_j - r_i + S . box and its length; s (N + 1,) int64, the first pair of each i and P (sorted lists only).\n"
           "points: (N, 3), wrapped or not. box: edges, (3,), or the matrix of a cell, orthorhombic to 1e-12 of its largest edge. "
           "periodic: for all axes or "
           "each.\n"
           "species: (N,), from 0, where cutoff is a matrix.\n\nRaises InputError.")
      .def("compute_around", &NeighbourList::compute_around, "queries"_a, "points"_a, "box"_a, "periodic"_a = true,
           "quantities"_a = "ijSDd", "query_species"_a = nb::none(), "species"_a = nb::none(),
           "As compute, of other points: i numbers the queries, (M, 3), and j the points. All of them within the cutoff, whatever\n"
           "full_list and exclusions say.\n\nRaises InputError.")
      .def_prop_rw(
          "exclusions", &NeighbourList::exclusions, [](NeighbourList& self, ArrayLike pairs) { self.exclude(excluded_of(pairs)); },
          "Pairs (i, j) that are never listed in either direction, such as bonded ones, (K, 2), int64.")
      .def("__getstate__", &NeighbourList::state)
      .def("__setstate__", [](NeighbourList* self, const nb::tuple& kept) {
        check_state(kept, 6);
        new (self) NeighbourList(options_of(kept[0], nb::cast<bool>(kept[1]), nb::cast<bool>(kept[2]), nb::cast<int>(kept[3]),
                                            nb::cast<std::string>(kept[4])));
        self->exclude(excluded_of(kept[5]));
      });
}

}  // namespace lanescape::python
