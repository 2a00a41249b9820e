#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "interaction/pair/probe_box.hpp"
#include "kernel_table.hpp"
#include "neighbour/probe_cells.hpp"

namespace lanescape {

// Moves of one particle at a time, for Monte Carlo. What a move would change the energy by costs the particle's neighbours at its
// two places; N does not matter. Own images and long-range corrections do not change with a move. Double precision. Each caller's
// thread needs its own.
class PairMoves {
 public:
  // Throws what check_cutoff() and ProbeBox::check() throw, and Error(bad_input) for a coordinate that is not finite. O(N).
  PairMoves(const PairModel& model, const Configuration& configuration, const kernels::KernelTable& table);

  // By how much the energy would rise if this particle, from 0, were put there while all others stand still [epsilon]. Not finite
  // where two particles are at one place. Throws Error(bad_input) for a coordinate that is not finite.
  double energy_change(std::size_t particle, const Point& to);
  // Makes the last move that was asked for; the next one starts from there.
  void accept();

  // As given, and `to` of the moves that were made: x0 y0 z0 x1 ... [sigma].
  const std::vector<double>& positions() const { return positions_; }
  std::size_t size() const { return species_.size(); }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  void put_pairs(const PairModel& model, double scale);
  void put_particles(const PairModel& model, const Configuration& configuration);
  // Takes one particle out of the fluid, and puts back the one before.
  void lift(std::size_t particle);
  void refresh(std::size_t species);
  // Of the lifted particle's pairs at a place in the box.
  double energy_at(const Point& home) const;
  double diameter_of(std::size_t particle) const { return diameters_.empty() ? 0.0 : diameters_[particle]; }

  ProbeBox box_;
  const kernels::PairKernels* kernels_;
  std::vector<std::size_t> species_;
  std::vector<double> positions_;
  std::size_t species_count_;
  // From here on lengths are in the box's unit.
  std::vector<double> diameters_;             // none for forms without
  std::vector<Point> homes_;                  // in the box
  std::vector<ProbeCells> cells_;             // by species; without the lifted particle
  std::vector<kernels::ProbeSpecies> views_;  // species of the probe x species
  std::size_t lifted_ = none;
  Point to_{}, to_home_{};  // the last move
  double here_ = 0.0, there_ = 0.0;
};

}  // namespace lanescape
