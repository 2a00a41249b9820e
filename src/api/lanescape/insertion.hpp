#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lanescape/model.hpp>
#include <lanescape/owned.hpp>

namespace lanescape {
LANESCAPE_ABI_BEGIN

// How positions are searched at which one more particle has a given energy: Delgado-Buscalioni and Coveney,
// doi 10.1063/1.1579475 ("USHER").
struct InsertionSettings {
  double energy = 0.0;                 // U0, the target
  double tolerance = 0.01;             // of the error below
  std::string measure = "relative";    // |U - U0| / |U0|, |U - U0| where |U0| < 1e-6; or absolute, running-mean
  std::string method = "usher";        // or usher-indirect, usher-near, screened, descent
  double largest_step = 0.0;           // 0: the published optimum for the density
  std::uint64_t most_trials = 10'000;  // of each insertion
  // Where to search: low and high corners, which may lie across faces; nothing: the whole box.
  std::optional<std::array<std::array<double, 3>, 2>> region{};
  std::uint64_t seed = 1;
  int threads = 1;  // no effect on any result
};

struct InsertedParticle {
  bool found = false;
  std::array<double, 3> position{};  // in the box
  double energy = 0.0;               // by which the fluid's rises
  double error = 0.0;                // U - U0, or (U - U0) / |U0| where the measure is relative
  std::uint64_t evaluations = 0, trials = 0;
};

// One more particle in a fluid that stands still: its energy anywhere, and positions of a given energy. For models with a pair
// potential. Not thread-safe, but const members may be called by several threads at once.
class LANESCAPE_API Inserter {
 public:
  struct Options {
    int species = 0;                       // of the particle
    double diameter = 1.0;                 // of the particle, for models whose particles have diameters
    std::vector<double> diameters{};       // of the fluid, likewise
    std::string instruction_set = "auto";  // or a name of instruction_sets()
  };

  // `positions` 3N, wrapped or not. O(N). Throws Error(bad_input).
  Inserter(const Model& model, std::span<const int> species, std::span<const double> positions, const std::array<double, 3>& box);
  Inserter(const Model& model, std::span<const int> species, std::span<const double> positions, const std::array<double, 3>& box,
           const Options& options);
  ~Inserter();
  Inserter(Inserter&&) noexcept;
  Inserter& operator=(Inserter&&) noexcept;

  std::size_t particles() const;  // of the fluid
  // What the fluid's energy would rise by with a particle there, and the force on it.
  double energy(const std::array<double, 3>& position) const;
  double energy_and_force(const std::array<double, 3>& position, std::array<double, 3>& force) const;
  // Of many positions, 3M numbers, into M.
  void energies(std::span<const double> positions, std::span<double> energies) const;

  // `count` independent searches in the fluid as it is.
  std::vector<InsertedParticle> find(const InsertionSettings& settings, std::size_t count = 1);
  // Inserts `count` particles one after the other; each becomes part of the fluid.
  std::vector<InsertedParticle> insert(const InsertionSettings& settings, std::size_t count = 1);
  // Puts a particle of the probe's species there, or takes one away; whether there was one, to the bit once wrapped.
  void add(const std::array<double, 3>& position);
  bool remove(const std::array<double, 3>& position);

 private:
  struct Implementation;
  detail::Owned<Implementation> implementation_;
};

LANESCAPE_ABI_END
}  // namespace lanescape
