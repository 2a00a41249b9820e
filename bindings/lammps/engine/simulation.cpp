#include "simulation.hpp"

#include <mpi.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

#include <lammps/library.h>
#include <lammps/lmptype.h>

namespace lanescape_lammps {
namespace {

int rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

// LAMMPS without exceptions ends the process where it fails. Its message is then in the log of the input.
class LastWords {
 public:
  // Never destroyed: it speaks at the end of the process.
  static LastWords& instance() {
    static LastWords* const words = new LastWords;
    return *words;
  }
  const std::string& file() const { return file_; }
  // While this is on, the end of the process is a failure.
  void listen(bool on) { listening_ = on; }
  // The line with the error in the log.
  std::string error() const {
    std::ifstream log(file_);
    std::string found = "it has ended without a message";
    for (std::string line; std::getline(log, line);)
      if (line.starts_with("ERROR")) found = line;
    return found;
  }
  void forget() { std::filesystem::remove(file_); }

 private:
  LastWords()
      : file_((std::filesystem::temp_directory_path() / ("lanescape-lammps-" + std::to_string(::getpid()) + ".log")).string()) {
    std::atexit([] {
      LastWords& words = instance();
      if (!words.listening_) return;
      if (words.is_root_) std::fprintf(stderr, "lanescape: LAMMPS: %s\n", words.error().c_str());
      words.forget();
      ::_exit(2);
    });
  }
  std::string file_;
  bool listening_ = false;
  bool is_root_ = rank() == 0;
};

template <class Value>
const Value* global(void* lammps, const char* name) {
  return static_cast<const Value*>(lammps_extract_global(lammps, name));
}

template <class Value>
Value* of_atoms(void* lammps, const char* name) {
  return static_cast<Value*>(lammps_extract_atom(lammps, name));
}

// LAMMPS's own by its units; 0 is none.
double skin_of(const std::string& units) {
  constexpr std::pair<const char*, double> skins[] = {{"lj", 0.3},  {"real", 2.0},     {"metal", 2.0}, {"si", 0.001},
                                                      {"cgs", 0.1}, {"electron", 2.0}, {"micro", 0.1}, {"nano", 0.1}};
  for (const auto& [name, skin] : skins)
    if (units == name) return skin;
  return 0.0;
}

// The sum over processes of arrays that hold 0 where another one knows the number.
template <class Number>
void add_up(std::vector<Number>& numbers, MPI_Datatype type) {
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), type, MPI_SUM, MPI_COMM_WORLD);
}

}  // namespace

Simulation::Simulation(std::string input) : input_(std::move(input)) {
  if (!std::ifstream(input_)) throw Failure(input_ + ": there is no such file, or it cannot be read");
  LastWords& words = LastWords::instance();
  std::vector<std::string> arguments = {"lanescape", "-screen", "none", "-log", words.file()};
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  lammps_ = lammps_open_no_mpi(static_cast<int>(pointers.size()), pointers.data(), nullptr);
  if (lammps_ == nullptr) throw Failure("LAMMPS cannot be started");
  try {
    read();
    check();
  } catch (...) {
    lammps_close(lammps_);
    words.forget();
    throw;
  }
  words.forget();
}

Simulation::~Simulation() {
  LastWords::instance().listen(false);
  lammps_close(lammps_);
}

void Simulation::command(const std::string& line) {
  LastWords& words = LastWords::instance();
  words.listen(true);
  lammps_command(lammps_, line.c_str());
  words.listen(false);
  if (lammps_has_error(lammps_) == 0) return;
  std::array<char, 1024> message{};
  lammps_get_last_error_message(lammps_, message.data(), static_cast<int>(message.size()));
  std::string text = message.data();
  text.erase(std::find(text.begin(), text.end(), '\n'), text.end());
  throw Failure(text);
}

