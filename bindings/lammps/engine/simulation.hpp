#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace lanescape_lammps {

// What LAMMPS says of a failure, in one line.
struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The system of a LAMMPS input on this process and those beside it. All members are called by all processes at once.
//
// Neighbours are found only when place() is called: between these calls the order of atoms and so all bits stay the same.
class Simulation {
 public:
  // Throws Failure for an input that LAMMPS refuses, and for a system that is no landscape in a periodic orthogonal box.
  explicit Simulation(std::string input);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  int atoms() const { return atoms_; }
  const std::array<double, 3>& box() const { return box_; }
  const std::string& units() const { return units_; }
  // Neighbours last until an atom has moved by half of this.
  double skin() const { return skin_; }
  // By atoms, on all processes: types; masses, or nothing where atoms have their own.
  std::vector<int> types() const;
  std::vector<double> masses() const;

  // Reads the input again: all that follows is as it was after the first time.
  void read_again();
  // Puts all atoms, by their numbers, at these positions and finds their neighbours.
  void place(const double* positions);
  // Moves all atoms to positions near those of the last place().
  void move(const double* positions);
  // Of the last place() or move().
  double energy() const { return energy_; }
  // Of this process: how many atoms, which (from 0), and the forces on them, 3 numbers each.
  int own() const;
  std::vector<int> own_atoms() const;
  const double* own_forces() const;

 private:
  void read();
  void check() const;
  void command(const std::string& line);
  void run(const std::string& line);
  void set_positions(const double* positions, bool wrapped);
  // Whole boxes between the given positions and LAMMPS's, of its atoms.
  void find_shifts(const double* positions);
  void check_at(const double* positions) const;
  double* const* positions() const;

  std::string input_;
  void* lammps_ = nullptr;
  int atoms_ = 0;
  std::array<double, 3> box_{}, corner_{};
  std::string units_;
  double skin_ = 0.0;
  std::vector<double> shifts_;
  double energy_ = 0.0;
  bool checked_ = false;
};

}  // namespace lanescape_lammps
