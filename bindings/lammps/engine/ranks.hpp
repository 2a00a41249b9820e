#pragma once

#include <string>
#include <vector>

#include "simulation.hpp"

namespace lanescape_lammps {

// The simulation as the process that searches uses it; the others serve it. Positions and gradients are of all atoms, by number.
class Ranks {
 public:
  // By all processes.
  explicit Ranks(const std::string& input);

  bool is_root() const { return rank_ == 0; }
  const Simulation& simulation() const { return simulation_; }
  // By the processes that do not search: returns when the other one closes.
  void serve();

  // By the process that searches. Throws Failure.
  double evaluate(const double* positions, double* gradient);
  // Where lists were made since the input was read: the bits of energies follow from these and the positions.
  const std::vector<double>& state() const { return placed_; }
  void restore(const double* state, std::size_t count);
  void close();

 private:
  enum class Command : int { place, move, read_again, close };

  std::size_t size() const { return 3 * static_cast<std::size_t>(simulation_.atoms()); }
  // Of all processes.
  void call(Command command, const double* positions);
  bool obey(Command command);
  void place(const double* positions);
  bool has_list_for(const double* positions) const;
  void collect_atoms();
  void collect_forces(double* gradient);

  int rank_ = 0, ranks_ = 1;
  Simulation simulation_;
  std::vector<double> positions_;  // of the last command
  std::vector<double> placed_;     // one configuration after the other
  // Of all processes, on the root: how many numbers, from where, of which atoms; and the forces.
  std::vector<int> counts_, firsts_, atoms_;
  std::vector<double> forces_;
  // The last evaluation.
  std::vector<double> evaluated_, gradient_;
  double energy_ = 0.0;
};

}  // namespace lanescape_lammps
