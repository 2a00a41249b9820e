#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "io/extended_xyz.hpp"
#include "landscape/pair_landscape.hpp"

namespace lanescape::testing {

// The best available instruction set, or the one that LANESCAPE_ISA names.
inline Isa active_isa() { return choose_isa("auto"); }

// A configuration with everything needed to move it. It is not copied or moved, because its parts refer to one another.
struct System {
  PairModel model;
  Configuration configuration;
  ParticleLayout layout;
  PairLandscape landscape;

  System(PairModel m, Configuration c)
      : model(std::move(m)),
        configuration(std::move(c)),
        layout(configuration.species, model.species.size()),
        landscape(model, configuration.box, layout, active_isa()) {}
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

// The position of lowest energy during the next `steps` steps. Between two such positions the landscape energy is low, so a path
// reaches its boundary.
inline AlignedArray lowest_on_the_way(VelocityVerlet& verlet, int steps) {
  AlignedArray lowest = verlet.position();
  double energy = verlet.potential_energy();
  for (int k = 0; k < steps; ++k) {
    verlet.step();
    if (verlet.potential_energy() >= energy) continue;
    energy = verlet.potential_energy();
    lowest = verlet.position();
  }
  return lowest;
}

inline PairModel with_masses(PairModel model, double first, double second) {
  model.species[0].mass = first;
  model.species[1].mass = second;
  return model;
}

}  // namespace lanescape::testing
