#pragma once

#include <cstddef>
#include <vector>

#include "configuration/pair_model.hpp"
#include "core/aligned_array.hpp"
#include "kernel_table.hpp"
#include "neighbour/host_rows.hpp"

namespace lanescape {

// Throws Error(bad_input) for what potentials without a box do not know: diameters of particles, long-range corrections.
void check_without_box(const PairModel& model);

// A pair potential over lists that a host has made. Bits do not depend on the number of threads.
class HostListSums {
 public:
  // What lists hold, and of what energy the gradient is.
  enum class Lists {
    rows,      // all neighbours of each point with a list; each point's own gradient, as if ghosts had lists too
    gradient,  // the same; the gradient of the energy below: half of each pair with a ghost, ghosts' included
    half       // each pair once
  };

  // `model` in a unit of its own, to which positions and results refer. Throws what check_without_box() does, and
  // Error(bad_input) for more species than HostRows takes.
  HostListSums(const PairModel& model, const kernels::KernelTable& table, Lists lists, int threads);

  // Throws Error(bad_input) for points that do not exist; there is then no list.
  void set_lists(const HostLists& lists);
  std::size_t size() const { return size_; }
  // Records of kernels::point_width doubles: x y z and an unused number of each point, to be written before what follows.
  AlignedArray& points() { return points_; }

  // Half of each pair for each of its ends that has a list; of `half` lists each pair. Gradients are written to records like those
  // of points, zero where nothing acts.
  double energy();
  void gradient(AlignedArray& gradient);
  kernels::PairOutput energy_and_gradient(AlignedArray& gradient);
  kernels::PairOutput energy_and_stress(AlignedArray& gradient);  // virial_tensor too
  // Of each point, half of each of its pairs; of ghosts without lists nothing.
  void energies(AlignedArray& energies);

 private:
  // Rows and the part of their pairs that counts.
  struct Part {
    HostRows rows;
    double weight;
  };
  template <class Sum>
  kernels::PairOutput sum_gradient(AlignedArray& gradient, const Sum& sum);
  kernels::PairListInput input(const Part& part, std::size_t block) const;

  const kernels::PairKernels* kernels_;
  Lists lists_;
  int threads_;
  std::vector<kernels::PairParameters> pairs_;
  std::size_t species_;
  std::vector<Part> parts_;
  std::size_t size_ = 0;
  std::vector<int> ghosts_;  // without a list, of lists other than `half`
  AlignedArray points_;
  std::vector<kernels::PairOutput> sums_;  // of each block
};

}  // namespace lanescape
