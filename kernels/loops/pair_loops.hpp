#pragma once

#include "loops/all_pairs.hpp"
#include "loops/clusters.hpp"
#include "loops/list.hpp"
#include "loops/list_mixed.hpp"
#include "loops/probe.hpp"
#include "pair_kernels.hpp"

// All loops over one form, as the table of kernels holds them.
namespace lanescape::kernels::LANESCAPE_ISA {

template <template <class> class Form>
struct PairLoops {
  using Exact = Form<Vector>;

  static double all_pairs_energy(const PairInput& in) noexcept {
    PairOutput out;
    sum_all_pairs<Exact, Output::energy>(in, nullptr, out);
    return out.energy;
  }
  template <Output output>
  static void all_pairs(const PairInput& in, double* gradient, PairOutput& out) noexcept {
    sum_all_pairs<Exact, output>(in, gradient, out);
  }
  static double list_energy(const PairListInput& in) noexcept {
    PairOutput out;
    sum_list<Exact, Output::energy>(in, nullptr, out);
    return out.energy;
  }
  static void list_force(const PairListInput& in, double* gradient) noexcept {
    Totals totals;
    list_rows<Exact, Output::force>(in, gradient, totals);
  }
  template <Output output>
  static void list(const PairListInput& in, double* gradient, PairOutput& out) noexcept {
    sum_list<Exact, output>(in, gradient, out);
  }
  static double list_energy_mixed(const PairListInput& in) noexcept {
    PairOutput out;
    sum_list_mixed<Form, Output::energy>(in, nullptr, out);
    return out.energy;
  }
  static void list_force_mixed(const PairListInput& in, double* gradient) noexcept {
    Totals totals;
    mixed_rows<Form, Output::force>(in, gradient, totals);
  }
  static void list_gradient_mixed(const PairListInput& in, double* gradient, PairOutput& out) noexcept {
    sum_list_mixed<Form, Output::gradient>(in, gradient, out);
  }
  static double cluster_energy(const ClusterInput& in) noexcept {
    Totals totals;
    sum_clusters<Form, Output::energy>(in, nullptr, totals);
    return reduce_add(totals.energy);
  }
  static void cluster_force(const ClusterInput& in, float* gradients) noexcept {
    Totals totals;
    sum_clusters<Form, Output::force>(in, gradients, totals);
  }
  static void cluster_gradient(const ClusterInput& in, float* gradients, PairOutput& out) noexcept {
    Totals totals;
    sum_clusters<Form, Output::gradient>(in, gradients, totals);
    out.energy = reduce_add(totals.energy);
    out.virial = reduce_add(totals.virial);
  }
  static void probe(const ProbeInput& in, const double* position, ProbeOutput& out) noexcept {
    out.energy = sum_probe<Exact, Output::gradient>(in, position, out.gradient);
  }
  static void probe_energies(const ProbeInput& in, const double* positions, std::size_t count, double* energies) noexcept {
    for (std::size_t k = 0; k < count; ++k) energies[k] = sum_probe<Exact, Output::energy>(in, positions + 3 * k, nullptr);
  }

  static constexpr PairKernels kernels() noexcept {
    PairKernels kernels{.in_box_units = Exact::specialised,
            .energy = all_pairs_energy,
            .gradient = all_pairs<Output::gradient>,
            .stress = all_pairs<Output::stress>,
            .list_energy = list_energy,
            .list_force = list_force,
            .list_gradient = list<Output::gradient>,
            .list_stress = list<Output::stress>,
            .list_energy_mixed = list_energy_mixed,
            .list_force_mixed = list_force_mixed,
            .list_gradient_mixed = list_gradient_mixed,
            .cluster_energy = nullptr,
            .cluster_force = nullptr,
            .cluster_gradient = nullptr,
            .probe = probe,
            .probe_energies = probe_energies};
    if constexpr (!Exact::has_diameters) {
      kernels.cluster_energy = cluster_energy;
      kernels.cluster_force = cluster_force;
      kernels.cluster_gradient = cluster_gradient;
    }
    return kernels;
  }
};

}  // namespace lanescape::kernels::LANESCAPE_ISA
