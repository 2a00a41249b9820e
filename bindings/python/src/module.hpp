#pragma once

#include <nanobind/nanobind.h>

namespace lanescape::python {

// The parts of the module, a file for each.
void bind_errors(nanobind::module_& module);
void bind_models(nanobind::module_& module);
void bind_potentials(nanobind::module_& module);
void bind_particle_moves(nanobind::module_& module);
void bind_hard_spheres(nanobind::module_& module);
void bind_states(nanobind::module_& module);
void bind_insertion(nanobind::module_& module);
void bind_dynamics(nanobind::module_& module);
void bind_event_driven(nanobind::module_& module);
void bind_end_points(nanobind::module_& module);
void bind_paths(nanobind::module_& module);
void bind_shortening(nanobind::module_& module);
void bind_neighbours(nanobind::module_& module);

}  // namespace lanescape::python
