#pragma once

#include <cstddef>
#include <cstdint>

namespace lanescape::kernels {

// The pair potentials that kernels exist for, a line each: kernels/forms/<name>.hpp says what its coefficients mean,
// kernels/pair_<name>.cpp compiles the loops over it.
#define LANESCAPE_PAIR_FORMS(FORM) \
  FORM(lennard_jones)              \
  FORM(even_powers)                \
  FORM(yukawa)                     \
  FORM(soft_sphere)                \
  FORM(polydisperse)

enum class PairForm : std::uint32_t {
#define LANESCAPE_PAIR_FORM(name) name,
  LANESCAPE_PAIR_FORMS(LANESCAPE_PAIR_FORM)
#undef LANESCAPE_PAIR_FORM
};
#define LANESCAPE_PAIR_FORM(name) +1
inline constexpr std::size_t pair_form_count = 0 LANESCAPE_PAIR_FORMS(LANESCAPE_PAIR_FORM);
#undef LANESCAPE_PAIR_FORM

}  // namespace lanescape::kernels
