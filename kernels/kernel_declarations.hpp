#pragma once

#include "isa.hpp"
#include "kernel_table.hpp"

// Every kernel of one instruction set, for table.cpp. Documented at KernelTable's members.
namespace lanescape::kernels::LANESCAPE_ISA {
#define LANESCAPE_PAIR_FORM(name) extern const PairKernels pair_##name;
LANESCAPE_PAIR_FORMS(LANESCAPE_PAIR_FORM)
#undef LANESCAPE_PAIR_FORM

std::size_t points_within(const PointGrid& grid, const NeighbourQuery& query, std::uint32_t* out, std::size_t capacity) noexcept;
std::size_t probe_first_clear(const ProbeInput& in, const double* clearances, const double* positions, std::size_t count) noexcept;

void state_densities(const StateDensityInput& in, double* densities) noexcept;
double state_lj_energy(const StateLjInput& in) noexcept;
void state_lj_gradient(const StateLjInput& in, double* gradient, double* slopes, PairOutput& out) noexcept;
void state_lj_stress(const StateLjInput& in, double* gradient, double* slopes, PairOutput& out) noexcept;
double state_table_energy(const StateTableInput& in) noexcept;
void state_table_gradient(const StateTableInput& in, double* gradient, double* slopes, PairOutput& out) noexcept;
void state_table_stress(const StateTableInput& in, double* gradient, double* slopes, PairOutput& out) noexcept;
void state_density_gradient(const StateDensityForceInput& in, double* gradient, PairOutput& out) noexcept;
void state_density_stress(const StateDensityForceInput& in, double* gradient, PairOutput& out) noexcept;

bool sphere_any_overlap(const SphereInput& in) noexcept;
std::size_t sphere_pairs_within(const SphereInput& in, double reach, SpherePair* out, std::size_t capacity) noexcept;
double sphere_smallest_gap(const SphereInput& in) noexcept;
bool sphere_list_any_overlap(const SphereList& list, const double* positions, std::size_t slots) noexcept;
std::size_t sphere_list_contacts(const SphereList& list, const double* positions, std::size_t slots,
                                 const SphereContacts& out) noexcept;
void sphere_contact_forces(const SphereList& list, const SphereContacts& contacts, std::size_t count, ContactPotential potential,
                           double* force, std::size_t slots) noexcept;
std::size_t sphere_avoidance_trial(double* trial, const double* position, double* sum, double* force, double step,
                                   std::size_t slots) noexcept;
CollisionEvent sphere_first_collision(const CollisionQuery& query) noexcept;
void calendar_update(const CalendarView& calendar, std::size_t event, double time) noexcept;

double dot(const double* a, const double* b, std::size_t n) noexcept;
double distance_squared(const double* a, const double* b, std::size_t n) noexcept;
void difference(double* out, const double* a, const double* b, std::size_t n) noexcept;
void combine(double* out, const double* x, double a, const double* u, double b, const double* v, std::size_t n) noexcept;
void axpy(double* out, const double* x, double a, const double* u, std::size_t n) noexcept;
DisplacementMoments displacement_moments(const double* a, const double* b, std::size_t slots) noexcept;

void add_particle_lengths(double* lengths, const double* a, const double* b, std::size_t slots) noexcept;
double largest_displacement_squared(const double* a, const double* b, std::size_t slots, std::size_t begin,
                                    std::size_t end) noexcept;

double peak_rounds(std::size_t rounds, double* sink) noexcept;

}  // namespace lanescape::kernels::LANESCAPE_ISA
