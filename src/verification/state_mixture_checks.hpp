#pragma once

#include <vector>

#include "reference/state_mixture.hpp"
#include "verification/kernel_checks.hpp"
#include "verification/state_mixture_cases.hpp"

namespace lanescape {

namespace tolerance {

// State-probability interactions compared with the reference, which uses the same splines: four to five times the worst measured
// deviation, as in the other checks. Energies and virials are relative to the sum of absolute pair energies, which is less than
// that of their powers (measured 1.2e-14); gradients are per particle, relative to the sum of its absolute forces (1.8e-14). With
// five states each sum has 25 terms per pair.
inline constexpr double state_sums = 6e-14;
inline constexpr double state_gradient = 8e-14;
// Relative to the density, or to one neighbour (measured 4.3e-15); a probability has the rounding of its density (2.3e-15).
inline constexpr double state_density = 2e-14;
inline constexpr double state_probability = 1e-14;
// Compared with the reference that uses tanh itself instead of its spline of 1024 intervals. At a width of 0.14 and a cutoff of 2.1
// the spline's error is 1e-9 of a neighbour, and 1000 times that in its slope (measured 3.6e-11 and 9.3e-8 where only a few
// neighbours contribute to the forces).
inline constexpr double switching_spline_energy = 1.6e-10;
inline constexpr double switching_spline_gradient = 4e-7;

}  // namespace tolerance

// The switching functions used in the reference: the exact ones, or the splines of the kernels.
enum class SwitchingForm { exact, spline };

// Evaluates the scalar reference, in the user's order. O(N^2 images).
reference::StateEvaluation evaluate_reference(const StateMixtureModel& model, const Configuration& configuration,
                                              SwitchingForm form = SwitchingForm::spline);
// The model in the reference's types.
reference::StateSystem reference_system(const StateMixtureModel& model, SwitchingForm form);

std::vector<Deviation> verify_state_mixtures(const kernels::KernelTable& table, const std::vector<StateMixtureCase>& cases);

}  // namespace lanescape
