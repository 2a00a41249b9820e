#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <lanescape/listed_potential.hpp>
#include <lanescape/model.hpp>
#include <lanescape/owned.hpp>
#include <lanescape/potential.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// A pair potential over the particles of a domain and the ghosts around it, with neighbour lists of its own: for engines that hand
// over particles and do not say when their lists change. There is no box: separations are plain differences. Lists last until a
// particle has moved by half their skin. Double precision. Not thread-safe: one object per thread.
//
// The energy is half of each pair for each of its ends in the domain. Forces are the slopes of this energy, on ghosts too.
class LANESCAPE_API DomainPotential {
 public:
  struct Options {
    int threads = 1;                       // that share an evaluation; no effect on any result
    std::string instruction_set = "auto";  // or a name of instruction_sets()
  };

  // Throws Error(bad_input) for models that ListedPotential refuses.
  explicit DomainPotential(const Model& model);
  DomainPotential(const Model& model, const Options& options);
  ~DomainPotential();
  DomainPotential(DomainPotential&&) noexcept;
  DomainPotential& operator=(DomainPotential&&) noexcept;

  // The particles that follow: the model's species of each, and whether it is of the domain (0: a ghost). Nothing happens where
  // they are those of the last call.
  void set_particles(std::span<const int> species, std::span<const int> in_domain);
  std::size_t particles() const;

  // As ListedPotential::evaluate(); energies of ghosts are 0.
  ListedEvaluation evaluate(const Vectors<const double>& positions, const ListedOutputs& outputs);

 private:
  struct Implementation;
  detail::Owned<Implementation> implementation_;
};

LANESCAPE_ABI_END
}  // namespace lanescape
