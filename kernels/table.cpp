#include "kernel_declarations.hpp"
#include "simd/simd.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {

extern __attribute__((visibility("default"))) const KernelTable table;
constinit const KernelTable table{
    .name = LANESCAPE_ISA_STRING(LANESCAPE_ISA),
    .lanes = lanes,
#define LANESCAPE_PAIR_FORM(name) &pair_##name,
    .pair = {LANESCAPE_PAIR_FORMS(LANESCAPE_PAIR_FORM)},
#undef LANESCAPE_PAIR_FORM
    .points_within = points_within,
    .probe_first_clear = probe_first_clear,
    .state_densities = state_densities,
    .state_lj_energy = state_lj_energy,
    .state_lj_gradient = state_lj_gradient,
    .state_lj_stress = state_lj_stress,
    .state_table_energy = state_table_energy,
    .state_table_gradient = state_table_gradient,
    .state_table_stress = state_table_stress,
    .state_density_gradient = state_density_gradient,
    .state_density_stress = state_density_stress,
    .sphere_any_overlap = sphere_any_overlap,
    .sphere_pairs_within = sphere_pairs_within,
    .sphere_smallest_gap = sphere_smallest_gap,
    .sphere_pair_columns = float_lanes,
    .sphere_list_any_overlap = sphere_list_any_overlap,
    .sphere_list_contacts = sphere_list_contacts,
    .sphere_contact_forces = sphere_contact_forces,
    .sphere_avoidance_trial = sphere_avoidance_trial,
    .sphere_first_collision = sphere_first_collision,
    .calendar_update = calendar_update,
    .dot = dot,
    .distance_squared = distance_squared,
    .difference = difference,
    .combine = combine,
    .axpy = axpy,
    .displacement_moments = displacement_moments,
    .add_particle_lengths = add_particle_lengths,
    .largest_displacement_squared = largest_displacement_squared,
    .peak_rounds = peak_rounds,
};

}  // namespace lanescape::kernels::LANESCAPE_ISA
