#include "arguments.hpp"

#include <nanobind/stl/string.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace lanescape::python {
namespace {

using AnyNumbers = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::bad_input, message); }

std::string shape_text(const auto& array) {
  std::string shape = "(";
  for (std::size_t k = 0; k < array.ndim(); ++k) shape += (k == 0 ? "" : ", ") + std::to_string(array.shape(k));
  return shape + (array.ndim() == 1 ? ",)" : ")");
}

// An array of numpy's whose dtype is of one of these kinds.
nb::object numpy_array(nb::handle given, const char* what, const char* kinds, const char* needed) {
  const nb::object array = nb::module_::import_("numpy").attr("asarray")(given);
  const auto kind = nb::cast<std::string>(array.attr("dtype").attr("kind"));
  if (std::string(kinds).find(kind) == std::string::npos)
    throw nb::type_error((std::string(what) + ": " + (given.is_none() ? "None" : "dtype " + text(array.attr("dtype"))) +
                          " is not allowed: " + needed + " are needed")
                             .c_str());
  return array;
}

AnyNumbers numbers_of(nb::handle given, const char* what) {
  AnyNumbers numbers;
  if (nb::try_cast(given, numbers, false)) return numbers;
  const nb::object array = numpy_array(given, what, "fiu", "real numbers");
  return nb::cast<AnyNumbers>(nb::module_::import_("numpy").attr("ascontiguousarray")(array, "float64"));
}

template <class Number>
Array copied(std::span<const Number> values, std::vector<std::size_t> shape) {
  auto memory = std::make_unique<Number[]>(values.size());
  std::copy(values.begin(), values.end(), memory.get());
  Number* data = memory.release();
  const nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<Number*>(p); });
  return nb::steal<Array>(nb::cast(nb::ndarray<nb::numpy, Number>(data, shape.size(), shape.data(), owner)).release());
}

}  // namespace

std::string text(nb::handle object) { return nb::cast<std::string>(nb::str(object)); }

int threads_of(int given) {
  if (given < 1) refuse("threads: " + std::to_string(given) + " is not allowed: at least 1 is needed");
  return given;
}

Numbers Numbers::vectors(nb::handle given, const char* what) {
  Numbers numbers;
  numbers.array_ = numbers_of(given, what);
  if (numbers.array_.ndim() != 2 || numbers.array_.shape(1) != 3)
    refuse(std::string(what) + ": shape " + shape_text(numbers.array_) + " is not allowed: (N, 3) is needed");
  return numbers;
}

Numbers Numbers::list(nb::handle given, const char* what) {
  Numbers numbers;
  if (given.is_none()) return numbers;
  numbers.array_ = numbers_of(given, what);
  if (numbers.array_.ndim() != 1)
    refuse(std::string(what) + ": shape " + shape_text(numbers.array_) + " is not allowed: (N,) is needed");
  return numbers;
}

Numbers Numbers::frames(nb::handle given, const char* what) {
  Numbers numbers;
  if (given.is_none()) return numbers;
  numbers.array_ = numbers_of(given, what);
  if (numbers.array_.ndim() != 3 || numbers.array_.shape(2) != 3)
    refuse(std::string(what) + ": shape " + shape_text(numbers.array_) + " is not allowed: (F, N, 3) is needed");
  return numbers;
}

std::vector<std::vector<double>> Numbers::parts() const {
  std::vector<std::vector<double>> parts;
  const std::size_t length = rows() == 0 ? 0 : array_.size() / rows();
  for (std::size_t k = 0; k < rows(); ++k) {
    const auto part = values().subspan(k * length, length);
    parts.emplace_back(part.begin(), part.end());
  }
  return parts;
}

Room Room::vectors(nb::handle given, std::size_t rows, const char* what) { return {given, {rows, 3}, what}; }
Room Room::list(nb::handle given, std::size_t rows, const char* what) { return {given, {rows}, what}; }

Room::Room(nb::handle given, std::vector<std::size_t> shape, const char* what) {
  size_ = 1;
  for (const std::size_t extent : shape) size_ *= extent;
  if (given.is_none()) {
    auto memory = std::make_unique<double[]>(size_);
    data_ = memory.release();
    const nb::capsule owner(data_, [](void* p) noexcept { delete[] static_cast<double*>(p); });
    array_ = nb::steal<Array>(nb::cast(nb::ndarray<nb::numpy, double>(data_, shape.size(), shape.data(), owner)).release());
    return;
  }
  nb::ndarray<double, nb::c_contig, nb::device::cpu> array;
  if (!nb::try_cast(given, array, false))
    throw nb::type_error((std::string(what) + ": a writable array of float64 in C order is needed").c_str());
  bool same = array.ndim() == shape.size();
  for (std::size_t k = 0; same && k < shape.size(); ++k) same = array.shape(k) == shape[k];
  if (!same)
    refuse(std::string(what) + ": shape " + shape_text(array) + " is not allowed: (" + std::to_string(shape[0]) +
           (shape.size() == 1 ? ",)" : ", 3)") + " is needed");
  array_ = nb::borrow<Array>(given);
  data_ = array.data();
}

