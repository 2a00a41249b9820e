#include "python_landscape.hpp"

#include <algorithm>
#include <string>

#include "arguments.hpp"
#include "bound_landscapes.hpp"

namespace lanescape::python {
namespace {

double number_of(const nb::object& energy) {
  const double number = PyFloat_AsDouble(energy.ptr());
  if (number == -1.0 && PyErr_Occurred() != nullptr) throw nb::python_error();
  return number;
}

}  // namespace

PythonLandscape::PythonLandscape(nb::handle given, std::size_t particles) : particles_(particles) {
  const nb::object callable = nb::module_::import_("builtins").attr("callable");
  if (nb::hasattr(given, "energy_and_gradient")) {
    both_ = given.attr("energy_and_gradient");
    if (nb::hasattr(given, "energy")) energy_ = given.attr("energy");
  } else {
    both_ = nb::borrow(given);
  }
  if (!nb::cast<bool>(callable(both_)) || (energy_.is_valid() && !nb::cast<bool>(callable(energy_))))
    throw nb::type_error(
        "landscape: a Potential, a StateSystem, an object with energy(R) and energy_and_gradient(R) or a function of R that "
        "returns "
        "(energy, gradient) is needed");
}

double PythonLandscape::energy(std::span<const double> positions) {
  const nb::gil_scoped_acquire interpreter;
  const nb::object array = new_array(positions, {particles_, 3});
  return number_of(energy_.is_valid() ? energy_(array) : nb::object(both_(array)[0]));
}

double PythonLandscape::energy_and_gradient(std::span<const double> positions, std::span<double> gradient) {
  const nb::gil_scoped_acquire interpreter;
  const nb::object answer = both_(new_array(positions, {particles_, 3}));
  if (!PyTuple_Check(answer.ptr()) || nb::len(answer) != 2) throw nb::type_error("landscape: (energy, gradient) is to be returned");
  const Numbers values = Numbers::vectors(answer[1], "landscape: gradient");
  if (values.rows() != particles_)
    throw Error(ErrorCode::bad_input, "landscape: the gradient has " + std::to_string(values.rows()) +
                                          " rows: " + std::to_string(particles_) + " are needed");
  std::copy(values.values().begin(), values.values().end(), gradient.begin());
  return number_of(answer[0]);
}

HeldLandscape::HeldLandscape(nb::handle by_user, std::size_t particles) : given(nb::borrow(by_user)) {
  if (BoundPotential* potential = nullptr; nb::try_cast(given, potential) && potential != nullptr) {
    landscape = &potential->object;
    lock = &potential->lock;
  } else if (BoundStates* system = nullptr; nb::try_cast(given, system) && system != nullptr) {
    landscape = &system->object;
    lock = &system->lock;
  } else {
    in_python = std::make_unique<PythonLandscape>(by_user, particles);
    landscape = in_python.get();
  }
}

}  // namespace lanescape::python
