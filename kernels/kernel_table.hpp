#pragma once

#include "pair_kernels.hpp"
#include "views/cluster.hpp"
#include "views/flight.hpp"
#include "views/grid.hpp"
#include "views/layout.hpp"
#include "views/pair.hpp"
#include "views/panel.hpp"
#include "views/probe.hpp"
#include "views/sphere.hpp"
#include "views/state.hpp"

namespace lanescape::kernels {

// All kernels of one instruction set: function pointers with the names in kernel_list.def, which documents them.
struct KernelTable {
  const char* name;
  std::size_t lanes;                // doubles per vector
  std::size_t sphere_pair_columns;  // see SpherePair

  // Loops over pair potentials, indexed by PairForm.
  const PairKernels* pair[pair_form_count];
  const PairKernels& pair_kernels(PairForm form) const noexcept { return *pair[static_cast<std::size_t>(form)]; }

#define LANESCAPE_KERNEL(result, kernel, arguments) result(*kernel) arguments noexcept;
#include "kernel_list.def"
#undef LANESCAPE_KERNEL
};

}  // namespace lanescape::kernels
