#include <nanobind/nanobind.h>

#include <lanescape/error.hpp>

#include <typeinfo>

#include "module.hpp"

namespace lanescape::python {
namespace {

const char* class_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_input:
      return "InputError";
    case ErrorCode::interrupted:
      return "InterruptedRunError";
    default:
      return "RunError";
  }
}

}  // namespace

// lanescape.errors has the classes of exceptions: bad input is a ValueError, the rest a RuntimeError.
void bind_errors(nanobind::module_&) {
  nanobind::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const std::bad_cast&) {
      PyErr_SetString(PyExc_TypeError, "an argument, or a member of a state, is of another type than is needed");
    } catch (const Error& error) {
      const nanobind::object type = nanobind::module_::import_("lanescape.errors").attr(class_of(error.code()));
      PyErr_SetString(type.ptr(), error.what());
    }
  });
}

}  // namespace lanescape::python
