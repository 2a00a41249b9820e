#include "dynamics/hard_sphere_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "configuration/lattice.hpp"
#include "configuration/particle_layout.hpp"
#include "core/error.hpp"
#include "dynamics/contraction.hpp"
#include "dynamics/event_driven.hpp"
#include "interaction/hard_sphere.hpp"

namespace lanescape {
namespace {

constexpr double max_packing_fraction = 0.74;
constexpr double dense = 0.50;         // from here on lattices do not melt, or melt too slowly
constexpr double lattice_room = 0.99;  // of what a lattice can reach: as far as one is taken

// Growth: a fluid melted at this packing fraction, whose diameters grow by so much of themselves per unit of time, slower where
// the pressure is high. The first rate leaves one component no time to crystallise between 0.49 and 0.55.
constexpr double melted_at = 0.30, slow_above = 0.56;
constexpr double fast_growth = 0.02, slow_growth = 0.002;
constexpr std::uint64_t melt_collisions = 500;     // per particle
constexpr std::uint64_t rescale_collisions = 10;   // per particle; growth heats meanwhile
constexpr std::uint64_t most_collisions = 40'000;  // per particle: several times what any start needs

Arrangement crystal_of(const HardSphereModel& model) {
  return model.species.size() > 1 ? Arrangement::halves : Arrangement::random;
}

// Everything scaled so that radii are the model's again and the packing fraction is the wanted one: gaps only widen.
Configuration at_packing_fraction(Configuration grown, const std::vector<double>& radii, double wanted) {
  grown.radii = radii;
  const double edge = cube_edge(grown, wanted), scale = edge / grown.box.length[0];
  for (double& x : grown.positions) x *= scale;
  grown.box = {{edge, edge, edge}};
  return grown;
}

std::optional<Configuration> grow(const HardSphereModel& model, std::size_t particles, double wanted, std::uint64_t seed, Isa isa,
                                  RunMonitor& monitor) {
  const double dilute =
      std::min({melted_at, wanted, lattice_room * largest_lattice_packing_fraction(model, particles, Arrangement::random, seed)});
  Configuration now = hard_sphere_start(model, particles, dilute, Arrangement::random, seed);
  const std::vector<int> species = now.species;
  const std::vector<double> radii = now.radii;
  const std::vector<double> masses(particles, 1.0);
  EventDriven melt(now, masses, kernel_table(isa));
  melt.draw_velocities(seed);
  for (std::uint64_t k = 0; k < melt_collisions * particles; ++k) melt.collide();
  now.positions = melt.positions();

  std::uint64_t collisions = 0;
  const auto factor_to = [&](double packing) { return std::cbrt(packing / dilute); };
  for (const auto& [rate, until] : {std::pair{fast_growth, factor_to(std::min(wanted, slow_above))},
                                    std::pair{slow_growth, factor_to(wanted) * (1.0 + 1e-9)}}) {
    if (now.radii[0] >= until * radii[0]) continue;
    EventDriven dynamics(now, masses, kernel_table(isa), rate);
    dynamics.draw_velocities(seed);
    while (dynamics.radius(0) < until * radii[0]) {
      dynamics.collide();
      if (++collisions % (rescale_collisions * particles) != 0) continue;
      dynamics.rescale();
      const double reached = packing_fraction(dynamics.configuration());
      monitor.progress("growth", reached, wanted);
      if (monitor.stop_requested()) return std::nullopt;
      if (collisions > most_collisions * particles)
        throw_bad_input(
            fmt::format("packing fraction {} is beyond what growth reached for this composition: {:.4f}", wanted, reached));
    }
    dynamics.resynchronise();
    now = dynamics.configuration();
    now.species = species;
  }
  return at_packing_fraction(std::move(now), radii, wanted);
}

}  // namespace

StartMethod parse_start_method(std::string_view word) {
  for (const StartMethod method : {StartMethod::automatic, StartMethod::lattice, StartMethod::contraction, StartMethod::growth})
    if (word == to_string(method)) return method;
  throw_bad_input(fmt::format("unknown start method '{}': allowed are auto, lattice, contraction, growth", word));
}

const char* to_string(StartMethod method) {
  switch (method) {
    case StartMethod::automatic:
      return "auto";
    case StartMethod::lattice:
      return "lattice";
    case StartMethod::contraction:
      return "contraction";
    case StartMethod::growth:
      return "growth";
  }
  return "";
}

std::optional<Configuration> make_hard_sphere_start(const HardSphereModel& model, std::size_t particles, double wanted,
                                                    StartMethod method, std::uint64_t seed, Isa isa, RunMonitor& monitor) {
  if (!(wanted > 0.0 && wanted <= max_packing_fraction))
    throw_bad_input(fmt::format("packing fraction {} is not allowed: above 0 and at most {}", wanted, max_packing_fraction));
  if (method == StartMethod::automatic) {
    const bool crystal =
        wanted < dense && wanted < lattice_room * largest_lattice_packing_fraction(model, particles, crystal_of(model), seed);
    method = crystal ? StartMethod::lattice : StartMethod::growth;
  }
  std::optional<Configuration> start;
  if (method == StartMethod::growth) start = grow(model, particles, wanted, seed, isa, monitor);
  if (method == StartMethod::lattice) start = hard_sphere_start(model, particles, wanted, crystal_of(model), seed);
  if (method == StartMethod::contraction) {
    const double from =
        std::min({dense, wanted, lattice_room * largest_lattice_packing_fraction(model, particles, crystal_of(model), seed)});
    start = contract(hard_sphere_start(model, particles, from, crystal_of(model), seed), wanted, {}, seed, monitor);
  }
  if (!start) return start;
  wrap_positions(*start);
  check_no_overlap(*start, kernel_table(isa));
  return start;
}

}  // namespace lanescape
