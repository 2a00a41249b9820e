#pragma once

#include "pair_forms.hpp"
#include "views/pair.hpp"
#include "views/probe.hpp"

namespace lanescape::kernels {

// All loops over one pair potential.
struct PairKernels {
  bool in_box_units;  // PairInput::unit may be box

  // Over all pairs. The three give bit-equal energies and virials.
  double (*energy)(const PairInput&) noexcept;
  void (*gradient)(const PairInput&, double* gradient, PairOutput&) noexcept;
  void (*stress)(const PairInput&, double* gradient, PairOutput&) noexcept;

  // Over a neighbour list, for rows [0, row_count); energy and virial are these rows' share: half of each of their pairs.
  // `gradient` gets a point per row. The four agree to the bit in what they have in common.
  double (*list_energy)(const PairListInput&) noexcept;
  void (*list_force)(const PairListInput&, double* gradient) noexcept;
  void (*list_gradient)(const PairListInput&, double* gradient, PairOutput&) noexcept;
  void (*list_stress)(const PairListInput&, double* gradient, PairOutput&) noexcept;
  // The same in mixed precision, which needs NeighbourRows::fixed_points: pairs in single precision, sums over all but the lanes of
  // one row in double. A pair nearer to the cutoff than 2^-22 of it may or may not count. The three agree to the bit in what they
  // have in common.
  double (*list_energy_mixed)(const PairListInput&) noexcept;
  void (*list_force_mixed)(const PairListInput&, double* gradient) noexcept;
  void (*list_gradient_mixed)(const PairListInput&, double* gradient, PairOutput&) noexcept;

  // What a particle that is not in the fluid would feel at a position; the energies of many, x0 y0 z0 x1 ..., to the same bits.
  void (*probe)(const ProbeInput&, const double* position, ProbeOutput&) noexcept;
  void (*probe_energies)(const ProbeInput&, const double* positions, std::size_t count, double* energies) noexcept;
};

}  // namespace lanescape::kernels
