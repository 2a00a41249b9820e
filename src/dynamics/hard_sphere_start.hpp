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

// How to make hard spheres at a packing fraction:
// - lattice: fcc sites; several species are put into separate parts of the box;
// - contraction: mechanical contraction with [G]'s counts, from such a lattice at 0.50 or the largest packing fraction below that a
//   lattice can have;
// - growth: event-driven dynamics of a dilute melt while all diameters grow (Lubachevsky and Stillinger, doi 10.1007/BF01025983),
//   which is fast and mixes species;
// - automatic: lattice below 0.50 if the densest lattice is at least 1 % denser, growth otherwise.
enum class StartMethod { automatic, lattice, contraction, growth };

// Allowed words: auto, lattice, contraction, growth. Throws Error(bad_input) for any other.
StartMethod parse_start_method(std::string_view word);
const char* to_string(StartMethod method);

// Hard spheres without overlaps in a cubic box of exactly this packing fraction, positions in the box. Returns nothing if the
// monitor asks to stop. Throws Error(bad_input) for fewer than two particles, a packing fraction outside (0, 0.74] or beyond what
// the method reaches, and a box shorter than event-driven dynamics allows.
std::optional<Configuration> make_hard_sphere_start(const HardSphereModel& model, std::size_t particles, double packing_fraction,
                                                    StartMethod method, std::uint64_t seed, Isa isa, RunMonitor& monitor);

}  // namespace lanescape
