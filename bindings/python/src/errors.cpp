#include <nanobind/nanobind.h>

#include <lanescape/error.hpp>

#include <typeinfo>

#include "module.hpp"

namespace lanescape::python {

// lanescape.errors has the classes of exceptions: bad input is a ValueError, the rest a RuntimeError.
void bind_errors(nanobind::module_&) {
  nanobind::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const std::bad_cast&) {
      PyErr_SetString(PyExc_TypeError, "an argument, or a member of a state, is of another type than is needed");
    } catch (const Error& error) {
      const nanobind::object type =
          nanobind::module_::import_("lanescape.errors").attr(error.code() == ErrorCode::bad_input ? "InputError" : "RunError");
      PyErr_SetString(type.ptr(), error.what());
    }
  });
}

}  // namespace lanescape::python
