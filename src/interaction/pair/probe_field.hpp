#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "interaction/pair/probe_box.hpp"
#include "kernel_table.hpp"
#include "neighbour/probe_cells.hpp"

namespace lanescape {

// What one more particle would feel in a fluid that stands still. The energy is what the fluid's would rise by if the particle were
// put there: the full sum over the pairs with all others and their images, half of its own images and the growth of the long-range
// correction, which do not depend on the place. Any number of threads may look at a field that nobody changes.
class ProbeField {
 public:
  using Point = std::array<double, 3>;
  struct Sample {
    double energy = 0.0;  // [epsilon]
    Point gradient{};     // [epsilon/sigma]
  };

  // `species`: of the probe. Throws what check_cutoff() throws, and Error(bad_input) for a species that the model does not have,
  // for edges above 10^7 length units, and for the minimum-image rule in a box whose shortest edge is below twice the cutoff, where
  // a probe would feel a jump. O(N). `diameter`: of the probe and of what is put in, where the model's particles have diameters
  // [sigma].
  ProbeField(const PairModel& model, const Configuration& fluid, int species, const kernels::KernelTable& table,
             double diameter = 1.0);

  Sample sample(const Point& position) const;
  double energy(const Point& position) const;
  // Of many positions, x0 y0 z0 x1 ..., to the same bits.
  void energies(std::span<const double> positions, std::span<double> out) const;

  // Per species the distance at which the repulsion alone gives a probe this energy [sigma].
  std::vector<double> clearances(double energy) const;
  // The first of these positions, which are in the box, with no particle nearer than its species' clearance; their number if there
  // is none.
  std::size_t first_clear(std::span<const double> clearances, std::span<const double> positions) const;

  // Changes the fluid. remove() returns whether there was a particle with these coordinates, to the bit once wrapped.
  void insert(const Point& position, int species);
  bool remove(const Point& position, int species);

  // The model's unit of length [sigma].
  double length_unit() const { return box_.unit(); }
  const Box& box() const { return box_.box(); }
  std::size_t size() const;  // particles of the fluid
  int species() const { return species_; }
  double largest_cutoff() const { return largest_cutoff_; }  // of the probe's pairs [sigma]
  double largest_sigma() const { return largest_sigma_; }    // likewise
  // The part of the energy that does not depend on the place, but on how many particles there are [epsilon].
  double constant() const { return constant_; }

 private:
  void put_fluid(const PairModel& model, const Configuration& fluid, double scale);
  // Cells and pair, as the kernels take them; O(species) at every change.
  void refresh();

  const kernels::KernelTable* table_;
  PairModel model_;
  const kernels::PairKernels* kernels_;
  int species_;
  double largest_cutoff_ = 0.0, largest_sigma_ = 0.0;
  ProbeBox box_;
  // From here on lengths are in its unit.
  double diameter_;
  std::vector<ProbeCells> cells_;  // by species
  std::vector<kernels::PairParameters> pairs_;
  std::vector<double> reaches_;  // of pairs_
  std::vector<double> tail_;     // what the energy rises by for each particle there is of a species
  double own_ = 0.0, constant_ = 0.0;
  std::vector<kernels::ProbeSpecies> views_;
};

}  // namespace lanescape
