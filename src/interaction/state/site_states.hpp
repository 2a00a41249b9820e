#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"
#include "core/point.hpp"
#include "kernel_table.hpp"
#include "neighbour/list_blocks.hpp"
#include "neighbour/neighbour_rows.hpp"

// Energies that depend on positions also through the states of sites ([P] Eq. 1): U(p(R), R), where p_ia is the probability of site
// i to be in state a. Probabilities and energies are independent parts. A response gives p and receives dU/dp; a potential receives
// p and gives dU/dp and the forces at fixed p. Any response works with any potential.
namespace lanescape {

// The probabilities of every site, site by site.
struct SiteStates {
  std::size_t states = 1;
  AlignedArray p;  // slots x states; zero for padding

  std::span<double> of(std::size_t slot) { return {p.data() + slot * states, states}; }
  std::span<const double> of(std::size_t slot) const { return {p.data() + slot * states, states}; }
};

// Positions, neighbours and states of all sites: the view that order parameters and potentials have of a system. Everything is in
// the layout's order.
class Sites {
 public:
  struct Options {
    int threads = 1;
    double skin = 0.0;                                                         // of the list [sigma]
    NeighbourList::Members members = NeighbourList::Members::with_own_images;  // or every point
  };
  // `reaches`: the distance within which sites are listed, species x species, symmetric [sigma].
  Sites(const Box& box, const ParticleLayout& layout, std::vector<double> reaches, std::size_t states,
        const kernels::KernelTable& table, const Options& options);

  void set_box(const Box& box);
  void move_to(const AlignedArray& positions);
  double furthest() const;  // the longest reach

  const Box& box() const { return box_; }
  const ParticleLayout& layout() const { return layout_; }
  const kernels::KernelTable& kernels() const { return *table_; }
  std::size_t species() const { return layout_.blocks().size(); }
  std::size_t states() const { return states_.states; }
  const AlignedArray& positions() const { return positions_; }
  NeighbourList& list() { return list_; }
  const NeighbourList& list() const { return list_; }
  SiteStates& site_states() { return states_; }
  const SiteStates& site_states() const { return states_; }

  // Calls visit(slot, other's slot, r - r_other) for each pair of the list, once from each end, with images as separate sites. Some
  // pairs are out of reach. Runs on one thread.
  template <class Visit>
  void for_each_pair(Visit visit) const;

  // Calls body(block, its rows, scratch) for each block; threads share the blocks and each makes one scratch. Rows have the list's
  // neighbours, or those within reach now once use_near() has been called since move_to().
  template <class MakeScratch, class Body>
  void for_each_block(MakeScratch make_scratch, Body body) const;
  // Store a number of each site, or the probabilities that kernels need, in the records of points.
  void put_values(const AlignedArray& per_slot) { list_.set_values(per_slot, 1); }
  void put_states();
  // Room for the neighbours within reach of a block, for kernels::KernelTable::state_densities. Fill it for all blocks or for none.
  struct Near {
    std::uint32_t *places, *lengths;
    double* slopes;
    const double* reaches_squared;
  };
  Near near(std::size_t block);
  void use_near() { near_known_ = true; }
  // `row_states`: room for block_rows x states, overwritten.
  kernels::StateProbabilities states_of(const kernels::NeighbourRows& rows, double* row_states) const;

  void exchange(Archive& archive) { list_.exchange(archive); }

 private:
  Box box_;
  ParticleLayout layout_;
  const kernels::KernelTable* table_;
  NeighbourList list_;
  AlignedArray positions_;
  std::vector<double> reaches_squared_;
  bool near_known_ = false;
  std::vector<AlignedVector<std::uint32_t>> near_;  // arranged as the list's neighbours
  std::vector<AlignedArray> near_slopes_;
  AlignedVector<std::uint32_t> near_lengths_;  // of all blocks
  SiteStates states_;
  AlignedArray groups_;  // for three states or more: groups of four states of all points
};

// The sums to which each part adds.
struct StateSums {
  enum class Wanted { energy, gradient, stress };

  Wanted wanted;
  AlignedArray& gradient;  // dU/dr, 3 x slots; unused if only the energy is wanted
  AlignedArray& slopes;    // dU/dp, slots x states; likewise
  double energy = 0.0;
  double virial = 0.0;                    // sum r.f
  std::array<double, 6> virial_tensor{};  // if the stress is wanted

  // Adds the virial of a pair, or of one end at half the weight; force_over_r = -u'/r.
  void add_virial(double force_over_r, const Point& d, double weight);
};

// One number per site, on which its state depends.
class OrderParameter {
 public:
  virtual ~OrderParameter() = default;
  // The reach for each pair of species, species x species [sigma]; empty without neighbours.
  virtual std::vector<double> reaches() const { return {}; }
  virtual void evaluate(Sites& sites, AlignedArray& values) = 0;  // per slot
  // Adds multipliers[slot] d value[slot]/dr to the gradient, for all sites, and its virial.
  virtual void add_gradient(Sites& sites, const AlignedArray& multipliers, StateSums& sums) = 0;
};

// One state of one site: p, dp/d(order parameter), ln p. The logarithm stays finite where p underflows to zero; it is not used
// where the slope is zero.
struct StateProbability {
  double p = 0.0, slope = 0.0, logarithm = 0.0;
};

// The probabilities of a site's states as functions of its order parameter. They add up to one.
class StateResponse {
 public:
  virtual ~StateResponse() = default;
  virtual std::size_t states() const = 0;
  virtual void evaluate(std::size_t species, double value, std::span<StateProbability> states) const = 0;
};

// A potential of two or more sites that depends on their states.
class StatePotential {
 public:
  virtual ~StatePotential() = default;
  virtual std::vector<double> reaches() const { return {}; }  // as OrderParameter's
  // How many sites' probabilities each term has as factors: a pair has two. Each of them has an equal share of the term's energy
  // (StateMixture::energies()).
  virtual double factors() const { return 2.0; }
  // Adds energy, gradient and virial at the probabilities sites.site_states(), and dU/dp. Called in every step, with output or
  // without.
  virtual void add(Sites& sites, StateSums& sums) = 0;
};

template <class Visit>
void Sites::for_each_pair(Visit visit) const {
  for (std::size_t b = 0; b < list_.block_count(); ++b) {
    const kernels::NeighbourRows rows = list_.rows_of(b);
    for_each_neighbour(rows, [&](std::size_t row, std::size_t, std::uint32_t neighbour) {
      const double *own = rows.points + rows.rows[row], *other = rows.points + neighbour;
      visit(std::size_t{list_.slot_at(rows.rows[row])}, std::size_t{list_.slot_at(neighbour)},
            Point{own[0] - other[0], own[1] - other[1], own[2] - other[2]});
    });
  }
}

template <class MakeScratch, class Body>
void Sites::for_each_block(MakeScratch make_scratch, Body body) const {
  lanescape::for_each_block(list_, make_scratch, [&](std::size_t b, auto& scratch) {
    kernels::NeighbourRows rows = list_.rows_of(b);
    if (near_known_) {
      rows.neighbours = near_[list_.array_of(b)].data() + list_.first_neighbour(b);
      rows.lengths = near_lengths_.data() + NeighbourList::block_rows * rows.species_count * b;
    }
    body(b, rows, scratch);
  });
}

}  // namespace lanescape
