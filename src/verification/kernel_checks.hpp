#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "dispatch/isa.hpp"
#include "verification/cases.hpp"

namespace lanescape {

// Tolerances, one per family of kernels: four to five times the worst deviation measured over pair_cases() on every instruction set
// with GCC 12 and Clang 19. This allows another compiler's order of a sum but no wrong term.
namespace tolerance {

// Energies, virials and tensors, relative to the sum of the absolute terms. Kernel and reference round a separation differently:
// one divides positions by the box and the other subtracts whole boxes, each to 2^-53 of a coordinate x. r^-12 turns an error of r
// into twelve times the relative error of u. A single close pair shows the full effect (measured 4.8e-15 at x = 54, where half an
// ulp is 3.6e-15), a sum over many pairs less.
inline constexpr double pair_sums = 2e-14;

// Gradients, per particle and relative to the sum of its absolute pair forces. The force on one particle has few pairs, so errors
// do not average out, and r^-13 has one more power (measured 6.4e-14 at x = 25).
inline constexpr double pair_gradient = 3e-13;

// The same in mixed precision, where pairs are rounded to 2^-24 = 6e-8: once for each separation, which r^-13 and r^-12 amplify
// thirteen and twelve times, and once for each following operation (measured 3.9e-7 for a single close pair, and 6.8e-7 for the
// worst of the forces on a few hundred particles, to compare with 13 x 2^-24 = 7.7e-7).
inline constexpr double mixed_sums = 1.8e-6;
inline constexpr double mixed_gradient = 3.2e-6;
// With individual diameters sigma_ij is rounded too, and r^-13 comes with sigma_ij^12 (measured 2.9e-6).
inline constexpr double mixed_diameters_gradient = 1.2e-5;
// A pair this close to the cutoff, relative to it, may or may not count: cases with such a pair are skipped.
inline constexpr double mixed_cutoff = 0x1p-22;

// All tolerances hold for coordinates up to this [sigma]. Beyond it the rounding of positions grows in proportion, so a deviation
// is divided by x / position_extent.
inline constexpr double position_extent = 60.0;

// Sums of products, relative to the sum of the absolute products: 2^-53 for each addition in sequence, of which SSE2 does 500 in
// the longest case (measured 1.3e-15; random signs give sqrt(500) 2^-53 = 2.5e-15, equal signs more).
inline constexpr double vector_sum = 5e-15;

// Linear combinations, relative to the sum of the absolute terms: one rounding each of up to two products and two sums without
// fused operations, 4 x 2^-53 (measured 2.1e-16). This is a bound and needs no further factor.
inline constexpr double linear_combination = 4.5e-16;

// |b - a|^2, and lengths |b - a| added to others: a rounding of the difference counts twice in the square, then follow three
// products and two sums. This is a bound and needs no further factor.
inline constexpr double displacement = 6.7e-16;

// Results that agree to the bit on every instruction set.
inline constexpr double exact = 0.0;

}  // namespace tolerance

// The worst deviation of one result of one kernel.
struct Deviation {
  std::string kernel;      // and the result, if it has several
  std::string isa;         // name of the table that ran
  std::string worst_case;  // empty if no case deviated at all
  double worst = 0.0;  // relative to the quantity that rounding scales with, or the number of wrong values if the tolerance is 0
  double tolerance = 0.0;
  std::size_t cases = 0;

  // A check without cases proves nothing and fails.
  bool passed() const { return cases > 0 && worst <= tolerance; }
};

// The factor by which the largest coordinate increases the tolerances.
double rounding_allowance(const Configuration& configuration);

// One line of text for messages.
std::string describe(const Deviation& deviation);

// Compares the vector algebra of a table with loops in long double, at lengths that leave every remainder.
std::vector<Deviation> verify_vector_algebra(const kernels::KernelTable& table);
// Compares the algebra of matrices in panels with sums in long double: what results miss when they are put into the equation they solve,
// relative to its terms.
std::vector<Deviation> verify_panel_algebra(const kernels::KernelTable& table);
// All of these checks, every pair form (Lennard-Jones on the given cases), neighbour pairs, state mixtures and hard spheres. Throws Error(bad_input)
// if the instruction set is not available.
std::vector<Deviation> verify_kernels(Isa isa, const std::vector<PairCase>& cases);

}  // namespace lanescape
