#pragma once

#include "isa.hpp"
#include "kernel_table.hpp"

// Every kernel of one instruction set, for table.cpp. Documented at KernelTable's members.
namespace lanescape::kernels::LANESCAPE_ISA {

double lj_energy(const LjInput& in) noexcept;
void lj_gradient(const LjInput& in, double* gradient, LjOutput& out) noexcept;
void lj_stress(const LjInput& in, double* gradient, LjOutput& out) noexcept;

double dot(const double* a, const double* b, std::size_t n) noexcept;
double distance_squared(const double* a, const double* b, std::size_t n) noexcept;
void difference(double* out, const double* a, const double* b, std::size_t n) noexcept;
void combine(double* out, const double* x, double a, const double* u, double b, const double* v, std::size_t n) noexcept;
void axpy(double* out, const double* x, double a, const double* u, std::size_t n) noexcept;
DisplacementMoments displacement_moments(const double* a, const double* b, std::size_t slots) noexcept;

double peak_rounds(std::size_t rounds, double* sink) noexcept;

}  // namespace lanescape::kernels::LANESCAPE_ISA
