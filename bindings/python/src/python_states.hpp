#pragma once

#include <nanobind/nanobind.h>

#include <memory>

#include <lanescape/states.hpp>

namespace lanescape::python {

namespace nb = nanobind;

// An order parameter and a response written in Python: objects with the methods of the classes below. Arrays are handed over as
// views, valid during the call. TypeError for objects that lack a method. The caller keeps the object alive.
std::shared_ptr<SiteOrderParameter> order_parameter_of(nb::handle given);
std::shared_ptr<SiteResponse> response_of(nb::handle given);

}  // namespace lanescape::python