std::array<double, 3> box_of(nb::handle given) {
  const Numbers edges = Numbers::list(given, "box");
  if (edges.rows() != 3) refuse("box: " + std::to_string(edges.rows()) + " numbers were given: three edges are needed");
  return {edges.values()[0], edges.values()[1], edges.values()[2]};
}

std::array<double, 3> point_of(nb::handle given, const char* what) {
  const Numbers numbers = Numbers::list(given, what);
  if (numbers.rows() != 3)
    refuse(std::string(what) + ": " + std::to_string(numbers.rows()) + " numbers were given: x, y and z are needed");
  return {numbers.values()[0], numbers.values()[1], numbers.values()[2]};
}

std::vector<int> species_of(const Model& model, nb::handle given, std::size_t particles) {
  if (given.is_none()) {
    if (model.species_count() != 1)
      refuse("species: None is not allowed: model " + model.name() + " has " + std::to_string(model.species_count()) +
             " species, so that one for each particle is needed");
    return std::vector<int>(particles, 0);
  }
  std::vector<int> species;
  if (nb::isinstance<nb::str>(given)) throw nb::type_error("species: one for each particle is needed, not a single name");
  const nb::object array = numpy_array(given, "species", "iuUO", "names or indices of species");
  if (nb::cast<std::size_t>(array.attr("ndim")) != 1) refuse("species: an array of shape (N,) is needed");
  for (const nb::handle one : nb::list(array.attr("tolist")())) {
    if (nb::isinstance<nb::str>(one)) {
      species.push_back(model.find_species(nb::cast<std::string>(one)));
      continue;
    }
    long long index = 0;
    if (!nb::isinstance<nb::int_>(one)) throw nb::type_error("species: names or indices of species are needed");
    if (!nb::try_cast(one, index, false) || index < 0 || static_cast<std::size_t>(index) >= model.species_count())
      refuse("species: " + text(one) + " is not allowed: model " + model.name() + " has the indices 0 to " +
             std::to_string(model.species_count() - 1));
    species.push_back(static_cast<int>(index));
  }
  return species;
}

std::vector<std::int64_t> integers_of(nb::handle given, const char* what) {
  const nb::object array =
      nb::module_::import_("numpy").attr("ascontiguousarray")(numpy_array(given, what, "iu", "integers"), "int64");
  const auto numbers = nb::cast<nb::ndarray<const std::int64_t, nb::c_contig, nb::device::cpu>>(array);
  if (numbers.ndim() != 1) refuse(std::string(what) + ": shape " + shape_text(numbers) + " is not allowed: (N,) is needed");
  return {numbers.data(), numbers.data() + numbers.size()};
}

std::vector<std::array<std::int64_t, 2>> pairs_of(nb::handle given, const char* what) {
  const nb::object array = nb::module_::import_("numpy").attr("asarray")(given);
  if (nb::cast<std::size_t>(array.attr("size")) == 0) return {};
  if (nb::cast<std::size_t>(array.attr("ndim")) != 2 || nb::cast<std::size_t>(array.attr("shape")[1]) != 2)
    refuse(std::string(what) + ": an array of shape (K, 2) is needed");
  const std::vector<std::int64_t> indices = integers_of(array.attr("ravel")(), what);
  std::vector<std::array<std::int64_t, 2>> pairs(indices.size() / 2);
  for (std::size_t k = 0; k < indices.size(); ++k) pairs[k / 2][k % 2] = indices[k];
  return pairs;
}

Progress progress_of(nb::object given) {
  if (!given.is_none() && !nb::bool_(nb::module_::import_("builtins").attr("callable")(given)))
    throw nb::type_error("progress: a function of the part done is needed");
  // The function lives as long as the call; copies of it are made and destroyed without the interpreter's lock.
  return [function = given.ptr()](double done) {
    const nb::gil_scoped_acquire interpreter;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (function == Py_None) return true;
    const nb::object answer = nb::borrow<nb::callable>(function)(done);
    return answer.is_none() || nb::cast<bool>(nb::bool_(answer));
  };
}

void check_state(const nb::tuple& kept, std::size_t members) {
  if (nb::len(kept) != members)
    throw nb::type_error(
        ("this is no state of such an object: it has " + std::to_string(nb::len(kept)) + " members, not " + std::to_string(members))
            .c_str());
}

Array new_array(std::span<const double> values, std::vector<std::size_t> shape) { return copied(values, std::move(shape)); }
Array new_array(std::span<const std::int64_t> values, std::vector<std::size_t> shape) { return copied(values, std::move(shape)); }

Array new_list(std::span<const double> values) { return copied(values, {values.size()}); }
Array new_list(std::span<const std::int64_t> values) { return copied(values, {values.size()}); }
Array new_vectors(std::span<const double> values) { return copied(values, {values.size() / 3, 3}); }
nb::object new_list_or_none(std::span<const double> values) { return values.empty() ? nb::object(nb::none()) : new_list(values); }

nb::object new_result(const char* name, const nb::dict& members) {
  return nb::module_::import_("lanescape.results").attr(name)(**members);
}

}  // namespace lanescape::python
