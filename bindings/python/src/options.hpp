#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <string>

#include <lanescape/path.hpp>

#include "arguments.hpp"

namespace lanescape::python {

// Keyword arguments of a function, by their names.
class Options {
 public:
  Options(const nb::dict& given, const char* function) : given_(given), function_(function) {}

  // Into `member`, which keeps its value where the option is not among those given. TypeError for another type.
  template <class Member>
  void take(const char* name, Member& member) const {
    if (given_.contains(name) && !nb::try_cast(nb::object(given_[name]), member))
      throw nb::type_error(
          (std::string(function_) + ": " + name + " cannot be " + text(nb::repr(nb::object(given_[name])))).c_str());
  }
  nb::object at(const char* name) const { return given_.contains(name) ? nb::object(given_[name]) : nb::none(); }

 private:
  const nb::dict& given_;
  const char* function_;
};

// How a path is searched; `method` is the name of the option for the path method.
PathSettings path_settings_of(const Options& options, const char* method);
// (F, N, 3).
Array frames_of(const std::vector<std::vector<double>>& frames);

}  // namespace lanescape::python
