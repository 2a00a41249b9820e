#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "configuration/configuration.hpp"
#include "configuration/lennard_jones_model.hpp"
#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "io/extended_xyz.hpp"
#include "landscape/lennard_jones_landscape.hpp"

namespace lanescape::testing {

inline Isa best_isa() { return available_isas().back(); }

// A configuration with everything that moves it. Not copied or moved: its parts refer to one another.
struct System {
  LennardJonesModel model;
  Configuration configuration;
  ParticleLayout layout;
  LennardJonesLandscape landscape;

  System(LennardJonesModel m, Configuration c)
      : model(std::move(m)),
        configuration(std::move(c)),
        layout(configuration.species, model.species.size()),
        landscape(model, configuration.box, layout, best_isa()) {}
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  AlignedArray start() const { return layout.to_slots(configuration.positions); }
  VelocityVerlet moving(double temperature, double time_step = 1e-3, std::uint64_t seed = 1) {
    VelocityVerlet verlet(landscape, model, layout, start(), time_step);
    verlet.draw_velocities(temperature, seed);
    return verlet;
  }
};

// 108 particles of Kob and Andersen's mixture, molten, at density 1.2.
inline Configuration molten_kob_andersen() {
  return read_frames(std::string(LANESCAPE_TEST_DATA_DIR) + "/ka_melted_108.extxyz", kob_andersen()).front().configuration;
}

inline LennardJonesModel with_masses(LennardJonesModel model, double first, double second) {
  model.species[0].mass = first;
  model.species[1].mass = second;
  return model;
}

}  // namespace lanescape::testing
