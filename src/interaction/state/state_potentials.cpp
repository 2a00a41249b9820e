#include "interaction/state/state_potentials.hpp"

#include <algorithm>
#include <cmath>

#include "interaction/state/state_block.hpp"

namespace lanescape {
namespace {

// energy(input) or gradient(input, records, slopes, sums) of every block, for kernels that differ in their input only.
template <class MakeInput, class Energy, class Gradient>
void add_kernel(Sites& sites, StateSums& sums, MakeInput make_input, Energy energy, Gradient gradient) {
  const auto& list = sites.list();
  const std::size_t states = sites.states();
  std::vector<kernels::PairOutput> blocks(list.block_count());
  const auto scratch = [states] { return BlockScratch(states); };
  sites.for_each_block(scratch, [&](std::size_t b, const kernels::NeighbourRows& rows, BlockScratch& own) {
    const auto input = make_input(list.species_of(b), rows, sites.states_of(rows, own.row_states.data()));
    if (sums.wanted == StateSums::Wanted::energy) {
      blocks[b].energy = energy(input);
      blocks[b].virial = 0.0;
      return;
    }
    gradient(input, own.records.data(), own.slopes.data(), blocks[b]);
    add_rows(sites, rows, own.records.data(), sums.gradient);
    for (std::size_t k = 0; k < rows.row_count; ++k)
      for (std::size_t a = 0; a < states; ++a) sums.slopes[list.slot_at(rows.rows[k]) * states + a] += own.slopes[k * states + a];
  });
  add_blocks(blocks, sums);
}

}  // namespace

void add_rows(const Sites& sites, const kernels::NeighbourRows& rows, const double* records, AlignedArray& gradient) {
  const std::size_t slots = sites.layout().slots();
  for (std::size_t k = 0; k < rows.row_count; ++k) {
    double* g = gradient.data() + sites.list().slot_at(rows.rows[k]);
    for (std::size_t axis = 0; axis < 3; ++axis) g[axis * slots] += records[kernels::point_width * k + axis];
  }
}

void add_blocks(const std::vector<kernels::PairOutput>& blocks, StateSums& sums) {
  double energy = 0.0, virial = 0.0;
  for (const kernels::PairOutput& block : blocks) {
    energy += block.energy;
    virial += block.virial;
    if (sums.wanted == StateSums::Wanted::stress)
      for (std::size_t k = 0; k < 6; ++k) sums.virial_tensor[k] += block.virial_tensor[k];
  }
  sums.energy += energy;
  sums.virial += virial;
}

LennardJonesStates::LennardJonesStates(StatePairs order, const std::vector<Pair>& pairs, std::vector<double> cutoffs)
    : order_(order), cutoffs_(std::move(cutoffs)) {
  const std::size_t per_species_pair = order.states * order.states;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double s6 = std::pow(pairs[k].sigma, 6), c12 = 4.0 * pairs[k].epsilon * s6 * s6, c6 = 4.0 * pairs[k].epsilon * s6;
    const double inverse6 = std::pow(cutoffs_[k / per_species_pair], -6);
    pairs_.push_back({c12, c6, pairs[k].epsilon == 0.0 ? 0.0 : (c12 * inverse6 - c6) * inverse6});
  }
  for (std::size_t k = 0; k < cutoffs_.size(); ++k) {
    const auto first = pairs.begin() + static_cast<std::ptrdiff_t>(k * per_species_pair);
    const bool none = std::all_of(first, first + static_cast<std::ptrdiff_t>(per_species_pair),
                                  [](const Pair& pair) { return pair.epsilon == 0.0; });
    if (none) cutoffs_[k] = 0.0;
    cutoffs_squared_.push_back(cutoffs_[k] * cutoffs_[k]);
  }
}

void LennardJonesStates::add(Sites& sites, StateSums& sums) {
  const auto& table = sites.kernels();
  const auto input = [&](std::size_t s, const kernels::NeighbourRows& rows, const kernels::StateProbabilities& states) {
    return kernels::StateLjInput{rows, states, pairs_.data() + order_.at(s, 0, 0, 0), cutoffs_squared_.data() + s * order_.species};
  };
  const bool stress = sums.wanted == StateSums::Wanted::stress;
  add_kernel(sites, sums, input, table.state_lj_energy, stress ? table.state_lj_stress : table.state_lj_gradient);
}

TabulatedStates::TabulatedStates(StatePairs order, const std::vector<Table>& tables) : order_(order) {
  records_.resize(order.species * order.species);
  for (std::size_t k = 0; k < records_.size(); ++k) join(k, tables);
}

