#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "configuration/configuration.hpp"
#include "configuration/pair_model.hpp"
#include "configuration/particle_layout.hpp"
#include "core/aligned_array.hpp"
#include "core/archive.hpp"
#include "core/box.hpp"
#include "kernel_table.hpp"

namespace lanescape {

class PairSums;
class NeighbourList;

// Which image search a cutoff needs in a box (docs/ARCHITECTURE.md, "Small boxes"); lengths in the same unit.
kernels::ImageSearch image_search(const Box& box, double cutoff, ImageRule rule);

// Shifts by more than this many boxes bring no image of a nearest separation (|d| <= L/2) within the cutoff.
double image_shells(double length, double cutoff);
// Largest number of periodic images per direction that the rule `all` takes part in.
inline constexpr int max_image_shells = 8;
// Throws Error(bad_input) where some pair's cutoff reaches further than that.
void check_cutoff(const PairModel& model, const Box& box);

// What a uniform fluid beyond the cutoff adds to the energy, and to the virial sum r.f, for each N_a N_b; the sum runs over a and
// b, each pair of species in both orders [epsilon].
PairTail long_range(const PairModel& model, std::size_t a, std::size_t b, double volume);

// Throws Error(bad_input) naming the closest pair if any two particles are nearer than 0.3 sigma_ab, where r^-12 has lost all
// meaning, or the coordinate that is not finite. O(N).
void check_separations(const Configuration& configuration, const PairModel& model);

// How pairs are found: over all of them, or over a neighbour list; or whichever is faster, by the number of particles.
enum class PairSearch { automatic, all_pairs, list };

// Of the arithmetic of pairs. Mixed: single precision, over a list, with sums in double and the error that docs/ARCHITECTURE.md
// states. What double_precision means is the rest of the library.
enum class Precision { double_precision, mixed };
const char* to_string(Precision precision);        // "double" or "mixed"
Precision parse_precision(std::string_view word);  // throws Error(bad_input)

// Whether the image rule allows a list: `minimum` only where the nearest image of a pair cannot change while the list lasts.
bool fits_list(const PairModel& model, const Box& box, double skin);

// Throws Error(bad_input) where mixed precision would need a list that the image rule does not allow.
void check_precision(const PairModel& model, const Box& box, Precision precision, double skin);

// From so many particles on a list is faster (docs/PERFORMANCE.md).
inline constexpr std::size_t list_crossover = 200;
// Of a list: larger ones hold more pairs that are out of range, smaller ones are made anew more often [sigma].
inline constexpr double default_skin = 0.3;
// Along a path, whose particles hardly move from one step to the next: rare renewal is worth less than a short list.
inline constexpr double path_skin = 0.15;

struct PairSearchOptions {
  PairSearch search = PairSearch::automatic;
  int threads = 1;  // that share the rows of a list; no effect on any result
  double skin = default_skin;
  Precision precision = Precision::double_precision;  // mixed takes a list at any size
};

// Energy, gradient and virial of one mixture in one box by the kernels of one instruction set. Holds the scratch memory of an
// evaluation and the neighbour list, so that each caller's thread needs its own. Coordinates are in the layout's order.
class PairInteraction {
 public:
  // Throws what check_cutoff() throws, and Error(bad_input) where a list is asked for, or needed for mixed precision, that the
  // minimum-image rule or PairSearch::all_pairs does not allow.
  PairInteraction(const PairModel& model, const Box& box, const ParticleLayout& layout, const kernels::KernelTable& table,
                  const PairSearchOptions& options = {});
  PairInteraction(PairInteraction&&) noexcept;
  PairInteraction& operator=(PairInteraction&&) noexcept;
  ~PairInteraction();

  struct Evaluation {
    double energy = 0.0;                    // [epsilon]
    double virial = 0.0;                    // sum r.f [epsilon]
    std::array<double, 6> virial_tensor{};  // sum r_a f_b, Voigt xx yy zz yz xz xy; from energy_and_stress only
  };

  double energy(const AlignedArray& positions);
  void gradient(const AlignedArray& positions, AlignedArray& gradient);
  Evaluation energy_and_gradient(const AlignedArray& positions, AlignedArray& gradient);
  // In double precision always.
  Evaluation energy_and_stress(const AlignedArray& positions, AlignedArray& gradient);

  // What else than the positions the bits of a result depend on: where a list was made.
  void exchange(Archive& archive);
  // The list, if there is one.
  const NeighbourList* list() const;

 private:
  // What does not depend on the positions: own images of a particle and long-range corrections.
  void add_images_of_self(const PairModel& model, const Box& box);
  void add_tail(const PairModel& model, const Box& box);
  Evaluation with_constants(const kernels::PairOutput& out) const;

  std::vector<kernels::SpeciesBlock> blocks_;
  std::unique_ptr<PairSums> sums_;
  Evaluation constants_;
};

}  // namespace lanescape
