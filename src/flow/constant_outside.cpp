#include "flow/constant_outside.hpp"

#include <algorithm>

namespace lanescape {
namespace {

// Times over which reports are averaged. A shorter one passes more noise to the pressure, a longer one reflects longer waves.
constexpr double memory_of_velocity = 0.5, memory_of_fluid = 2.0;
// Within which heat that is owed passes.
constexpr double heating_time = 1.0;
// Particles per area and time for each particle per volume that is missing.
constexpr double filling_velocity = 1.0;

void average(double& mean, double value, double time, double memory) { mean += std::min(1.0, time / memory) * (value - mean); }

}  // namespace

// Of one of these particles, net along +x, that passed.
double ConstantOutside::enthalpy_of(std::size_t face, double particles) const {
  const bool enters = face == 0 ? particles > 0.0 : particles < 0.0;
  return enters ? *options_.enthalpy : faces_[face].energy + options_.demands[face].pressure / faces_[face].density;
}

Outside::Demands ConstantOutside::begin(const Reports& initial) {
  for (std::size_t face = 0; face < 2; ++face)
    faces_[face] = {
        initial[face].velocity[0], initial[face].density, initial[face].energy_per_particle, 0.0, initial[face].filling, 0.0};
  return answer();
}

Outside::Demands ConstantOutside::advance(const Reports& passed, double time) {
  for (std::size_t k = 0; k < 2; ++k) {
    Face& face = faces_[k];
    average(face.velocity, passed[k].velocity[0], time, memory_of_velocity);
    average(face.density, passed[k].density, time, memory_of_fluid);
    average(face.energy, passed[k].energy_per_particle, time, memory_of_fluid);
    average(face.filling, passed[k].filling, time, memory_of_fluid);
    const double carried = (passed[k].momentum[0] - passed[k].impulse[0]) / (options_.area * time);
    average(face.recoil, carried - options_.demands[k].mass_flux * options_.demands[k].velocity[0], time, memory_of_fluid);
    if (options_.enthalpy) face.owed += passed[k].particles * enthalpy_of(k, passed[k].particles) - passed[k].energy;
  }
  return answer();
}

Outside::Demands ConstantOutside::answer() const {
  Demands demands = options_.demands;
  for (std::size_t face = 0; face < 2; ++face) {
    const double inwards = face == 0 ? 1.0 : -1.0;
    FaceDemand& demand = demands[face];
    demand.pressure -= inwards * options_.impedance * (faces_[face].velocity - demand.velocity[0]);
    if (options_.counts_recoil) demand.pressure += filling_correction(faces_[face].filling) * demand.pressure - faces_[face].recoil;
    if (options_.enthalpy) demand.heat_flux = faces_[face].owed / (options_.area * heating_time);
    if (options_.density) demand.mass_flux += inwards * filling_velocity * (*options_.density - faces_[face].density);
  }
  return demands;
}

void ConstantOutside::exchange(Archive& archive) {
  for (std::size_t face = 0; face < 2; ++face) {
    archive.enter(face == 0 ? "face_inlet" : "face_outlet");
    archive.field("velocity", faces_[face].velocity);
    archive.field("density", faces_[face].density);
    archive.field("energy", faces_[face].energy);
    archive.field("recoil", faces_[face].recoil);
    archive.field("filling", faces_[face].filling);
    archive.field("owed", faces_[face].owed);
    archive.leave();
  }
}

}  // namespace lanescape
