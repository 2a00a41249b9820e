#pragma once

#include "pair_kernels.hpp"
#include "views.hpp"

namespace lanescape::kernels {

// All kernels of one instruction set. Arrays are aligned to array_alignment; n is a multiple of slot_padding.
struct KernelTable {
  const char* name;
  std::size_t lanes;  // doubles per vector

  // Pair potentials, by PairForm.
  const PairKernels* pair[pair_form_count];
  const PairKernels& pair_kernels(PairForm form) const noexcept { return *pair[static_cast<std::size_t>(form)]; }

  // Places of all points of a grid within reach of a position, and of some that are up to a millionth of the grid's length further,
  // in rising order; their number, or capacity + 1 where there may be no room for all of them and a vector more.
  std::size_t (*points_within)(const PointGrid&, const NeighbourQuery&, std::uint32_t* out, std::size_t capacity) noexcept;

  // The first of these positions with no point of any species nearer than that species' clearance; their number if there is none.
  std::size_t (*probe_first_clear)(const ProbeInput&, const double* clearances, const double* positions,
                                   std::size_t count) noexcept;
  // Interactions that follow the states of sites, over neighbour lists, for rows [0, row_count). Densities sum c w of each row.
  // `near` and its lengths may stand in for those of the list from then on.
  void (*state_densities)(const StateDensityInput&, double* densities) noexcept;
  // At fixed probabilities: `slopes` gets dU/dp, row_count x states (each pair counts in full), `gradient` a point per row, energy
  // and virial are these rows' share. The three agree to the bit in what they have in common; with one state they and the
  // Lennard-Jones list kernels do.
  double (*state_lj_energy)(const StateLjInput&) noexcept;
  void (*state_lj_gradient)(const StateLjInput&, double* gradient, double* slopes, PairOutput&) noexcept;
  void (*state_lj_stress)(const StateLjInput&, double* gradient, double* slopes, PairOutput&) noexcept;
  double (*state_table_energy)(const StateTableInput&) noexcept;
  void (*state_table_gradient)(const StateTableInput&, double* gradient, double* slopes, PairOutput&) noexcept;
  void (*state_table_stress)(const StateTableInput&, double* gradient, double* slopes, PairOutput&) noexcept;
  // By way of the densities, given dU/drho of each site; there is no energy.
  void (*state_density_gradient)(const StateDensityForceInput&, double* gradient, PairOutput&) noexcept;
  void (*state_density_stress)(const StateDensityForceInput&, double* gradient, PairOutput&) noexcept;

  // Hard spheres over all pairs: whether any overlap; the pairs with r < s_ij + reach (their number, which may exceed the
  // capacity: then only so many are written); the smallest r - s_ij (infinity where there is no pair).
  bool (*sphere_any_overlap)(const SphereInput&) noexcept;
  std::size_t (*sphere_pairs_within)(const SphereInput&, double reach, SpherePair* out, std::size_t capacity) noexcept;
  double (*sphere_smallest_gap)(const SphereInput&) noexcept;
  std::size_t sphere_pair_columns;  // see SpherePair
  // The same over a list: whether any overlap, and which; their number.
  bool (*sphere_list_any_overlap)(const SphereList&, const double* positions, std::size_t slots) noexcept;
  std::size_t (*sphere_list_contacts)(const SphereList&, const double* positions, std::size_t slots,
                                      const SphereContacts&) noexcept;
  // Adds the fictitious forces of `count` overlapping pairs to `force` (3 x slots).
  void (*sphere_contact_forces)(const SphereList&, const SphereContacts&, std::size_t count, ContactPotential, double* force,
                                std::size_t slots) noexcept;
  // sum += force/|force|, then trial = position + step sum_j/|sum_j| particle by particle, and force = 0; the number of particles
  // that move.
  std::size_t (*sphere_avoidance_trial)(double* trial, const double* position, double* sum, double* force, double step,
                                        std::size_t slots) noexcept;
  // Event-driven dynamics.
  CollisionEvent (*sphere_first_collision)(const CollisionQuery&) noexcept;
  void (*calendar_update)(const CalendarView&, std::size_t event, double time) noexcept;

  // Vector algebra in one fixed order of summation.
  double (*dot)(const double* a, const double* b, std::size_t n) noexcept;
  double (*distance_squared)(const double* a, const double* b, std::size_t n) noexcept;
  void (*difference)(double* out, const double* a, const double* b, std::size_t n) noexcept;  // a - b
  // out = x + a u + b v
  void (*combine)(double* out, const double* x, double a, const double* u, double b, const double* v, std::size_t n) noexcept;
  // out = x + a u
  void (*axpy)(double* out, const double* x, double a, const double* u, std::size_t n) noexcept;
  // Moments of b - a, arrays of 3 x slots.
  DisplacementMoments (*displacement_moments)(const double* a, const double* b, std::size_t slots) noexcept;

  // Adds |b_j - a_j| to lengths[j] for each particle.
  void (*add_particle_lengths)(double* lengths, const double* a, const double* b, std::size_t slots) noexcept;
  // The largest |b_j - a_j|^2 over slots [begin, end), multiples of slot_padding; arrays of 3 x slots.
  double (*largest_displacement_squared)(const double* a, const double* b, std::size_t slots, std::size_t begin,
                                         std::size_t end) noexcept;

  // Runs `rounds` rounds of independent fused multiply-adds (products and sums where there is no fma); returns how many
  // floating-point operations that was. Measures the machine's limit for the benchmarks.
  double (*peak_rounds)(std::size_t rounds, double* sink) noexcept;
};

}  // namespace lanescape::kernels
