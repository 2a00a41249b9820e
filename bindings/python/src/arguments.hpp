#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <lanescape/dynamics.hpp>
#include <lanescape/model.hpp>

namespace lanescape::python {

namespace nb = nanobind;

// What numpy makes an array of: no more than a name in signatures.
struct ArrayLike : nb::handle {
  static constexpr auto Name = nb::detail::const_name("numpy.typing.ArrayLike");
  static bool check_(nb::handle) { return true; }

  ArrayLike() = default;
  ArrayLike(nb::handle given) : nb::handle(given) {}
  ArrayLike(nb::handle given, nb::detail::steal_t) : nb::handle(given) {}  // nanobind's; it borrows
  template <class Derived>
  ArrayLike(const nb::detail::api<Derived>& given) : nb::handle(given.derived().ptr()) {}
};

// An object of a class that Python defines, so that signatures name the class. It may be null.
inline bool of_any_class(PyObject*) { return true; }
template <std::size_t size>
struct ClassName {
  constexpr ClassName(const char (&name)[size]) { std::copy_n(name, size, text); }
  char text[size]{};
};
template <ClassName name>
class PythonObject : public nb::object {
  NB_OBJECT_DEFAULT(PythonObject, nb::object, name.text, of_any_class)
};
using Array = PythonObject<"numpy.ndarray">;
using EvaluationObject = PythonObject<"lanescape.results.Evaluation">;
using StartObject = PythonObject<"lanescape.results.Start">;
using EndPointsObject = PythonObject<"lanescape.results.EndPoints">;
using PathObject = PythonObject<"lanescape.results.Path">;
using ShortPathObject = PythonObject<"lanescape.results.ShortPath">;
using PathCertificateObject = PythonObject<"lanescape.results.PathCertificate">;
using InsertedParticleObject = PythonObject<"lanescape.results.InsertedParticle">;

// Numbers of a caller. Arrays of float64 in C order are taken as they are; others are converted once. TypeError for what holds no
// real numbers, Error(bad_input) for another shape. `what` names the argument in messages.
class Numbers {
 public:
  static Numbers vectors(nb::handle given, const char* what);  // (N, 3)
  static Numbers list(nb::handle given, const char* what);     // (N,); None: empty
  static Numbers frames(nb::handle given, const char* what);   // (F, N, 3); None: empty

  std::span<const double> values() const { return {array_.data(), array_.size()}; }
  std::size_t rows() const { return array_.ndim() == 0 ? 0 : array_.shape(0); }
  // Along its first axis.
  std::vector<std::vector<double>> parts() const;
  std::vector<double> copy() const { return {values().begin(), values().end()}; }

 private:
  nb::ndarray<const double, nb::c_contig, nb::device::cpu> array_;
};

// Room for results: the caller's array, which is float64, in C order and writable, or a new one for None.
class Room {
 public:
  static Room vectors(nb::handle given, std::size_t rows, const char* what);  // (N, 3)
  static Room list(nb::handle given, std::size_t rows, const char* what);     // (N,)

  std::span<double> values() { return {data_, size_}; }
  const Array& array() const { return array_; }

 private:
  Room(nb::handle given, std::vector<std::size_t> shape, const char* what);

  Array array_;
  double* data_ = nullptr;
  std::size_t size_ = 0;
};

// str(object).
std::string text(nb::handle object);
// A number of threads, at least 1.
int threads_of(int given);
// Three edges.
std::array<double, 3> box_of(nb::handle given);
// x, y and z.
std::array<double, 3> point_of(nb::handle given, const char* what);
// Pairs of particles, (K, 2).
std::vector<std::array<std::int64_t, 2>> pairs_of(nb::handle given, const char* what);
// Names or indices of a model's species, N; None where the model has one species.
std::vector<int> species_of(const Model& model, nb::handle given, std::size_t particles);
// Integers of a caller, (N,).
std::vector<std::int64_t> integers_of(nb::handle given, const char* what);
// A caller's function of the part done. It is called, and signals are looked after, from the thread that called the library.
Progress progress_of(nb::object given);

// TypeError unless the state of a pickle has that many members, which Python's tuples do not check.
void check_state(const nb::tuple& kept, std::size_t members);

// Copies in arrays of numpy's, of a shape, (N,), and (N, 3).
Array new_array(std::span<const double> values, std::vector<std::size_t> shape);
Array new_array(std::span<const std::int64_t> values, std::vector<std::size_t> shape);
Array new_list(std::span<const double> values);
Array new_list(std::span<const std::int64_t> values);
Array new_vectors(std::span<const double> values);
// None for no numbers.
nb::object new_list_or_none(std::span<const double> values);
// An object of the class `name` of lanescape.results.
nb::object new_result(const char* name, const nb::dict& members);
template <class Object>
Object new_result(const nb::dict& members) {
  return nb::steal<Object>(new_result(std::strrchr(Object::Name.text, '.') + 1, members).release());
}

}  // namespace lanescape::python
