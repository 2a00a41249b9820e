#pragma once

#include <cstddef>
#include <cstdint>

#include "views/layout.hpp"

// Pair potentials over all pairs and over neighbour lists.
namespace lanescape::kernels {

// Which periodic images of a pair can lie within the cutoff; decided per species pair, outside the kernels.
enum class ImageSearch : std::uint32_t {
  nearest,      // the nearest image only: rc <= L/2, or the minimum-image rule at any cutoff
  two_nearest,  // also the next one: rc <= L and rc^2 <= (La^2 + Lb^2)/4 for every two axes, so that at most one more is in range
  lattice,      // every image with shifts up to PairInput::shells
};

// Units of length inside the kernels: in a cubic box the box length, which makes the nearest image free; else sigma.
enum class LengthUnit : std::uint32_t { box, sigma };

// One species pair of a pair potential, in the unit of the separations. What the coefficients mean is the form's own affair:
// kernels/forms/<form>.hpp.
inline constexpr std::size_t pair_coefficients = 10;

// What a truncation adds to u(r): a constant; c0 + c2 r^2 + c4 r^4; or c1 r too, which costs a root for each pair.
enum class PairCorrectionKind : std::uint32_t { constant, even, linear };

struct PairParameters {
  double cutoff_squared;
  double coefficient[pair_coefficients];
  PairCorrectionKind correction;
  ImageSearch images;
};

// The same for the kernels in mixed precision.
struct SinglePairParameters {
  float cutoff_squared;                  // in units of NeighbourRows::fixed_unit
  float sigma_squared;                   // 1 sigma^2 in the same units
  float unit_squared;                    // one of these units squared [sigma^2]
  float coefficient[pair_coefficients];  // [sigma]
  PairCorrectionKind correction;
};

struct PairInput {
  const double* positions;  // 3 x slots: all x, all y, all z [sigma]; may be unwrapped
  double* scratch;          // 3 x slots, overwritten
  std::size_t slots;        // a multiple of slot_padding
  const SpeciesBlock* blocks;
  std::size_t block_count;
  const PairParameters* pairs;  // block_count x block_count, symmetric
  const double* diameters;      // slots, in the unit of the parameters; where the form has diameters, else null
  LengthUnit unit;              // box: needs a cubic box and no ImageSearch::lattice
  double box[3];                // edge lengths [sigma]
  std::int32_t shells[3];       // largest image shift per axis, for ImageSearch::lattice
};

struct PairOutput {
  double energy;            // [epsilon]
  double virial;            // sum over pairs of r.f [epsilon]
  double virial_tensor[6];  // sum of r_a f_b, Voigt order xx yy zz yz xz xy; written by the kernels named stress only
};

// Points of a neighbour list: records of point_width doubles, x y z and nothing [sigma], so that a neighbour is one load. They
// are named by their place, in doubles.
inline constexpr std::size_t point_width = 4;

// Rows of one species and the neighbours of each, species by species. The neighbours of a row of one species start at a
// multiple of slot_padding and end with places that are valid but not counted; after the last of all come slot_padding more.
struct NeighbourRows {
  const double* points;
  const std::uint32_t* rows;  // places of the rows' own points
  std::size_t row_count;
  const std::uint32_t* neighbours;  // places, all rows one after the other
  const std::uint32_t* lengths;     // row_count x species_count: how many neighbours
  std::size_t species_count;
  // For the kernels in mixed precision, else null: the same points at the same places, records of point_width integers: coordinates
  // in fixed_unit, modulo 2^32. Separations of points that are in each other's list are below 2^31 of them, hence exact.
  const std::int32_t* fixed_points;
  double fixed_unit;  // a power of two [sigma]
};

struct PairListInput {
  NeighbourRows list;                        // fourth number of a point: its diameter where the form has diameters
  const PairParameters* pairs;               // species_count: the rows' species with each [sigma]; `images` is not looked at
  const SinglePairParameters* single_pairs;  // the same; for the kernels in mixed precision, else null
};

}  // namespace lanescape::kernels
