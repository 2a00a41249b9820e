#include "ranks.hpp"

#include <mpi.h>

#include <algorithm>
#include <csignal>
#include <span>

namespace lanescape_lammps {
namespace {

// Lists that are kept before the input is read again: resumption makes each of them.
constexpr std::size_t most_placed = 32;

}  // namespace

Ranks::Ranks(const std::string& input) : simulation_(input) {
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
  positions_.resize(size());
  counts_.resize(static_cast<std::size_t>(ranks_));
  firsts_.resize(counts_.size());
  atoms_.resize(size() / 3);
  forces_.resize(size());
  gradient_.resize(size());
}

void Ranks::serve() {
  // The process that searches saves its state first, and then closes.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  for (;;) {
    int command = 0;
    MPI_Bcast(&command, 1, MPI_INT, 0, MPI_COMM_WORLD);
    if (!obey(static_cast<Command>(command))) return;
  }
}

void Ranks::call(Command command, const double* positions) {
  if (positions != nullptr) std::copy_n(positions, size(), positions_.data());
  int number = static_cast<int>(command);
  MPI_Bcast(&number, 1, MPI_INT, 0, MPI_COMM_WORLD);
  obey(command);
}

bool Ranks::obey(Command command) {
  if (command == Command::close) return false;
  if (command == Command::read_again) {
    simulation_.read_again();
    return true;
  }
  MPI_Bcast(positions_.data(), static_cast<int>(size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  if (command == Command::place) {
    simulation_.place(positions_.data());
    collect_atoms();
  } else {
    simulation_.move(positions_.data());
  }
  const int own = 3 * simulation_.own();
  MPI_Gatherv(simulation_.own_forces(), own, MPI_DOUBLE, forces_.data(), counts_.data(), firsts_.data(), MPI_DOUBLE, 0,
              MPI_COMM_WORLD);
  return true;
}

void Ranks::collect_atoms() {
  const std::vector<int> own = simulation_.own_atoms();
  const int count = static_cast<int>(own.size());
  MPI_Gather(&count, 1, MPI_INT, counts_.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  for (std::size_t r = 1; r < firsts_.size(); ++r) firsts_[r] = firsts_[r - 1] + counts_[r - 1];
  MPI_Gatherv(own.data(), count, MPI_INT, atoms_.data(), counts_.data(), firsts_.data(), MPI_INT, 0, MPI_COMM_WORLD);
  for (int& c : counts_) c *= 3;
  for (int& f : firsts_) f *= 3;
}

bool Ranks::has_list_for(const double* positions) const {
  if (placed_.empty()) return false;
  const double* listed = placed_.data() + placed_.size() - size();
  const double limit = 0.25 * simulation_.skin() * simulation_.skin();
  for (std::size_t k = 0; k < size(); k += 3) {
    const double x = positions[k] - listed[k], y = positions[k + 1] - listed[k + 1], z = positions[k + 2] - listed[k + 2];
    if (!(x * x + y * y + z * z <= limit)) return false;
  }
  return true;
}

void Ranks::place(const double* positions) {
  if (placed_.size() == most_placed * size()) {
    call(Command::read_again, nullptr);
    placed_.clear();
  }
  placed_.insert(placed_.end(), positions, positions + size());
  call(Command::place, positions);
}

double Ranks::evaluate(const double* positions, double* gradient) {
  const std::span<const double> given(positions, size());
  if (!std::ranges::equal(evaluated_, given)) {
    evaluated_.clear();
    if (has_list_for(positions))
      call(Command::move, positions);
    else
      place(positions);
    energy_ = simulation_.energy();
    for (std::size_t i = 0; i < atoms_.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        gradient_[3 * static_cast<std::size_t>(atoms_[i]) + axis] = -forces_[3 * i + axis];
    evaluated_.assign(given.begin(), given.end());
  }
  std::ranges::copy(gradient_, gradient);
  return energy_;
}

void Ranks::restore(const double* state, std::size_t count) {
  if (count % size() != 0 || count > most_placed * size()) throw Failure("the state is that of another system");
  evaluated_.clear();
  if (!placed_.empty()) call(Command::read_again, nullptr);
  placed_.clear();
  for (const double* positions = state; positions != state + count; positions += size()) place(positions);
}

void Ranks::close() { call(Command::close, nullptr); }

}  // namespace lanescape_lammps
