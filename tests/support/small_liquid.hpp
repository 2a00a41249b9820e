#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <stdexcept>
#include <vector>

#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "dispatch/isa.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "landscape/pair_landscape.hpp"
#include "path/polyline.hpp"
#include "reference/geodesic.hpp"
#include "reference/path_sum.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape::testing {

// A few particles of Kob and Andersen's mixture, which the reference can follow along a path. The potential ends
// smoothly at its cutoff.
struct SmallLiquid {
  PairModel model = kob_andersen();
  Configuration start, finish;
  ParticleLayout layout;
  double landscape_energy = 0.0;

  SmallLiquid(std::size_t particles, std::uint64_t seed, int steps) : start(placed(particles, seed)), layout(start.species, 2) {
    model.cutoff = 1.5;
    model.truncation = Truncation::smooth;
    const auto landscape = make();
    VelocityVerlet verlet(*landscape, model, layout, layout.to_slots(start.positions), 1e-3);
    verlet.draw_velocities(1.0, seed);
    for (int k = 0; k < 3000; ++k) {
      verlet.step();
      if (k % 100 == 0) verlet.rescale_to(1.0);
    }
    start.positions = layout.to_user(verlet.position());
    for (int k = 0; k < steps; ++k) verlet.step();
    finish = start;
    finish.positions = layout.to_user(verlet.position());
    landscape_energy = std::max(energy()(start.positions), energy()(finish.positions));
  }

  std::unique_ptr<SoftLandscape> make() const {
    return std::make_unique<PairLandscape>(model, start.box, layout, choose_isa("auto"));
  }
  // The scalar reference, in the user's order.
  reference::Energy energy() const {
    return [this](const std::vector<double>& positions) { return evaluate_reference(model, at(positions)).energy; };
  }
  reference::Gradient gradient() const {
    return [this](const std::vector<double>& positions, std::vector<double>& gradient) {
      gradient = evaluate_reference(model, at(positions)).gradient;
    };
  }
  Configuration at(const std::vector<double>& positions) const { return {start.box, start.species, positions}; }

  // Every tenth configuration of the reference's contour path, and its ends.
  std::vector<reference::Point> greedy() const {
    reference::GeodesicOptions options;
    options.step = 5e-3;
    options.landscape_energy = landscape_energy;
    options.record = 1'000'000;
    const reference::Geodesic found =
        find_geodesic(start.positions, finish.positions, energy(), gradient(), reference::Method::contour, options);
    if (found.outcome != reference::Outcome::reached) throw std::runtime_error("small liquid: no path");
    std::vector<reference::Point> nodes{start.positions};
    for (std::size_t k = 10; k + 10 < found.accepted.size(); k += 10) nodes.push_back(found.accepted[k]);
    nodes.push_back(finish.positions);
    return nodes;
  }
  Polyline in_slots(const std::vector<reference::Point>& nodes) const {
    Polyline result;
    for (const reference::Point& node : nodes) result.push_back(layout.to_slots(node));
    return result;
  }

 private:
  // One by one at random, in a cubic box of density 1, no two nearer than 0.8.
  static Configuration placed(std::size_t particles, std::uint64_t seed) {
    Configuration start;
    std::mt19937_64 engine(seed);
    const double edge = std::cbrt(static_cast<double>(particles));
    std::uniform_real_distribution<double> uniform(0.0, edge);
    start.box = {{edge, edge, edge}};
    while (start.size() < particles) {
      const Point at{uniform(engine), uniform(engine), uniform(engine)};
      bool room = true;
      for (std::size_t j = 0; j < start.size(); ++j) {
        const Point d = start.box.nearest_image(difference(start.position(j), at));
        room = room && dot(d, d) > 0.64;
      }
      if (!room) continue;
      start.positions.insert(start.positions.end(), at.begin(), at.end());
      start.species.push_back(start.species.size() % 5 == 4 ? 1 : 0);
    }
    return start;
  }
};

}  // namespace lanescape::testing
