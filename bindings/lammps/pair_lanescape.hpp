#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <lanescape/lanescape.hpp>

#include "pair.h"

namespace LAMMPS_NS {

// pair_style lanescape MODEL [cutoff RC] [truncation WORD] [threads N] [instruction_set WORD]
// pair_coeff * * SPECIES ...
//
// Pair potentials of the library over LAMMPS's own full lists, which are translated once, when they are new. MODEL is a name of
// lanescape::model_names(), in units lj, or a model file in LAMMPS's units; SPECIES names the model's species of each atom type, or
// NULL for types of other styles (hybrid).
class PairLanescape final : public Pair {
 public:
  explicit PairLanescape(LAMMPS* lmp);
  ~PairLanescape() override;
  PairLanescape(const PairLanescape&) = delete;
  PairLanescape& operator=(const PairLanescape&) = delete;

  void settings(int narg, char** arg) override;
  void coeff(int narg, char** arg) override;
  void init_style() override;
  double init_one(int i, int j) override;
  void compute(int eflag, int vflag) override;
  double memory_usage() override;

 private:
  void take_lists(int points);
  void refuse_special_bonds();
  // Ends LAMMPS with the library's message where `work` throws.
  template <class Work>
  auto guarded(const Work& work);

  std::unique_ptr<lanescape::Model> model_;
  lanescape::ListedPotential::Options options_;
  std::unique_ptr<lanescape::ListedPotential> potential_;
  std::vector<double> energies_;
};

}  // namespace LAMMPS_NS
