#pragma once

#include <cstddef>
#include <cstdint>

// Plain views through which the library hands memory to the kernels. A kernel never owns, allocates or throws.
namespace lanescape::kernels {

// Slots per padding unit: every species block starts at a multiple of it and every array is a multiple of it long, so that
// the widest vectors (8 doubles) need no remainder loop. Padding slots hold zeros and are masked out of every sum.
inline constexpr std::size_t slot_padding = 8;

// Alignment of every array a kernel reads or writes [bytes].
inline constexpr std::size_t array_alignment = 64;

// The particles of one species: slots [begin, begin + count).
struct SpeciesBlock {
  std::size_t begin;
  std::size_t count;
};

// Which periodic images of a pair can lie within the cutoff; decided per species pair, outside the kernels.
enum class ImageSearch : std::uint32_t {
  nearest,      // the nearest image only: rc <= L/2, or the minimum-image rule at any cutoff
  two_nearest,  // also the next one: rc <= L and rc^2 <= (La^2 + Lb^2)/4 for every two axes, so that at most one more is in range
  lattice,      // every image with shifts up to LjInput::shells
};

// Units of length inside the kernels: in a cubic box the box length, which makes the nearest image free; else sigma.
enum class LengthUnit : std::uint32_t { box, sigma };

// u(r) = c12 r^-12 - c6 r^-6 - shift for r^2 < cutoff_squared, else 0; r in LjInput::unit.
struct LjPair {
  double c12;  // 4 eps s^12
  double c6;   // 4 eps s^6
  double cutoff_squared;
  double shift;  // [epsilon]
  ImageSearch images;
};

struct LjInput {
  const double* positions;  // 3 x slots: all x, all y, all z [sigma]; may be unwrapped
  double* scratch;          // 3 x slots, overwritten
  std::size_t slots;        // a multiple of slot_padding
  const SpeciesBlock* blocks;
  std::size_t block_count;
  const LjPair* pairs;     // block_count x block_count, symmetric
  LengthUnit unit;         // box: needs a cubic box and no ImageSearch::lattice
  double box[3];           // edge lengths [sigma]
  std::int32_t shells[3];  // largest image shift per axis, for ImageSearch::lattice
};

struct LjOutput {
  double energy;            // [epsilon]
  double virial;            // sum over pairs of r.f [epsilon]
  double virial_tensor[6];  // sum of r_a f_b, Voigt order xx yy zz yz xz xy; written by lj_stress only
};

// Sums over the particles j of one displacement: sum |dr_j|^2 and sum |dr_j|^4.
struct DisplacementMoments {
  double second;
  double fourth;
};

}  // namespace lanescape::kernels
