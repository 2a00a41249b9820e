#pragma once

#include <cstddef>
#include <cstdint>

#include "views/layout.hpp"

// Pair potentials over all pairs and over neighbour lists.
namespace lanescape::kernels {

// Which periodic images of a pair can lie within the cutoff. Decided per species pair, outside the kernels.
enum class ImageSearch : std::uint32_t {
  nearest,      // the nearest image only: rc <= L/2, or the minimum-image rule at any cutoff
  two_nearest,  // also the second nearest: rc <= L and rc^2 <= (La^2 + Lb^2)/4 for every two axes, so that at most one more is in
                // range
  lattice,      // every image with shifts up to PairInput::shells
};

// Unit of length inside the kernels: the box length in a cubic box, where the nearest image then costs nothing; else sigma.
enum class LengthUnit : std::uint32_t { box, sigma };

// One species pair of a pair potential, in the unit of the separations. The form defines its coefficients:
// kernels/forms/<form>.hpp.
inline constexpr std::size_t pair_coefficients = 10;

// What a truncation adds to u(r): a constant; or c0 + c2 r^2 + c4 r^4; or also c1 r, which costs a square root per pair.
enum class PairCorrectionKind : std::uint32_t { constant, even, linear };

struct PairParameters {
  double cutoff_squared;
  double coefficient[pair_coefficients];
  PairCorrectionKind correction;
  ImageSearch images;
};

// The same for kernels in mixed precision.
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
  double virial_tensor[6];  // sum of r_a f_b, Voigt order xx yy zz yz xz xy; written only by kernels with `stress` in their name
};

// Points of a neighbour list: records of point_width doubles, x y z and a fourth number, unused unless stated [sigma], so that a
// neighbour is one load. Points are identified by offset, in doubles.
inline constexpr std::size_t point_width = 4;

// Rows of one species and the neighbours of each, species by species. The neighbours of a row of one species start at a multiple of
// slot_padding and are padded with offsets that are valid but not counted. After the last row, slot_padding more entries follow.
struct NeighbourRows {
  const double* points;
  const std::uint32_t* rows;  // offsets of the rows' own points
  std::size_t row_count;
  const std::uint32_t* neighbours;  // offsets, all rows one after the other
  const std::uint32_t* lengths;     // row_count x species_count: number of neighbours
  std::size_t species_count;
  // For kernels in mixed precision, else null: the same points at the same offsets, records of point_width integers. Coordinates
  // are in fixed_unit, modulo 2^32. Points in each other's list are less than 2^31 units apart, so their separations are exact.
  const std::int32_t* fixed_points;
  double fixed_unit;  // a power of two [sigma]
};

struct PairListInput {
  NeighbourRows list;                        // fourth number of a point: its diameter where the form has diameters
  const PairParameters* pairs;               // species_count: the rows' species with each [sigma]; `images` is ignored
  const SinglePairParameters* single_pairs;  // the same for kernels in mixed precision, else null
};

}  // namespace lanescape::kernels
