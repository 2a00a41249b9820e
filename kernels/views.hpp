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
  lattice,      // every image with shifts up to PairInput::shells
};

// Units of length inside the kernels: in a cubic box the box length, which makes the nearest image free; else sigma.
enum class LengthUnit : std::uint32_t { box, sigma };

// One species pair of a pair potential, in the unit of the separations. What the coefficients mean is the form's own affair:
// kernels/forms/<form>.hpp.
inline constexpr std::size_t pair_coefficients = 9;
struct PairParameters {
  double cutoff_squared;
  double coefficient[pair_coefficients];
  ImageSearch images;
};

// The same for the kernels in mixed precision.
struct SinglePairParameters {
  float cutoff_squared;                  // in units of NeighbourRows::fixed_unit
  float sigma_squared;                   // 1 sigma^2 in the same units
  float unit_squared;                    // one of these units squared [sigma^2]
  float coefficient[pair_coefficients];  // [sigma]
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

// The cells of a grid, running fastest along z; a column is the cells of one x and y.
struct GridShape {
  std::size_t cells[3];
  double low[3], edge[3];  // of the grid, of a cell [sigma]; points beyond a face are in the cells at it
  double cells_per_length[3];
};

// Points sorted by the cells of a grid; their coordinates in columns, in single precision: a search looks a little further to make
// up for it.
struct PointGrid : GridShape {
  const std::uint32_t* first;  // of each cell's points; one more at the end
  const float *x, *y, *z;      // of all points; 16 more than there are can be read
};

struct NeighbourQuery {
  double position[3];
  double reach;
  std::uint32_t self;  // not its own neighbour
};

// Points of one species around a probe, sorted by the cells of a grid, coordinates in columns. Columns of cells have room between
// them, so that points can be put in; no column's points are read as another's.
struct ProbeSpecies : GridShape {
  const std::uint32_t* first;  // cells[2] + 1 per column: of each cell's points, and the column's end
  const double *x, *y, *z;     // slot_padding more than there are can be read
  const double* diameters;     // likewise, where the form has diameters, else null [sigma]
  PairParameters pair;         // of the probe with this species [sigma]; `images` is not looked at: images are points
  double reach;                // no point further away is in range [sigma]
};

// The fluid around a particle that is not in it.
struct ProbeInput {
  const ProbeSpecies* species;
  std::size_t species_count;
  double diameter;  // of the probe, where the form has diameters [sigma]
};

struct ProbeOutput {
  double energy;       // the sum over all points, never half of it [epsilon]
  double gradient[3];  // [epsilon/sigma]
};

// Sums over the particles j of one displacement: sum |dr_j|^2 and sum |dr_j|^4.
struct DisplacementMoments {
  double second;
  double fourth;
};

// Hard spheres in a periodic box. Two overlap if r^2 < (radius_i + radius_j)^2 with r^2 = (dx dx + dy dy) + dz dz of the nearest
// image, every product and sum rounded: each instruction set and the reference take the same decisions to the bit.
struct SphereInput {
  const double* positions;  // 3 x slots [sigma]; may be unwrapped
  const double* radii;      // slots [sigma]; NaN for padding, which then never overlaps
  std::size_t slots;        // a multiple of slot_padding
  double box[3];            // edge lengths [sigma], each above twice the largest reach
  std::int32_t* fractions;  // scratch: 3 x float_slots
  float* reaches;           // scratch: float_slots
  std::size_t float_slots;  // slots rounded up to 16
};

// Over all pairs the order of pairs (i, j) is that of (i / sphere_pair_rows, j / KernelTable::sphere_pair_columns, i, j): the tiles
// the kernel looks at. Sums over pairs have the same bits in no other order.
inline constexpr std::size_t sphere_pair_rows = 4;
struct SpherePair {
  std::int32_t first, second;  // slots, first < second
};

// Pairs that may come to overlap, with the image in which they do; arrays of a multiple of slot_padding.
struct SphereList {
  const std::int32_t *first, *second;         // slots; any for padding
  const double *shift_x, *shift_y, *shift_z;  // whole boxes to take off x_second - x_first [sigma]
  const double* contact;                      // s_ij = radius_i + radius_j [sigma]; NaN for padding
  std::size_t count;                          // padding included
};

// Which pairs of a list overlap: their places in it, and of every pair in the list, overlapping or not, the separation
// r_second - r_first and its square. Packing these would cost more than it saves.
struct SphereContacts {
  std::int32_t* places;                 // room for the list's count and 2 slot_padding more
  double *x, *y, *z, *squared;          // the list's count
  double *force_x, *force_y, *force_z;  // scratch for forces: the list's count
};

// Fictitious potential between overlapping spheres, whose forces say where to go (docs/ARCHITECTURE.md).
enum class ContactPotential : std::uint32_t { harmonic, linear, cubic };

// A sphere in free flight: where it was at its own time. Eight doubles, one cache line.
struct alignas(64) FlyingSphere {
  double x, y, z;     // [sigma]
  double vx, vy, vz;  // [sigma / time]
  double time;        // of the position
  double radius;      // at time 0 [sigma]
};

// The first collision of one sphere with its neighbours after `now`.
struct CollisionQuery {
  const FlyingSphere* spheres;
  const std::int32_t* neighbours;  // room for a multiple of slot_padding; valid indices up to there
  std::size_t count;
  std::size_t self;
  double now;
  double growth;  // radii are radius (1 + growth time)
  double box[3];
};

struct CollisionEvent {
  double time;           // infinity if there is none
  std::int32_t partner;  // -1 if there is none
};

// A tournament over event times: level 0 holds the times themselves, each later one the least of every block of calendar_block
// entries and which event it is. Entries beyond the last are infinite. The top level has one block.
inline constexpr std::size_t calendar_block = 16;
inline constexpr std::size_t calendar_levels = 8;
struct CalendarView {
  double* times[calendar_levels];
  std::int32_t* winners[calendar_levels];  // from level 1 on
  std::size_t levels;                      // at least 2; the last has one entry
};

// Interactions that follow the states of sites, over neighbour lists whose points carry what a pass needs of a neighbour in their
// fourth number.

// A cubic spline on intervals of equal width: interval k is the record of point_width doubles {b, c, d, a}, 32-byte aligned, of
// a + s (b + s (c + s d)) with s from 0 to 1. One more record, of zeros, follows the last.
struct CubicSpline {
  const double* records;
  double per_unit;   // intervals per unit of the argument
  double intervals;  // their number
};

// w(r) as a spline in r^2; its derivative is the spline's.
struct SwitchingSpline {
  CubicSpline spline;
  double cutoff_squared;  // zero from here on [sigma^2]
};

struct StateDensityInput {
  NeighbourRows list;
  SwitchingSpline switching;  // of the rows' species
  const double* filter;       // c(rows' species, each species)
  // A list of what is near now is made on the way, for the passes that follow: lists hold a skin that is not.
  const double* reaches_squared;  // how far each species is near [sigma^2]
  std::uint32_t* near;            // room for as many as `list` has, padding included
  std::uint32_t* near_lengths;
  double* near_slopes;  // w'(r)/r of the rows' species for each place in `near`; 0 beyond the cutoff
};

struct StateDensityForceInput {
  NeighbourRows list;                 // fourth number of a point: dU/drho of its site
  SwitchingSpline switching;          // of the rows' species
  const SwitchingSpline* switchings;  // of each species
  const double* filter;               // c(rows' species, each species)
  const double* filter_back;          // c(each species, rows' species)
  const double* slopes;               // w'(r)/r of the rows' species for each neighbour
};

// The states of the rows and their neighbours. Where there are two, the fourth number of a point is the probability of the first.
struct StateProbabilities {
  std::size_t states;
  const double* rows;        // row_count x states
  const double* points;      // from three states on: records of point_width at the points' places, the first four states,
  std::size_t group_stride;  // and so many doubles further the next four; probabilities of states there are not are zero
};

// u_ab(r) = c12 r^-12 - c6 r^-6 - shift.
struct StateLjPair {
  double c12, c6, shift;
};

struct StateLjInput {
  NeighbourRows list;
  StateProbabilities probabilities;
  const StateLjPair* pairs;       // species x states of a row x states of a neighbour: the rows' species with each
  const double* cutoffs_squared;  // with each species; 0: these do not interact this way
};

// u_ab(r) of one pair of species as splines in r - origin on the same intervals, which a record for each pair of states makes up.
struct StateTable {
  CubicSpline spline;     // interval x states of a row x states of a neighbour
  double origin;          // at most 0 [sigma]
  double cutoff_squared;  // 0: these do not interact this way
};

struct StateTableInput {
  NeighbourRows list;
  StateProbabilities probabilities;
  const StateTable* tables;  // the rows' species with each
};

}  // namespace lanescape::kernels
