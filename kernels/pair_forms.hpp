#pragma once

#include <cstddef>
#include <cstdint>

namespace lanescape::kernels {

// The pair potentials that have kernels, a line each: the file in kernels/forms/, which documents the coefficients, and the class
// in it. The build reads these lines and compiles all loops over each form, once per instruction set.
#define LANESCAPE_PAIR_FORMS(FORM)  \
  FORM(lennard_jones, LennardJones) \
  FORM(even_powers, EvenPowers)     \
  FORM(yukawa, Yukawa)              \
  FORM(soft_sphere, SoftSphere)     \
  FORM(polydisperse, Polydisperse)  \
  FORM(twelve_six_four, TwelveSixFour)

enum class PairForm : std::uint32_t {
#define LANESCAPE_PAIR_FORM(name, Form) name,
  LANESCAPE_PAIR_FORMS(LANESCAPE_PAIR_FORM)
#undef LANESCAPE_PAIR_FORM
};
#define LANESCAPE_PAIR_FORM(name, Form) +1
inline constexpr std::size_t pair_form_count = 0 LANESCAPE_PAIR_FORMS(LANESCAPE_PAIR_FORM);
#undef LANESCAPE_PAIR_FORM

}  // namespace lanescape::kernels