void Simulation::read() {
  command("include " + input_);
  command("log none");
  atoms_ = static_cast<int>(lammps_get_natoms(lammps_));
  std::array<double, 3> upper{};
  double xy = 0.0, yz = 0.0, xz = 0.0;
  std::array<int, 3> periodic{};
  int box_changes = 0;
  if (atoms_ < 1) throw Failure(input_ + " makes no atoms");
  lammps_extract_box(lammps_, corner_.data(), upper.data(), &xy, &yz, &xz, periodic.data(), &box_changes);
  for (std::size_t axis = 0; axis < 3; ++axis) box_[axis] = upper[axis] - corner_[axis];
  if (xy != 0.0 || yz != 0.0 || xz != 0.0 || periodic != std::array{1, 1, 1})
    throw Failure(input_ + ": the box must be orthogonal and periodic along all axes");
  const char* units = global<char>(lammps_, "units");
  units_ = units == nullptr ? "unknown" : units;
  skin_ = skin_of(units_);
  if (skin_ == 0.0) throw Failure(input_ + ": units " + units_ + " are unknown");
  // The energy of all atoms, in every step, and neighbours when they are asked for.
  command("neighbor " + std::to_string(skin_) + " bin");
  for (const char* line :
       {"thermo_style custom step pe", "thermo_modify norm no", "thermo 1", "neigh_modify once yes", "timestep 0.0"})
    command(line);
}

void Simulation::check() const {
  std::vector<int> seen(static_cast<std::size_t>(atoms_), 0);
  for (const int atom : own_atoms())
    if (atom >= 0 && atom < atoms_) ++seen[static_cast<std::size_t>(atom)];
  add_up(seen, MPI_INT);
  if (std::any_of(seen.begin(), seen.end(), [](int times) { return times != 1; }))
    throw Failure(input_ + ": atoms must be numbered from 1 to " + std::to_string(atoms_));
}

void Simulation::read_again() {
  command("clear");
  read();
}

int Simulation::own() const { return *global<int>(lammps_, "nlocal"); }

std::vector<int> Simulation::own_atoms() const {
  const auto* tags = of_atoms<const LAMMPS_NS::tagint>(lammps_, "id");
  std::vector<int> atoms;
  for (int i = 0; i < own(); ++i) atoms.push_back(static_cast<int>(tags[i]) - 1);
  return atoms;
}

std::vector<int> Simulation::types() const {
  const int* types = of_atoms<const int>(lammps_, "type");
  std::vector<int> all(static_cast<std::size_t>(atoms_), 0);
  for (const int atom : own_atoms()) all[static_cast<std::size_t>(atom)] = *types++;
  add_up(all, MPI_INT);
  return all;
}

std::vector<double> Simulation::masses() const {
  const double* of_type = of_atoms<const double>(lammps_, "mass");
  if (of_type == nullptr) return {};
  std::vector<double> masses;
  for (const int type : types()) masses.push_back(of_type[type]);
  return masses;
}

double* const* Simulation::positions() const { return of_atoms<double*>(lammps_, "x"); }

const double* Simulation::own_forces() const { return own() == 0 ? nullptr : of_atoms<double*>(lammps_, "f")[0]; }

void Simulation::run(const std::string& line) {
  command(line);
  energy_ = lammps_get_thermo(lammps_, "pe");
}

void Simulation::place(const double* given) {
  double* const* x = positions();
  const std::vector<int> atoms = own_atoms();
  for (std::size_t i = 0; i < atoms.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double r = given[3 * static_cast<std::size_t>(atoms[i]) + axis];
      x[i][axis] = r - std::floor((r - corner_[axis]) / box_[axis]) * box_[axis];
    }
  command("displace_atoms all move 0.0 0.0 0.0 units box");  // brings atoms to their processes from anywhere
  run("run 0 post no");
  find_shifts(given);
}

void Simulation::find_shifts(const double* given) {
  double* const* x = positions();
  shifts_.clear();
  for (std::size_t i = 0; const int atom : own_atoms()) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      shifts_.push_back(std::round((given[3 * static_cast<std::size_t>(atom) + axis] - x[i][axis]) / box_[axis]) * box_[axis]);
    ++i;
  }
}

void Simulation::move(const double* given) {
  double* const* x = positions();
  const auto* tags = of_atoms<const LAMMPS_NS::tagint>(lammps_, "id");
  const auto count = shifts_.size() / 3;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      x[i][axis] = given[3 * (static_cast<std::size_t>(tags[i]) - 1) + axis] - shifts_[3 * i + axis];
  run("run 1 pre no post no");
  if (checked_) return;
  check_at(given);
  checked_ = true;
}

void Simulation::check_at(const double* given) const {
  double* const* x = positions();
  int moved = 0;
  for (std::size_t i = 0; const int atom : own_atoms()) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (x[i][axis] != given[3 * static_cast<std::size_t>(atom) + axis] - shifts_[3 * i + axis]) moved = 1;
    ++i;
  }
  MPI_Allreduce(MPI_IN_PLACE, &moved, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  if (moved != 0) throw Failure(input_ + " has a fix that moves atoms: a landscape has none");
}

}  // namespace lanescape_lammps
