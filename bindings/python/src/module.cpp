#include "module.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <lanescape/lanescape.hpp>

NB_MODULE(_core, module) {
  using namespace lanescape::python;
  nanobind::set_leak_warnings(false);  // an object that lives when the interpreter ends is no fault of the user's
  module.doc() = "The compiled part of lanescape; see there.";
  module.attr("__version__") = lanescape::version();
  bind_errors(module);
  bind_models(module);
  bind_potentials(module);
  bind_particle_moves(module);
  bind_hard_spheres(module);
  bind_states(module);
  bind_insertion(module);
  bind_dynamics(module);
  bind_event_driven(module);
  bind_end_points(module);
  bind_paths(module);
  bind_shortening(module);
  bind_neighbours(module);
  module.def("shorten_methods", &lanescape::shorten_method_names, "Words for the method of shorten_path, the default first.");
  module.def("instruction_sets", &lanescape::instruction_sets, "Instruction sets that this processor has, best last.");
}
