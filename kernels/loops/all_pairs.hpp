#pragma once

#include <type_traits>
#include <utility>

#include "loops/pair_vector.hpp"

// Pair potentials over all pairs, each pair once: the loop for small systems (a few hundred particles), where a neighbour list
// costs more than the pairs it saves.
//
// Rows i are taken four at a time against vectors of columns j >= i, so that one load and one store of the columns serves four
// rows. The parameters of a species pair are constants of its loop and nothing is gathered. Positions are first divided by the box
// lengths: the nearest image is then one instruction (reduce_to_nearest). In a cubic box everything stays in units of the box
// length to the end; otherwise separations are scaled back, three multiplications per vector of pairs.
namespace lanescape::kernels::LANESCAPE_ISA {

constexpr std::size_t row_tile = 4;  // rows that share one load and store of a column vector
static_assert(slot_padding % row_tile == 0 && slot_padding % lanes == 0);

// Which lanes of a block of rows and columns hold real, distinct pairs: all; those of one mask for the four rows (an
// incomplete last column vector); or a mask for each row (on the diagonal, or where rows are missing).
enum class Masking { none, columns, rows };

struct Box {
  Displacement length;
  std::int32_t shells[3];
};

// Four rows: their positions and diameters, and the gradient summed so far.
struct RowTile {
  const double *x, *y, *z;  // scaled positions
  const double* diameters;  // where the form has them
  Displacement gradient[row_tile];
};

// The particles of one species: scaled positions and gradient, `slots` apart per axis.
struct Columns {
  const double* positions;
  double* gradient;
  const double* diameters;  // where the form has them
  std::size_t slots;
};

// Where the rows and columns of an edge block are real and distinct.
struct EdgeLimits {
  std::size_t first_row, first_column;  // numbers within their species blocks
  std::size_t column_count;
  std::size_t row_count;
  bool same_species;
};

// The next image after the nearest lies across one face of the box: along the axis where that lengthens r^2 least.
// ImageSearch::two_nearest guarantees that no second axis can bring another one into range.
template <LengthUnit unit>
LANESCAPE_INLINE Displacement next_image(const Displacement& d, const Box& box, Vector& r2) {
  const Vector ax = absolute(d.x), ay = absolute(d.y), az = absolute(d.z);
  if constexpr (unit == LengthUnit::box) {
    const Vector largest = maximum(ax, maximum(ay, az));
    r2 = subtract_product(r2 + broadcast(1.0), broadcast(2.0), largest);
    const Vector one = broadcast(1.0);
    return {select(less(ax, largest), d.x, d.x - copy_sign(one, d.x)), select(less(ay, largest), d.y, d.y - copy_sign(one, d.y)),
            select(less(az, largest), d.z, d.z - copy_sign(one, d.z))};
  } else {
    const auto& l = box.length;
    const auto growth = [](Vector length, Vector a) { return length * (length - (a + a)); };
    const Vector gx = growth(l.x, ax), gy = growth(l.y, ay), gz = growth(l.z, az);
    const Vector least = minimum(gx, minimum(gy, gz));
    r2 = r2 + least;
    return {select(less(least, gx), d.x, d.x - copy_sign(l.x, d.x)), select(less(least, gy), d.y, d.y - copy_sign(l.y, d.y)),
            select(less(least, gz), d.z, d.z - copy_sign(l.z, d.z))};
  }
}

// Calls body(0) ... body(count - 1) with the number as a constant, so that arrays indexed by it become registers.
template <std::size_t count, class Body>
LANESCAPE_INLINE void unrolled(Body body) {
  [&]<std::size_t... k>(std::index_sequence<k...>)
      __attribute__((always_inline)) { (body(std::integral_constant<std::size_t, k>{}), ...); }(std::make_index_sequence<count>{});
}

// One vector of pairs in all its images within range.
template <class Form, ImageSearch images, Output output, LengthUnit unit, Masking masking>
LANESCAPE_INLINE void pair_vector(const Displacement& nearest, const Box& box, const typename Form::Parameters& u, Vector sigma2,
                                  Mask valid, typename Form::Sums& sums, Displacement& row, Displacement& column, Totals& totals) {
  const auto in_range = [&](Vector r2) __attribute__((always_inline)) {
    const Mask in = Form::in_range(u, {r2, sigma2});
    if constexpr (masking != Masking::none) return both(in, valid);
    return in;
  };
  const auto add = [&](const Displacement& d, Vector r2, Mask in) __attribute__((always_inline)) {
    const auto terms = Form::terms(u, {r2, sigma2}, in);
    Form::add(sums, u, terms, in);
    if constexpr (!has_gradient(output)) return;
    const Vector w = Form::force_over_r(u, terms, in);
    add_scaled(row, w, d);
    subtract_scaled(column, w, d);
    if constexpr (output == Output::stress) add_tensor(totals, d, w);
  };
  if constexpr (images == ImageSearch::lattice) {
    for (std::int32_t a = -box.shells[0]; a <= box.shells[0]; ++a)
      for (std::int32_t b = -box.shells[1]; b <= box.shells[1]; ++b)
        for (std::int32_t c = -box.shells[2]; c <= box.shells[2]; ++c) {
          const Displacement d{multiply_add(broadcast(a), box.length.x, nearest.x),
                               multiply_add(broadcast(b), box.length.y, nearest.y),
                               multiply_add(broadcast(c), box.length.z, nearest.z)};
          const Vector r2 = squared_length(d);
          add(d, r2, in_range(r2));
        }
  } else {
    Vector r2 = squared_length(nearest);
    add(nearest, r2, in_range(r2));
    if constexpr (images == ImageSearch::two_nearest) {
      const Displacement d = next_image<unit>(nearest, box, r2);
      const Mask in = in_range(r2);
      if (any(in)) add(d, r2, in);
    }
  }
}

LANESCAPE_INLINE Mask valid_in_row(const EdgeLimits& limits, std::size_t column, std::size_t row) {
  const auto before = [&](std::size_t n) {
    return lanes_below(static_cast<std::ptrdiff_t>(n) - static_cast<std::ptrdiff_t>(column));
  };
  if (row >= limits.row_count) return lanes_below(0);
  return limits.same_species ? and_not(before(limits.column_count), before(row + 1)) : before(limits.column_count);
}

// Four rows against the column vectors [first, last) of one species.
template <class Form, ImageSearch images, Output output, LengthUnit unit, Masking masking>
LANESCAPE_INLINE void column_loop(std::size_t first, std::size_t last, const EdgeLimits& limits, const Columns& columns,
                                  const Box& box, const typename Form::Parameters& u, RowTile& rows, typename Form::Sums& sums,
                                  Totals& totals) {
  const std::size_t slots = columns.slots;
  for (std::size_t j = first; j < last; j += lanes) {
    const double* sj = columns.positions + j;
    double* gj = has_gradient(output) ? columns.gradient + j : nullptr;  // there is none without a gradient
    const Displacement column{load(sj), load(sj + slots), load(sj + 2 * slots)};
    Displacement g{broadcast(0.0), broadcast(0.0), broadcast(0.0)};
    if constexpr (has_gradient(output)) g = {load(gj), load(gj + slots), load(gj + 2 * slots)};
    const Mask in_block = lanes_below(static_cast<std::ptrdiff_t>(limits.column_count) - static_cast<std::ptrdiff_t>(j));
    unrolled<row_tile>([&](auto r) __attribute__((always_inline)) {
      const Mask valid = masking == Masking::rows ? valid_in_row(limits, j, limits.first_row + r) : in_block;
      Displacement d{reduce_to_nearest(column.x - broadcast(rows.x[r])), reduce_to_nearest(column.y - broadcast(rows.y[r])),
                     reduce_to_nearest(column.z - broadcast(rows.z[r]))};
      if constexpr (unit == LengthUnit::sigma) d = {d.x * box.length.x, d.y * box.length.y, d.z * box.length.z};
      Vector sigma2{};
      if constexpr (Form::has_diameters) sigma2 = Form::sigma_squared(u, broadcast(rows.diameters[r]), load(columns.diameters + j));
      pair_vector<Form, images, output, unit, masking>(d, box, u, sigma2, valid, sums, rows.gradient[r], g, totals);
    });
    if constexpr (has_gradient(output)) {
      store(gj, g.x);
      store(gj + slots, g.y);
      store(gj + 2 * slots, g.z);
    }
  }
}

template <class Form, ImageSearch images, Output output, LengthUnit unit>
LANESCAPE_INLINE void tile_against_block(const Columns& columns, const SpeciesBlock& block, const EdgeLimits& limits,
                                         const Box& box, const typename Form::Parameters& u, RowTile& rows, Totals& totals) {
  typename Form::Sums sums;
  const auto loop = [&]<Masking masking>(std::size_t first, std::size_t last) __attribute__((always_inline)) {
    column_loop<Form, images, output, unit, masking>(first, last, limits, columns, box, u, rows, sums, totals);
  };
  const std::size_t padded = (block.count + lanes - 1) / lanes * lanes;
  if constexpr (images == ImageSearch::lattice) {
    loop.template operator()<Masking::rows>(limits.first_column, padded);
  } else {
    const std::size_t whole = block.count / lanes * lanes;
    const std::size_t past_diagonal = (limits.first_row + row_tile + lanes - 1) / lanes * lanes;
    std::size_t clear = limits.same_species ? past_diagonal : 0;
    if (limits.first_row + row_tile > limits.row_count) clear = padded;
    const std::size_t rest = clear > whole ? clear : whole;
    if constexpr (Form::specialised) {
      // One mask serves all four rows at the end.
      loop.template operator()<Masking::rows>(limits.first_column, clear);
      loop.template operator()<Masking::none>(clear, whole);
      loop.template operator()<Masking::columns>(rest, padded);
    } else {
      // Both edges go through one loop: half the code to compile.
      const std::size_t edges[2][2] = {{limits.first_column, clear}, {rest, padded}};
      for (const auto& edge : edges) loop.template operator()<Masking::rows>(edge[0], edge[1]);
      loop.template operator()<Masking::none>(clear, whole);
    }
  }
  add_sums(totals, u, sums);
}

// Positions in box lengths, and no gradient yet. Returns their sum: not finite where a position is not, which masks would hide.
template <Output output>
LANESCAPE_INLINE Vector start_all_pairs(const PairInput& in, double* gradient) {
  Vector sum = broadcast(0.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vector inverse_length = broadcast(1.0 / in.box[axis]);
    for (std::size_t i = axis * in.slots; i < (axis + 1) * in.slots; i += lanes) {
      const Vector scaled = load(in.positions + i) * inverse_length;
      sum += scaled;
      store(in.scratch + i, scaled);
      if constexpr (has_gradient(output)) store(gradient + i, broadcast(0.0));
    }
  }
  return sum;
}

// The box with the shells of images that a rule needs.
LANESCAPE_INLINE Box with_shells_of(ImageSearch images, const Box& box) {
  if (images == ImageSearch::lattice) return box;
  const std::int32_t shells = images == ImageSearch::two_nearest ? 1 : 0;
  return {box.length, {shells, shells, shells}};
}

// A tile of rows of species a against all species from a on.
template <class Form, Output output, LengthUnit unit>
LANESCAPE_INLINE void tile_against_all(const PairInput& in, std::size_t a, std::size_t i, double* gradient, const Box& box,
                                       RowTile& rows, Totals& totals) {
  for (std::size_t b = a; b < in.block_count; ++b) {
    const SpeciesBlock& block = in.blocks[b];
    const PairParameters& pair = in.pairs[a * in.block_count + b];
    const auto u = Form::parameters(pair);
    const bool same = a == b;
    const EdgeLimits limits{i, same ? i / lanes * lanes : 0, block.count, in.blocks[a].count, same};
    const Columns columns{in.scratch + block.begin, has_gradient(output) ? gradient + block.begin : nullptr,
                          Form::has_diameters ? in.diameters + block.begin : nullptr, in.slots};
    const auto run = [&]<ImageSearch images>(const Box& in_box) __attribute__((always_inline)) {
      tile_against_block<Form, images, output, unit>(columns, block, limits, in_box, u, rows, totals);
    };
    if constexpr (output == Output::stress && !Form::specialised) {
      // One loop over shells of images for every rule: slower, and a third of the code to compile.
      run.template operator()<ImageSearch::lattice>(with_shells_of(pair.images, box));
      continue;
    }
    if (pair.images == ImageSearch::nearest) run.template operator()<ImageSearch::nearest>(box);
    if (pair.images == ImageSearch::two_nearest) run.template operator()<ImageSearch::two_nearest>(box);
    if constexpr (unit == LengthUnit::sigma)
      if (pair.images == ImageSearch::lattice) run.template operator()<ImageSearch::lattice>(box);
  }
}

template <class Form, Output output, LengthUnit unit>
void all_pairs(const PairInput& in, double* gradient, PairOutput& out) {
  const Vector sum_of_positions = start_all_pairs<output>(in, gradient);
  const Box box{{broadcast(in.box[0]), broadcast(in.box[1]), broadcast(in.box[2])}, {in.shells[0], in.shells[1], in.shells[2]}};
  Totals totals;
  for (std::size_t a = 0; a < in.block_count; ++a) {
    const SpeciesBlock& row_block = in.blocks[a];
    for (std::size_t i = 0; i < row_block.count; i += row_tile) {
      const double* x = in.scratch + row_block.begin + i;
      const Displacement none{broadcast(0.0), broadcast(0.0), broadcast(0.0)};
      RowTile rows{x,
                   x + in.slots,
                   x + 2 * in.slots,
                   Form::has_diameters ? in.diameters + row_block.begin + i : nullptr,
                   {none, none, none, none}};
      tile_against_all<Form, output, unit>(in, a, i, gradient, box, rows, totals);
      if constexpr (has_gradient(output)) {
        double* g = gradient + row_block.begin + i;
        const auto& t = rows.gradient;
        reduce_add_four(g, t[0].x, t[1].x, t[2].x, t[3].x);
        reduce_add_four(g + in.slots, t[0].y, t[1].y, t[2].y, t[3].y);
        reduce_add_four(g + 2 * in.slots, t[0].z, t[1].z, t[2].z, t[3].z);
      }
    }
  }
  if constexpr (has_gradient(output) && unit == LengthUnit::box) {
    const Vector inverse_length = broadcast(1.0 / in.box[0]);
    for (std::size_t i = 0; i < 3 * in.slots; i += lanes) store(gradient + i, load(gradient + i) * inverse_length);
  }
  out.energy = reduce_add(multiply_add(sum_of_positions, broadcast(0.0), totals.energy));
  out.virial = reduce_add(totals.virial);
  if constexpr (output == Output::stress)
    for (std::size_t k = 0; k < 6; ++k) out.virial_tensor[k] = reduce_add(totals.tensor[k]);
}

template <class Form, Output output>
LANESCAPE_INLINE void sum_all_pairs(const PairInput& in, double* gradient, PairOutput& out) {
  if constexpr (Form::specialised)
    if (in.unit == LengthUnit::box) return all_pairs<Form, output, LengthUnit::box>(in, gradient, out);
  all_pairs<Form, output, LengthUnit::sigma>(in, gradient, out);
  // Without loops of its own for each image rule, stress adds in another order. All but the tensor comes from the gradient's loops,
  // so that energies agree to the bit.
  if constexpr (output == Output::stress && !Form::specialised)
    all_pairs<Form, Output::gradient, LengthUnit::sigma>(in, gradient, out);
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
