#pragma once

#include <memory>

#include "interaction/pair/nearest_rows.hpp"
#include "interaction/pair/pair_sums.hpp"
#include "neighbour/exclusions.hpp"

namespace lanescape {

// Other sums less those of excluded pairs at their nearest images, by the same kernels' rows.
class ExcludingSums final : public PairSums {
 public:
  ExcludingSums(std::unique_ptr<PairSums> all, const PairModel& model, const Box& box, const ParticleLayout& layout,
                const kernels::KernelTable& table, std::shared_ptr<const Exclusions> exclusions);

  double energy(const AlignedArray& positions) override;
  void gradient_only(const AlignedArray& positions, AlignedArray& gradient) override;
  void gradient(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) override;
  void stress(const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out) override;
  void set_box(const PairModel& model, const Box& box) override;

 private:
  using RowSum = void (*)(const kernels::PairListInput&, double* gradient, kernels::PairOutput&) noexcept;
  void subtract(RowSum sum, const AlignedArray& positions, AlignedArray& gradient, kernels::PairOutput& out);
  // visit(slot, row) for each particle that has excluded pairs.
  template <class Visit>
  void for_each_row(const AlignedArray& positions, Visit visit);

  std::unique_ptr<PairSums> all_;
  const kernels::PairKernels* kernels_;
  Box box_;
  NearestRows nearest_;
  std::shared_ptr<const Exclusions> exclusions_;
};

}  // namespace lanescape
