#include "api/host_arrays.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/coordinate_checks.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"

namespace lanescape {
void name_what_is_not_finite(const Vectors<const double>& host) {
  std::vector<double> interleaved;
  for (std::size_t i = 0; i < host.count; ++i) {
    const auto k = static_cast<std::ptrdiff_t>(i) * host.stride;
    interleaved.insert(interleaved.end(), {host.x[k], host.y[k], host.z[k]});
  }
  check_finite_particles(interleaved);
}

void check_positions(std::size_t given, std::size_t particles) {
  if (given != 3 * particles)
    throw_bad_input(fmt::format("{} coordinates were given for {} particles: {} are needed", given, particles, 3 * particles));
}

void check_positions(const Vectors<const double>& given, std::size_t particles) {
  check_positions(3 * given.count, particles);
  if (particles != 0 && (given.x == nullptr || given.y == nullptr || given.z == nullptr))
    throw_bad_input("positions have a null pointer: arrays of x, y and z are needed");
}

void check_room(const char* what, std::size_t given, std::size_t needed) {
  if (given != needed) throw_bad_input(fmt::format("room for {} {} was given: {} are needed", given, what, needed));
}

void check_forces(const Vectors<double>& given, std::size_t particles) {
  check_room("force components", 3 * given.count, 3 * particles);
  if (particles != 0 && (given.y == nullptr || given.z == nullptr))
    throw_bad_input("forces have a null pointer: arrays of x, y and z are needed");
}

const AlignedArray& HostArrays::positions(const Vectors<const double>& host) {
  check_positions(host, layout_.size());
  const FloatEnvironment environment;
  double* const slots[3] = {positions_.data(), positions_.data() + layout_.slots(), positions_.data() + 2 * layout_.slots()};
  double nothing = 0.0;  // x - x is 0, or not a number
  for (std::size_t i = 0; i < host.count; ++i) {
    const auto k = static_cast<std::ptrdiff_t>(i) * host.stride;
    const std::size_t slot = layout_.slot_of(i);
    const double x = host.x[k], y = host.y[k], z = host.z[k];
    slots[0][slot] = x;
    slots[1][slot] = y;
    slots[2][slot] = z;
    nothing += (x - x) + (y - y) + (z - z);
  }
  if (nothing != 0.0) name_what_is_not_finite(host);
  return positions_;
}

AlignedArray& HostArrays::energies() {
  energies_.resize(layout_.slots(), 0.0);
  return energies_;
}

void HostArrays::check_room_of(const Outputs& outputs) const {
  if (!outputs.energies.empty()) check_room("energies", outputs.energies.size(), layout_.size());
  if (outputs.forces.x != nullptr) check_forces(outputs.forces, layout_.size());
}

void HostArrays::write_energies(std::span<double> host) const {
  for (std::size_t i = 0; i < layout_.size(); ++i) host[i] = energies_[layout_.slot_of(i)];
}

void HostArrays::write_gradient(std::span<double> host) const {
  const double* const slots = gradient_.data();
  const std::size_t stride = layout_.slots();
  for (std::size_t i = 0; i < layout_.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) host[3 * i + axis] = slots[axis * stride + layout_.slot_of(i)];
}

template <class Put>
void HostArrays::for_each_force(const Vectors<double>& host, Put put) const {
  const double *const x = gradient_.data(), *const y = x + layout_.slots(), *const z = y + layout_.slots();
  for (std::size_t i = 0; i < layout_.size(); ++i) {
    const auto k = static_cast<std::ptrdiff_t>(i) * host.stride;
    const std::size_t slot = layout_.slot_of(i);
    put(host.x[k], x[slot]);
    put(host.y[k], y[slot]);
    put(host.z[k], z[slot]);
  }
}

void HostArrays::write_forces(const Vectors<double>& host) const {
  for_each_force(host, [](double& force, double gradient) { force = 0.0 - gradient; });  // of no force 0, not -0
}

void HostArrays::add_forces(const Vectors<double>& host) const {
  for_each_force(host, [](double& force, double gradient) { force -= gradient; });
}

}  // namespace lanescape
