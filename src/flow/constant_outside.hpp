#pragma once

#include <array>
#include <optional>

#include "flow/outside.hpp"

namespace lanescape {

struct ConstantOutsideOptions {
  Outside::Demands demands{};  // their heat flux is ignored with an enthalpy
  // Z, density times sound velocity of the fluid. The pressure answers the flow: p - Z (u - u0) at x = 0 and p + Z (u - u0) at x =
  // L, u the measured and u0 the asked velocity. A sound wave that comes from the slab then leaves it; without (0), it is
  // reflected.
  double impedance = 0.0;
  // Whether particles that pass a face count: their momentum beyond that of the mean flow is a part of the pressure, and the force
  // on the buffer is less by it. Else this force is p A, and the fluid feels what leaving particles leave behind besides.
  bool counts_recoil = true;
  // What a particle that enters brings: kinetic and potential energy and p/rho [epsilon]. One that leaves takes what it has in the
  // fluid beside the buffer. Heat makes up for what particles and the force on the buffers do not carry of this. None: no heat but
  // that of the demands.
  std::optional<double> enthalpy{};
  // Asks for more or fewer particles until the fluid beside the buffers has this density. None: for the mass flux alone.
  std::optional<double> density{};
  double area = 1.0;  // of a face
};

// An outside that asks for the same all the time: the test of [U] IV.B.
class ConstantOutside final : public Outside {
 public:
  explicit ConstantOutside(const ConstantOutsideOptions& options) : options_(options) {}

  Demands begin(const Reports& initial) override;
  Demands advance(const Reports& passed, double time) override;
  void exchange(Archive& archive) override;

 private:
  // Means of the last reports, and energy along +x that is still to pass.
  struct Face {
    double velocity = 0.0, density = 0.0, energy = 0.0, recoil = 0.0, filling = 0.0, owed = 0.0;
  };
  double enthalpy_of(std::size_t face, double particles) const;
  Demands answer() const;

  ConstantOutsideOptions options_;
  std::array<Face, 2> faces_{};
};

}  // namespace lanescape
