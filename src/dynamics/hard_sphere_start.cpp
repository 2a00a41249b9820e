#include "dynamics/hard_sphere_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "configuration/lattice.hpp"
#include "configuration/particle_layout.hpp"
#include "core/enum_words.hpp"
#include "core/error.hpp"
#include "dynamics/contraction.hpp"
#include "dynamics/event_driven.hpp"
#include "interaction/sphere/hard_sphere_overlap.hpp"

namespace lanescape {
namespace {

constexpr double max_packing_fraction = 0.74;
constexpr double dense = 0.50;         // lattices at this packing fraction or above do not melt, or melt too slowly
constexpr double lattice_room = 1.01;  // least ratio of the densest lattice's packing fraction to the wanted one

constexpr double melt_packing_fraction = 0.25;     // at which diameters start to grow
constexpr std::uint64_t melt_collisions = 200;     // per particle
constexpr std::uint64_t rescale_collisions = 20;   // per particle; growth heats by some ten per cent between rescalings
constexpr std::uint64_t most_collisions = 20'000;  // limit per particle and stage: several times what any start needs
constexpr double jammed_compressibility = 1e4;
// Radii grow beyond the model's by this share, so that spheres of the model's radii are not in contact.
constexpr double room_to_part = 1e-9;

// A stage of growth: its rate, in units of thermal velocity over mean diameter, and the ratio of radii to the model's at its end.
// The first stage is too fast for one component to crystallise at phi = 0.49 to 0.55. The last is slow enough for spheres to
// rearrange.
struct Growth {
  double rate, until;
};
constexpr std::array<Growth, 2> stages = {{{1e-2, 0.99}, {1e-3, 1.0 + room_to_part}}};

// Runs a stage of growth until radii are `until` times the model's. Returns false if the monitor asks to stop.
bool grow_until(EventDriven& spheres, double until, double model_radius, double wanted_fraction, RunMonitor& monitor) {
  const std::uint64_t per_round = rescale_collisions * spheres.size() / 2, most = most_collisions * spheres.size() / 2;
  while (true) {
    const double virial = spheres.virial(), time = spheres.time();
    std::uint64_t k = 0;
    for (; k < per_round && spheres.radius(0) < until * model_radius; ++k) spheres.collide();
    if (k < per_round) return true;
    const double reached = wanted_fraction * std::pow(spheres.radius(0) / model_radius, 3);
    if (spheres.collisions() > most || spheres.compressibility(virial, time) > jammed_compressibility)
      throw_bad_input(fmt::format("packing fraction {} is beyond what growth reached for this composition ({:.4f})",
                                  wanted_fraction, std::min(reached, wanted_fraction)));
    spheres.rescale();
    monitor.progress("growth", reached, wanted_fraction);
    if (monitor.stop_requested()) return false;
  }
}

// Returns false if the monitor asks to stop.
bool melt(EventDriven& spheres, RunMonitor& monitor) {
  for (std::uint64_t k = 0; k < melt_collisions; ++k) {
    for (std::size_t i = 0; i < (spheres.size() + 1) / 2; ++i) spheres.collide();
    monitor.progress("melting", static_cast<double>(k + 1), static_cast<double>(melt_collisions));
    if (monitor.stop_requested()) return false;
  }
  return true;
}

// Grows spheres in the final box. Diameters end slightly above the model's and are then set to the model's.
std::optional<Configuration> grown_start(const Configuration& dilute, double wanted_fraction, std::uint64_t seed,
                                         const kernels::KernelTable& table, RunMonitor& monitor) {
  const std::size_t n = dilute.size();
  Configuration start = dilute;
  const double edge = cube_edge(dilute, wanted_fraction), scale = edge / dilute.box.length[0];
  start.box.length = {edge, edge, edge};
  for (double& x : start.positions) x *= scale;
  for (double& radius : start.radii) radius *= scale;

  // Positions in equilibrium do not depend on masses. Equal masses mix fastest.
  const std::vector<double> masses(n, 1.0);
  EventDriven liquid(start, masses, table);
  liquid.draw_velocities(seed);
  if (!melt(liquid, monitor)) return std::nullopt;
  Configuration now = liquid.configuration();
  std::vector<double> velocities = liquid.velocities();
  const double mean_diameter = 2.0 * std::accumulate(dilute.radii.begin(), dilute.radii.end(), 0.0) / static_cast<double>(n);
  for (const Growth& stage : stages) {
    EventDriven growing(now, masses, table, stage.rate / mean_diameter);
    growing.set_velocities(velocities);
    growing.rescale();
    if (!grow_until(growing, stage.until, dilute.radii[0], wanted_fraction, monitor)) return std::nullopt;
    now = growing.configuration();
    velocities = growing.velocities();
  }
  now.species = dilute.species;
  now.radii = dilute.radii;
  now.wrap();
  return now;
}

void check_box(const Configuration& spheres, double packing_fraction, const kernels::KernelTable& table) {
  // A single sphere in that box makes the constructor throw its own message.
  const double edge = cube_edge(spheres, packing_fraction), largest = *std::max_element(spheres.radii.begin(), spheres.radii.end());
  EventDriven({Box{{edge, edge, edge}}, {0}, {0.0, 0.0, 0.0}, {largest}}, {1.0}, table);
}

bool any_overlap(const Configuration& spheres, const kernels::KernelTable& table) {
  const ParticleLayout layout(std::vector<int>(spheres.size(), 0), 1);
  return HardSphereOverlap(spheres.box, layout, spheres.radii, table).any_overlap(layout.to_slots(spheres.positions));
}

constexpr EnumWord<StartMethod> start_methods[] = {{StartMethod::automatic, "auto"},
                                                   {StartMethod::lattice, "lattice"},
                                                   {StartMethod::contraction, "contraction"},
                                                   {StartMethod::growth, "growth"}};

}  // namespace

StartMethod parse_start_method(std::string_view word) { return parse_word(start_methods, "start method", word); }
const char* to_string(StartMethod method) { return word_of(start_methods, method); }

std::optional<Configuration> make_hard_sphere_start(const HardSphereModel& model, std::size_t particles, double packing_fraction,
                                                    StartMethod method, std::uint64_t seed, Isa isa, RunMonitor& monitor) {
  if (!(packing_fraction > 0.0 && packing_fraction <= max_packing_fraction))
    throw_bad_input(
        fmt::format("packing fraction {} is not allowed: above 0 and at most {}", packing_fraction, max_packing_fraction));
  if (particles == 1) throw_bad_input("1 particle is not allowed: at least 2 are needed for a collision");
  const kernels::KernelTable& table = kernel_table(isa);
  const Arrangement arrangement = model.species.size() > 1 ? Arrangement::halves : Arrangement::random;

  // These two calls also throw for an invalid model or number of particles.
  const double largest_mixed = largest_lattice_packing_fraction(model, particles, Arrangement::random, seed);
  const Configuration dilute = hard_sphere_start(
      model, particles, std::min({melt_packing_fraction, 0.9 * packing_fraction, 0.9 * largest_mixed}), Arrangement::random, seed);
  check_box(dilute, packing_fraction, table);
  const double largest_on_lattice = largest_lattice_packing_fraction(model, particles, arrangement, seed);
  if (method == StartMethod::automatic)
    method = packing_fraction < dense && lattice_room * packing_fraction <= largest_on_lattice ? StartMethod::lattice
                                                                                               : StartMethod::growth;
  std::optional<Configuration> start;
  if (method == StartMethod::growth)
    start = grown_start(dilute, packing_fraction, seed, table, monitor);
  else if (method == StartMethod::lattice)
    start = hard_sphere_start(model, particles, packing_fraction, arrangement, seed);
  else
    start =
        contract(hard_sphere_start(model, particles, std::min({packing_fraction, dense, largest_on_lattice}), arrangement, seed),
                 packing_fraction, {}, seed, monitor);
  if (start && any_overlap(*start, table))
    throw Error(ErrorCode::internal, fmt::format("the start by {} overlaps", to_string(method)));
  return start;
}

}  // namespace lanescape
