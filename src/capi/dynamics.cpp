#include <lanescape/dynamics.hpp>

#include <cstring>
#include <utility>

#include "capi/arguments.hpp"
#include "capi/callbacks.hpp"
#include "capi/potential.hpp"

namespace lanescape::capi {

// The dynamics refers to its landscape.
struct Trajectory {
  Trajectory(std::shared_ptr<Landscape> on, const double* masses, const double* positions, double time_step)
      : landscape(std::move(on)),
        dynamics(*landscape, optional_array(masses, landscape->particles(), "masses"),
                 vectors(positions, landscape->particles(), "positions"), time_step) {}

  std::shared_ptr<Landscape> landscape;
  MolecularDynamics dynamics;
};

struct Events {
  std::size_t particles;
  EventDrivenDynamics dynamics;
};

}  // namespace lanescape::capi

using namespace lanescape;
using namespace lanescape::capi;

namespace {

void save(const std::string& bytes, void* state, std::size_t capacity, std::size_t* needed) {
  given(needed, "needed") = bytes.size();
  if (capacity == 0) return;
  if (state == nullptr) refuse_null("state");
  std::memcpy(state, bytes.data(), std::min(capacity, bytes.size()));
}

std::string bytes_of(const void* state, std::size_t bytes) {
  const auto given = array(static_cast<const char*>(state), bytes, "state");
  return {given.begin(), given.end()};
}

template <class Dynamics>
void copy_vectors(const Dynamics& dynamics, double* positions, double* velocities) {
  if (positions != nullptr) copy_out(dynamics.positions(), positions);
  if (velocities != nullptr) copy_out(dynamics.velocities(), velocities);
}

}  // namespace

struct lanescape_dynamics : Handle<Trajectory> {};
struct lanescape_event_driven : Handle<Events> {};

lanescape_status lanescape_dynamics_create(lanescape_potential* potential, const double* masses, const double* positions,
                                           double time_step, lanescape_dynamics** dynamics) {
  return guarded([&] {
    create(dynamics, "dynamics", [&] {
      const auto landscape = std::make_shared<SharedLandscape>(shared_of(potential));
      return Trajectory(landscape, masses, positions, time_step);
    });
  });
}

lanescape_status lanescape_dynamics_create_on(const lanescape_landscape* landscape, const double* masses, const double* positions,
                                              double time_step, lanescape_dynamics** dynamics) {
  return guarded([&] {
    create(dynamics, "dynamics",
           [&] { return Trajectory(std::make_shared<CallbackLandscape>(landscape), masses, positions, time_step); });
  });
}

lanescape_status lanescape_dynamics_draw_velocities(lanescape_dynamics* dynamics, double temperature, uint64_t seed) {
  return alone(dynamics, "dynamics", [&](auto& d) { d.dynamics.draw_velocities(temperature, seed); });
}

lanescape_status lanescape_dynamics_set_velocities(lanescape_dynamics* dynamics, const double* velocities) {
  return alone(dynamics, "dynamics",
               [&](auto& d) { d.dynamics.set_velocities(vectors(velocities, d.landscape->particles(), "velocities")); });
}

lanescape_status lanescape_dynamics_run(lanescape_dynamics* dynamics, uint64_t steps) {
  return alone(dynamics, "dynamics", [&](auto& d) { d.dynamics.run(steps); });
}

lanescape_status lanescape_dynamics_describe(lanescape_dynamics* dynamics, lanescape_dynamics_report* report) {
  return alone(dynamics, "dynamics", [&](auto& d) {
    MolecularDynamics& moved = d.dynamics;
    auto& out = sized(report, "report", "lanescape_dynamics_report");
    out = {out.size, moved.steps(), moved.temperature(), moved.kinetic_energy(), moved.potential_energy()};
  });
}

lanescape_status lanescape_dynamics_get(const lanescape_dynamics* dynamics, double* positions, double* velocities) {
  return alone(dynamics, "dynamics", [&](auto& d) { copy_vectors(d.dynamics, positions, velocities); });
}

lanescape_status lanescape_dynamics_save(const lanescape_dynamics* dynamics, void* state, size_t capacity, size_t* needed) {
  return alone(dynamics, "dynamics", [&](auto& d) { save(d.dynamics.state(), state, capacity, needed); });
}

lanescape_status lanescape_dynamics_restore(lanescape_dynamics* dynamics, const void* state, size_t bytes) {
  return alone(dynamics, "dynamics", [&](auto& d) { d.dynamics.restore(bytes_of(state, bytes)); });
}

lanescape_status lanescape_dynamics_destroy(lanescape_dynamics* dynamics) { return destroy(dynamics, "dynamics"); }

lanescape_status lanescape_event_driven_create(size_t particles, const double* radii, const double* masses, const double* positions,
                                               const double box[3], const char* instruction_set,
                                               lanescape_event_driven** dynamics) {
  return guarded([&] {
    create(dynamics, "dynamics", [&] {
      return Events{particles, EventDrivenDynamics(array(radii, particles, "radii"), optional_array(masses, particles, "masses"),
                                                   vectors(positions, particles, "positions"), three(box, "box"),
                                                   word(instruction_set, "auto"))};
    });
  });
}

lanescape_status lanescape_event_driven_draw_velocities(lanescape_event_driven* dynamics, uint64_t seed) {
  return alone(dynamics, "dynamics", [&](auto& d) { d.dynamics.draw_velocities(seed); });
}

lanescape_status lanescape_event_driven_set_velocities(lanescape_event_driven* dynamics, const double* velocities) {
  return alone(dynamics, "dynamics", [&](auto& d) { d.dynamics.set_velocities(vectors(velocities, d.particles, "velocities")); });
}

lanescape_status lanescape_event_driven_collide(lanescape_event_driven* dynamics, uint64_t collisions) {
  return alone(dynamics, "dynamics", [&](auto& d) { d.dynamics.collide(collisions); });
}

lanescape_status lanescape_event_driven_advance_to(lanescape_event_driven* dynamics, double time) {
  return alone(dynamics, "dynamics", [&](auto& d) { d.dynamics.advance_to(time); });
}

lanescape_status lanescape_event_driven_describe(const lanescape_event_driven* dynamics, lanescape_event_driven_report* report) {
  return alone(dynamics, "dynamics", [&](auto& d) {
    const EventDrivenDynamics& moved = d.dynamics;
    auto& out = sized(report, "report", "lanescape_event_driven_report");
    out = {out.size, moved.collisions(), moved.time(), moved.kinetic_energy(), moved.compressibility()};
  });
}

lanescape_status lanescape_event_driven_get(const lanescape_event_driven* dynamics, double* positions, double* velocities) {
  return alone(dynamics, "dynamics", [&](auto& d) { copy_vectors(d.dynamics, positions, velocities); });
}

lanescape_status lanescape_event_driven_save(lanescape_event_driven* dynamics, void* state, size_t capacity, size_t* needed) {
  return alone(dynamics, "dynamics", [&](auto& d) { save(d.dynamics.state(), state, capacity, needed); });
}

lanescape_status lanescape_event_driven_restore(lanescape_event_driven* dynamics, const void* state, size_t bytes) {
  return alone(dynamics, "dynamics", [&](auto& d) { d.dynamics.restore(bytes_of(state, bytes)); });
}

lanescape_status lanescape_event_driven_destroy(lanescape_event_driven* dynamics) { return destroy(dynamics, "dynamics"); }
