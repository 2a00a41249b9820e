#pragma once

#include <cstdint>

#include "configuration/configuration.hpp"
#include "configuration/hard_sphere_model.hpp"
#include "configuration/mixture.hpp"
#include "configuration/pair_model.hpp"
#include "configuration/state_mixture_model.hpp"

namespace lanescape {

// `particles` on a face-centred cubic lattice in a cube of the given number density [sigma^-3], species drawn at random in the
// model's proportions (floor(N fraction) of each, the first takes the rest). If N is not 4 n^3, the empty sites are
// drawn at random too. Throws Error(bad_input) for no particles, more than four million,
// and densities out of range.
Configuration fcc_start(const StateMixtureModel& model, std::size_t particles, double density, std::uint64_t seed);

// The same with a diameter of each particle where the model's have one: the quantiles of the distribution that falls as
// diameter^-3, with mean 1 and the ratio 0.45 of smallest to largest, in random order. doi 10.1103/PhysRevX.7.021039
Configuration fcc_start(const PairModel& model, std::size_t particles, double density, std::uint64_t seed);

// As many particles without diameters of their own as give this density in a box of any shape, on a lattice with cells as nearly
// cubic as fit into it; the rest as fcc_start().
Configuration fcc_in_box(const PairModel& model, const Box& box, double density, std::uint64_t seed);

// How species are placed on a lattice: at random, or each in its own part of the box along x, the largest spheres first.
enum class Arrangement { random, halves };

// Hard spheres with their radii on the sites of fcc_start(), in the cube in which they have this packing
// fraction. Throws Error(bad_input) for no particles, more than four million, a packing fraction outside (0, 0.74], and one at
// which spheres on the lattice overlap.
Configuration hard_sphere_start(const HardSphereModel& model, std::size_t particles, double packing_fraction,
                                Arrangement arrangement, std::uint64_t seed);
// The largest packing fraction that hard_sphere_start() accepts with the same arguments: spheres touch, less 1e-12 for rounding.
double largest_lattice_packing_fraction(const HardSphereModel& model, std::size_t particles, Arrangement arrangement,
                                        std::uint64_t seed);

}  // namespace lanescape
