// Linear algebra of matrices in panels. Nearly all of its time goes into one loop, subtract_products(): a tile of c in registers
// loses the products of a row of one matrix and a row of another, both read from beginning to end. Each element is a sum in the
// order of rows, whatever the tile.

#include <cmath>

#include "kernel_declarations.hpp"
#include "simd/simd.hpp"

namespace lanescape::kernels::LANESCAPE_ISA {
namespace {

// As many rows as leave registers for a row of vectors and a factor, which every lane shares.
constexpr std::size_t tile_rows = lanes == 8 ? 8 : 4, tile_vectors = 3, tile_columns = tile_vectors * lanes;

// Rows of U on the diagonal of a factor, which follow one another by panel_width.
struct Triangle {
  const double* first;
  double at(std::size_t row, std::size_t column) const noexcept { return first[row * panel_width + column]; }
};

// c(r, .) -= sum over k of a(k, r) b(k, .) for the rows and columns of a tile; then, if asked, c = U^-T c. All three pointers are
// to the first element of a row in a panel.
template <bool eliminate>
inline void subtract_products(double* c, const double* a, const double* b, std::size_t depth, Triangle u) noexcept {
  Vector sum[tile_rows][tile_vectors];
#pragma GCC unroll 8
  for (std::size_t r = 0; r < tile_rows; ++r)
#pragma GCC unroll 3
    for (std::size_t v = 0; v < tile_vectors; ++v) sum[r][v] = load(c + r * panel_width + v * lanes);
  for (std::size_t k = 0; k < depth; ++k) {
    const Vector b0 = load(b), b1 = load(b + lanes), b2 = load(b + 2 * lanes);
#pragma GCC unroll 8
    for (std::size_t r = 0; r < tile_rows; ++r) {
      const Vector factor = broadcast(a[r]);
      sum[r][0] = subtract_product(sum[r][0], factor, b0);
      sum[r][1] = subtract_product(sum[r][1], factor, b1);
      sum[r][2] = subtract_product(sum[r][2], factor, b2);
    }
    a += panel_width;
    b += panel_width;
  }
  if constexpr (eliminate) {
#pragma GCC unroll 8
    for (std::size_t r = 0; r < tile_rows; ++r) {
      const Vector reciprocal = broadcast(u.at(r, r));
#pragma GCC unroll 3
      for (std::size_t v = 0; v < tile_vectors; ++v) sum[r][v] = sum[r][v] * reciprocal;
#pragma GCC unroll 8
      for (std::size_t s = r + 1; s < tile_rows; ++s) {
        const Vector factor = broadcast(u.at(r, s));
#pragma GCC unroll 3
        for (std::size_t v = 0; v < tile_vectors; ++v) sum[s][v] = subtract_product(sum[s][v], factor, sum[r][v]);
      }
    }
  }
#pragma GCC unroll 8
  for (std::size_t r = 0; r < tile_rows; ++r)
#pragma GCC unroll 3
    for (std::size_t v = 0; v < tile_vectors; ++v) store(c + r * panel_width + v * lanes, sum[r][v]);
}

// The same over the whole width of a panel c, for its rows [row, row + tile_rows): the first `depth` rows of the panel b and of
// that panel of the matrix a which these rows are columns of.
template <bool eliminate>
inline void subtract_rows(double* c, const double* a, const double* b, std::size_t rows, std::size_t row,
                          std::size_t depth) noexcept {
  const Triangle triangle{a + panel_offset(rows, row, row)};
#pragma GCC unroll 1
  for (std::size_t column = 0; column < panel_width; column += tile_columns)
    subtract_products<eliminate>(c + row * panel_width + column, a + panel_offset(rows, 0, row), b + column, depth, triangle);
}

// The first `end` rows of a panel become U^-T times them.
inline void solve_rows(const double* factor, double* panel, std::size_t rows, std::size_t end) noexcept {
  for (std::size_t row = 0; row < end; row += tile_rows) subtract_rows<true>(panel, factor, panel, rows, row, row);
}

inline std::size_t smaller(std::size_t a, std::size_t b) noexcept { return a < b ? a : b; }

// Overwrites the upper triangle of a small matrix by its factor.
inline bool factor_triangle(double (&u)[tile_rows * panel_width]) noexcept {
  for (std::size_t r = 0; r < tile_rows; ++r) {
    double* row = u + r * panel_width;
    if (!(row[r] > 0.0 && row[r] < __builtin_inf())) return false;
    const double reciprocal = 1.0 / std::sqrt(row[r]);
    row[r] = reciprocal;
    for (std::size_t s = r + 1; s < tile_rows; ++s) row[s] *= reciprocal;
    for (std::size_t s = r + 1; s < tile_rows; ++s)
      for (std::size_t column = s; column < tile_rows; ++column) u[s * panel_width + column] -= row[s] * row[column];
  }
  return true;
}

// Rows [row, row + tile_rows) of the panel in which they cross the diagonal, whose rows above are known.
inline bool factor_rows(double* matrix, double* panel, std::size_t rows, std::size_t row) noexcept {
  subtract_rows<false>(panel, matrix, panel, rows, row, row);
  double* diagonal = matrix + panel_offset(rows, row, row);
  double triangle[tile_rows * panel_width];
  for (std::size_t r = 0; r < tile_rows; ++r)
    for (std::size_t column = r; column < tile_rows; ++column)
      triangle[r * panel_width + column] = diagonal[r * panel_width + column];
  if (!factor_triangle(triangle)) return false;
#pragma GCC unroll 1
  for (std::size_t column = 0; column < panel_width; column += tile_columns)
    subtract_products<true>(panel + row * panel_width + column, nullptr, nullptr, 0, Triangle{triangle});
  for (std::size_t r = 0; r < tile_rows; ++r)
    for (std::size_t column = r; column < tile_rows; ++column)
      diagonal[r * panel_width + column] = triangle[r * panel_width + column];
  return true;
}

// out[column] -= sum over rows of w(row, column) x[row], for the columns of a panel and its first rows.
inline void subtract_transposed(double* out, const double* w, const double* x, std::size_t rows) noexcept {
  constexpr std::size_t vectors = panel_width / lanes, chains = lanes == 8 ? 4 : lanes == 4 ? 2 : 1;
  Vector sum[chains][vectors];
  for (auto& chain : sum)
    for (Vector& v : chain) v = broadcast(0.0);
  for (std::size_t row = 0; row < rows; row += chains)
#pragma GCC unroll 4
    for (std::size_t k = 0; k < chains; ++k) {
      const Vector factor = broadcast(x[row + k]);
#pragma GCC unroll 12
      for (std::size_t v = 0; v < vectors; ++v)
        sum[k][v] = multiply_add(factor, load(w + (row + k) * panel_width + v * lanes), sum[k][v]);
    }
  for (std::size_t v = 0; v < vectors; ++v) {
    Vector total = sum[0][v];
    for (std::size_t k = 1; k < chains; ++k) total += sum[k][v];
    store(out + v * lanes, load(out + v * lanes) - total);
  }
}

// out[row] -= sum over columns of w(row, column) x[column], for the same.
inline void subtract_plain(double* out, const double* w, const double* x, std::size_t rows) noexcept {
  constexpr std::size_t vectors = panel_width / lanes;
  for (std::size_t row = 0; row < rows; row += 4) {
    Vector sum[4] = {broadcast(0.0), broadcast(0.0), broadcast(0.0), broadcast(0.0)};
#pragma GCC unroll 12
    for (std::size_t v = 0; v < vectors; ++v) {
      const Vector factor = broadcast(0.0) - load(x + v * lanes);
#pragma GCC unroll 4
      for (std::size_t r = 0; r < 4; ++r) sum[r] = multiply_add(load(w + (row + r) * panel_width + v * lanes), factor, sum[r]);
    }
    reduce_add_four(out + row, sum[0], sum[1], sum[2], sum[3]);
  }
}

}  // namespace

bool panel_cholesky(double* matrix, std::size_t rows) noexcept {
  for (std::size_t column = 0; column < rows; column += panel_width) {
    double* panel = matrix + column * rows;
    solve_rows(matrix, panel, rows, column);
    for (std::size_t row = column; row < smaller(column + panel_width, rows); row += tile_rows)
      if (!factor_rows(matrix, panel, rows, row)) return false;
  }
  return true;
}

void panel_subtract_gram(double* c, const double* w, std::size_t rows, std::size_t panel) noexcept {
  const std::size_t column = panel * panel_width;
  for (std::size_t row = 0; row < smaller(column + panel_width, rows); row += tile_rows)
    subtract_rows<false>(c + column * rows, w, w + column * rows, rows, row, rows);
}

void panel_solve_transposed(const double* factor, double* panel, std::size_t rows) noexcept {
  solve_rows(factor, panel, rows, rows);
}

void panel_forward(const double* factor, double* x, std::size_t rows) noexcept {
  for (std::size_t begin = 0; begin < rows; begin += panel_width) {
    const double* panel = factor + begin * rows;
    subtract_transposed(x + begin, panel, x, begin);
    for (std::size_t row = begin; row < smaller(begin + panel_width, rows); ++row) {
      x[row] *= panel[row * panel_width + row - begin];
      for (std::size_t column = row + 1; column < begin + panel_width; ++column)
        x[column] -= panel[row * panel_width + column - begin] * x[row];
    }
  }
}

void panel_backward(const double* factor, double* x, std::size_t rows) noexcept {
  for (std::size_t begin = panel_count(rows) * panel_width; begin > 0;) {
    begin -= panel_width;
    const double* panel = factor + begin * rows;
    for (std::size_t row = smaller(begin + panel_width, rows); row-- > begin;) {
      for (std::size_t column = row + 1; column < begin + panel_width; ++column)
        x[row] -= panel[row * panel_width + column - begin] * x[column];
      x[row] *= panel[row * panel_width + row - begin];
    }
    subtract_plain(x, panel, x + begin, begin);
  }
}

}  // namespace lanescape::kernels::LANESCAPE_ISA
