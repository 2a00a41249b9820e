#pragma once

#include <cstddef>

// Dense square matrices for linear algebra, in panels of 24 columns: a panel's rows follow one another, so that kernels read panels
// from beginning to end. There are `rows` rows, a multiple of slot_padding, and as many columns, filled up with zeros to whole
// panels. Vectors have as many numbers as there are columns in all panels.
namespace lanescape::kernels {

// Three vectors of the widest instruction set.
inline constexpr std::size_t panel_width = 24;

constexpr std::size_t panel_count(std::size_t rows) { return (rows + panel_width - 1) / panel_width; }
// Where an element is.
constexpr std::size_t panel_offset(std::size_t rows, std::size_t row, std::size_t column) {
  const std::size_t panel = column / panel_width;
  return (panel * rows + row) * panel_width + (column - panel * panel_width);
}

}  // namespace lanescape::kernels
