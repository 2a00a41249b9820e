#pragma once

#include "pair_forms.hpp"
#include "views/cluster.hpp"
#include "views/pair.hpp"
#include "views/probe.hpp"

namespace lanescape::kernels {

// All loops over one pair potential.
struct PairKernels {
  bool in_box_units;  // whether PairInput::unit may be box

  // Over all pairs. The three give the same energies and virials to the bit.
  double (*energy)(const PairInput&) noexcept;
  void (*gradient)(const PairInput&, double* gradient, PairOutput&) noexcept;
  void (*stress)(const PairInput&, double* gradient, PairOutput&) noexcept;

  // Over a neighbour list, for rows [0, row_count). Energy and virial are these rows' share: half of each of their pairs.
  // `gradient` gets a point per row. Results that several of the four compute agree to the bit.
  double (*list_energy)(const PairListInput&) noexcept;
  void (*list_force)(const PairListInput&, double* gradient) noexcept;
  void (*list_gradient)(const PairListInput&, double* gradient, PairOutput&) noexcept;
  void (*list_stress)(const PairListInput&, double* gradient, PairOutput&) noexcept;
  // The same in mixed precision, which needs NeighbourRows::fixed_points: pairs in single precision, all sums in double except
  // those over the lanes of one row. A pair whose distance differs from the cutoff by less than a fraction 2^-22 may or may not
  // count. Results that several of the three compute agree to the bit.
  double (*list_energy_mixed)(const PairListInput&) noexcept;
  void (*list_force_mixed)(const PairListInput&, double* gradient) noexcept;
  void (*list_gradient_mixed)(const PairListInput&, double* gradient, PairOutput&) noexcept;

  // Over clusters, in mixed precision as above, but each pair once: energy and virial are those of all pairs of the lists, and
  // gradients, in 1/fixed_unit, are added to records with the offsets of the points'. Results that several of the three compute
  // agree to the bit. Null for a form that has diameters.
  double (*cluster_energy)(const ClusterInput&) noexcept;
  void (*cluster_force)(const ClusterInput&, float* gradients) noexcept;
  void (*cluster_gradient)(const ClusterInput&, float* gradients, PairOutput&) noexcept;

  // What a particle outside the fluid would feel at a position; and the energies at many positions, x0 y0 z0 x1 ..., with the same
  // bits.
  void (*probe)(const ProbeInput&, const double* position, ProbeOutput&) noexcept;
  void (*probe_energies)(const ProbeInput&, const double* positions, std::size_t count, double* energies) noexcept;
};

}  // namespace lanescape::kernels
