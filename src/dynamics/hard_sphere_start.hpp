#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "configuration/configuration.hpp"
#include "configuration/hard_sphere_model.hpp"
#include "core/run_monitor.hpp"
#include "dispatch/isa.hpp"

namespace lanescape {

// How hard spheres come to their packing fraction:
// - lattice: on fcc sites, species in halves of the box where there are several;
// - contraction: from such a lattice at 0.50, or the densest there is below, by mechanical contraction with [G]'s counts;
// - growth: from a dilute melt by event-driven dynamics while all diameters grow (Lubachevsky and Stillinger, doi
//   10.1007/BF01025983), which mixes species and is fast;
// - automatic: lattice below 0.50 where it leaves 1 % of room, growth elsewhere.
enum class StartMethod { automatic, lattice, contraction, growth };

// From auto, lattice, contraction, growth; throws Error(bad_input) for any other word.
StartMethod parse_start_method(std::string_view word);
const char* to_string(StartMethod method);

// Hard spheres without overlaps, positions inside a cube of exactly this packing fraction. Nothing where the monitor asked to
// stop. Throws Error(bad_input) for fewer than two particles, a packing fraction outside (0, 0.74] or beyond what the method
// reaches, and a box shorter than event-driven dynamics allows.
std::optional<Configuration> make_hard_sphere_start(const HardSphereModel& model, std::size_t particles, double packing_fraction,
                                                    StartMethod method, std::uint64_t seed, Isa isa, RunMonitor& monitor);

}  // namespace lanescape