// The tables of one species pair, interval by interval.
void TabulatedStates::join(std::size_t species_pair, const std::vector<Table>& tables) {
  const std::size_t count = order_.states * order_.states;
  std::vector<UniformSpline> splines;
  std::vector<std::size_t> places;
  for (std::size_t ab = 0; ab < count; ++ab) {
    const Table& table = tables[species_pair * count + ab];
    if (table.values.empty()) continue;
    splines.emplace_back(table.first, table.spacing, table.values, std::nullopt, 0.0);
    splines.back().extend_down_to(0.0);
    places.push_back(ab);
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
                  records.data() + kernels::point_width * (k * count + places[u]));
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

PairFunctionStates::PairFunctionStates(std::size_t species, double cutoff, Function u)
    : species_(species), cutoff_(cutoff), u_(std::move(u)) {}

void PairFunctionStates::add(Sites& sites, StateSums& sums) {
  const std::size_t states = sites.states(), slots = sites.layout().slots();
  const auto species_of = [&](std::size_t slot) {
    std::size_t s = species_ - 1;
    while (slot < sites.layout().blocks()[s].begin) --s;
    return s;
  };
  sites.for_each_pair([&](std::size_t i, std::size_t j, const std::array<double, 3>& d) {
    const double r = std::hypot(d[0], d[1], d[2]);
    if (r >= cutoff_) return;
    const auto p_i = sites.site_states().of(i), p_j = sites.site_states().of(j);
    double slope = 0.0;
    for (std::size_t a = 0; a < states; ++a)
      for (std::size_t b = 0; b < states; ++b) {
        const Value u = u_(species_of(i), a, species_of(j), b, r);
        sums.energy += 0.5 * p_i[a] * p_j[b] * u.energy;
        sums.slopes[i * states + a] += p_j[b] * u.energy;
        slope += p_i[a] * p_j[b] * u.slope;
      }
    for (std::size_t axis = 0; axis < 3; ++axis) sums.gradient[axis * slots + i] += slope / r * d[axis];
    sums.add_virial(-slope / r, d, 0.5);
  });
}

void BondedAngles::add(Sites& sites, StateSums& sums) {
  const std::size_t states = sites.states(), slots = sites.layout().slots();
  using Point = std::array<double, 3>;
  const auto separation = [&](std::size_t i, std::size_t j) {
    Point d;
    for (std::size_t axis = 0; axis < 3; ++axis)
      d[axis] = sites.box().nearest_image(axis, sites.positions()[axis * slots + i] - sites.positions()[axis * slots + j]);
    return d;
  };
  const auto dot = [](const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  for (const Angle& angle : angles_) {
    const std::size_t i = sites.layout().slot_of(angle.first), j = sites.layout().slot_of(angle.middle),
                      k = sites.layout().slot_of(angle.last);
    const Point u = separation(i, j), v = separation(k, j);
    const double uu = dot(u, u), vv = dot(v, v), product = std::sqrt(uu * vv);
    const double cosine = std::clamp(dot(u, v) / product, -1.0, 1.0), theta = std::acos(cosine);
    double slope = 0.0;  // dU/dtheta
    for (std::size_t a = 0; a < states; ++a) {
      const double p = sites.site_states().of(j)[a], away = theta - springs_[a].rest;
      const double energy = 0.5 * springs_[a].stiffness * away * away;
      sums.energy += p * energy;
      sums.slopes[j * states + a] += energy;
      slope += p * springs_[a].stiffness * away;
    }
    // A stretched angle has no direction to bend in.
    const double sine = std::max(std::sqrt(1.0 - cosine * cosine), 1e-8), by_cosine = -slope / sine;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double g_i = by_cosine * (v[axis] / product - cosine * u[axis] / uu);
      const double g_k = by_cosine * (u[axis] / product - cosine * v[axis] / vv);
      sums.gradient[axis * slots + i] += g_i;
      sums.gradient[axis * slots + k] += g_k;
      sums.gradient[axis * slots + j] -= g_i + g_k;
      constexpr std::size_t voigt[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
      for (std::size_t other = 0; other < 3; ++other) {
        // r_a f_b and r_b f_a of an angle are the same: each off-diagonal entry is their mean.
        const double virial = -(u[other] * g_i + v[other] * g_k);
        sums.virial_tensor[voigt[axis][other]] += axis == other ? virial : 0.5 * virial;
        if (axis == other) sums.virial += virial;
      }
    }
  }
}

}  // namespace lanescape
