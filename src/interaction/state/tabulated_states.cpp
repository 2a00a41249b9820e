#include "interaction/state/tabulated_states.hpp"

#include <algorithm>
#include <optional>

#include "interaction/state/cubic_spline.hpp"
#include "interaction/state/state_block.hpp"

namespace lanescape {

TabulatedStates::TabulatedStates(StatePairs order, const std::vector<Table>& tables) : order_(order) {
  records_.resize(order.species * order.species);
  for (std::size_t k = 0; k < records_.size(); ++k) join(k, tables);
}

// Joins the tables of one species pair, interval by interval.
void TabulatedStates::join(std::size_t species_pair, const std::vector<Table>& tables) {
  const std::size_t count = order_.states * order_.states;
  std::vector<UniformSpline> splines;
  std::vector<std::size_t> offsets;
  for (std::size_t ab = 0; ab < count; ++ab) {
    const Table& table = tables[species_pair * count + ab];
    if (table.values.empty()) continue;
    splines.emplace_back(table.first, table.spacing, table.values, std::nullopt, 0.0);
    splines.back().extend_down_to(0.0);
    offsets.push_back(ab);
  }
  if (splines.empty()) {
    cutoffs_.push_back(0.0);
    tables_.push_back({});
    return;
  }
  const UniformSpline& any = splines.front();
  AlignedArray& records = records_[species_pair];
  records.assign(kernels::point_width * count * (any.intervals() + 1), 0.0);
  for (std::size_t u = 0; u < splines.size(); ++u)
    for (std::size_t k = 0; k < any.intervals(); ++k)
      std::copy_n(splines[u].piece(k).begin(), kernels::point_width,
                  records.data() + kernels::point_width * (k * count + offsets[u]));
  const double cutoff = any.first_knot() + static_cast<double>(any.intervals()) * any.spacing();
  cutoffs_.push_back(cutoff);
  tables_.push_back(
      {{records.data(), 1.0 / any.spacing(), static_cast<double>(any.intervals())}, any.first_knot(), cutoff * cutoff});
}

void TabulatedStates::add(Sites& sites, StateSums& sums) {
  const auto& table = sites.kernels();
  const auto input = [&](std::size_t s, const kernels::NeighbourRows& rows, const kernels::StateProbabilities& states) {
    return kernels::StateTableInput{rows, states, tables_.data() + s * order_.species};
  };
  const bool stress = sums.wanted == StateSums::Wanted::stress;
  add_kernel(sites, sums, input, table.state_table_energy, stress ? table.state_table_stress : table.state_table_gradient);
}

}  // namespace lanescape
