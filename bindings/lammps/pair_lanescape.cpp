#include "pair_lanescape.hpp"

#include <cmath>
#include <cstring>
#include <exception>
#include <string_view>

#include "atom.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

namespace LAMMPS_NS {

using lanescape::Vectors;

PairLanescape::PairLanescape(LAMMPS* lmp) : Pair(lmp) {
  single_enable = 0;
  restartinfo = 0;
  one_coeff = 1;
  no_virial_fdotr_compute = 1;
}

PairLanescape::~PairLanescape() {
  if (copymode || !allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

template <class Work>
auto PairLanescape::guarded(const Work& work) {
  std::string message;
  try {
    return work();
  } catch (const std::exception& error) {
    message = error.what();
  }
  error->one(FLERR, "pair_style lanescape: " + message);
}

void PairLanescape::settings(int narg, char** arg) {
  if (narg < 1) utils::missing_cmd_args(FLERR, "pair_style lanescape", error);
  const std::string name = arg[0];
  lanescape::ModelChanges changes;
  options_ = {};
  for (int k = 1; k < narg; k += 2) {
    const std::string_view key = arg[k];
    if (k + 1 == narg) utils::missing_cmd_args(FLERR, std::string("pair_style lanescape ") + arg[k], error);
    if (key == "cutoff")
      changes.cutoff = utils::numeric(FLERR, arg[k + 1], false, lmp);
    else if (key == "truncation")
      changes.truncation = arg[k + 1];
    else if (key == "threads")
      options_.threads = utils::inumeric(FLERR, arg[k + 1], false, lmp);
    else if (key == "instruction_set")
      options_.instruction_set = arg[k + 1];
    else
      error->all(FLERR, std::string("pair_style lanescape knows no keyword ") + arg[k] +
                            ": cutoff, truncation, threads and instruction_set are allowed");
  }
  const bool is_file = name.find(".toml") != std::string::npos;
  if (is_file && (changes.cutoff != 0.0 || !changes.truncation.empty()))
    error->all(FLERR, "pair_style lanescape: cutoff and truncation are for named models; the model file has its own");
  if (!is_file && std::strcmp(update->unit_style, "lj") != 0)
    error->all(FLERR, "pair_style lanescape: named models are in units lj; a model file has any units");
  guarded([&] {
    model_ =
        std::make_unique<lanescape::Model>(is_file ? lanescape::Model::from_file(name) : lanescape::Model::named(name, changes));
    options_.species_of.clear();
    potential_ = std::make_unique<lanescape::ListedPotential>(*model_, options_);  // says what such a potential cannot be
  });
}

void PairLanescape::coeff(int narg, char** arg) {
  const int types = atom->ntypes;
  if (narg != 2 + types)
    error->all(FLERR, "pair_coeff of pair_style lanescape needs * * and a species of the model, or NULL, for each of " +
                          std::to_string(types) + " atom types");
  if (!allocated) {
    allocated = 1;
    memory->create(setflag, types + 1, types + 1, "pair:setflag");
    memory->create(cutsq, types + 1, types + 1, "pair:cutsq");
  }
  guarded([&] {
    options_.species_of.assign(static_cast<std::size_t>(types) + 1, -1);
    for (int t = 1; t <= types; ++t)
      if (std::strcmp(arg[1 + t], "NULL") != 0) options_.species_of[static_cast<std::size_t>(t)] = model_->find_species(arg[1 + t]);
    potential_ = std::make_unique<lanescape::ListedPotential>(*model_, options_);
  });
  for (int i = 1; i <= types; ++i)
    for (int j = 1; j <= types; ++j)
      setflag[i][j] =
          j >= i && options_.species_of[static_cast<std::size_t>(i)] >= 0 && options_.species_of[static_cast<std::size_t>(j)] >= 0;
}

// Neighbours carry the kind of a bonded pair in their highest bits; what these would scale is not known here.
void PairLanescape::refuse_special_bonds() {
  if (atom->molecular == Atom::ATOMIC) return;
  for (int k = 1; k < 4; ++k)
    if (force->special_lj[k] != 1.0 && (force->special_lj[k] != 0.0 || force->special_coul[k] != 0.0))
      error->all(FLERR,
                 "pair_style lanescape takes special_bonds of 0 for both lj and coul, which leave pairs out of lists, or lj 1");
}

void PairLanescape::init_style() {
  refuse_special_bonds();
  // A half list takes LAMMPS half the time; without Newton's third law it holds pairs with ghosts twice, a full one all of them.
  const bool half = force->newton_pair != 0;
  neighbor->add_request(this, half ? NeighConst::REQ_DEFAULT : NeighConst::REQ_FULL);
  options_.lists = half ? lanescape::ListedPotential::Lists::half : lanescape::ListedPotential::Lists::rows;
  guarded([&] { potential_ = std::make_unique<lanescape::ListedPotential>(*model_, options_); });
}

double PairLanescape::init_one(int i, int j) {
  return guarded([&] {
    return potential_->cutoff(static_cast<std::size_t>(options_.species_of[static_cast<std::size_t>(i)]),
                              static_cast<std::size_t>(options_.species_of[static_cast<std::size_t>(j)]));
  });
}

void PairLanescape::take_lists(int points) {
  const auto rows = static_cast<std::size_t>(list->inum);
  potential_->set_lists({.species = {atom->type, static_cast<std::size_t>(points)},
                         .rows = {list->ilist, rows},
                         .neighbours = list->firstneigh,
                         .lengths = list->numneigh,
                         .mask = NEIGHMASK});
}

void PairLanescape::compute(int eflag, int vflag) {
  ev_init(eflag, vflag);
  if (vflag_atom != 0 || cvflag_atom != 0) error->all(FLERR, "pair_style lanescape has no stress per atom");
  const int points = atom->nlocal + atom->nghost;
  const auto n = static_cast<std::size_t>(points);
  lanescape::ListedOutputs outputs{.energy = eflag_global != 0, .add_to_forces = true, .stress = vflag_global != 0};
  if (eflag_atom != 0) {
    energies_.resize(n);
    outputs.energies = energies_;
  }
  const lanescape::ListedEvaluation e = guarded([&] {
    if (neighbor->ago == 0 || potential_->points() != n) take_lists(points);
    if (n == 0) return lanescape::ListedEvaluation{};
    outputs.forces = Vectors<double>::interleaved({atom->f[0], 3 * n});
    return potential_->evaluate(Vectors<const double>::interleaved({atom->x[0], 3 * n}), outputs);
  });
  if (eflag_global != 0) eng_vdwl += e.energy;
  if (eflag_atom != 0)
    for (int i = 0; i < points; ++i) eatom[i] += energies_[static_cast<std::size_t>(i)];
  constexpr std::size_t voigt[6] = {0, 1, 2, 5, 4, 3};  // LAMMPS has xx yy zz xy xz yz
  if (vflag_global != 0)
    for (std::size_t k = 0; k < 6; ++k) virial[k] += e.virial_tensor[voigt[k]];
}

double PairLanescape::memory_usage() { return Pair::memory_usage() + static_cast<double>(energies_.capacity() * sizeof(double)); }

}  // namespace LAMMPS_NS
