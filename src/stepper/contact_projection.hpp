#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/aligned_array.hpp"
#include "interaction/sphere/gap_list.hpp"

namespace lanescape {

// Projects a wished displacement of all spheres on those that no contact forbids: of all u with g_c + n_c.(u_j - u_i) >= 0 for
// every pair c = (i, j) with gap g_c and normal n_c, the u that minimises sum_i m_i |u_i - w_i|^2.
//
// As |r + u| >= n.(r + u), the whole straight way along u is then free of overlaps between the listed pairs.
//
// The dual is a non-negative least-squares problem for the multipliers: minimise |w + M^-1 A^T lambda|_M^2 / 2 + lambda.g over
// lambda >= 0. Gauss-Seidel sweeps find which contacts act; conjugate gradients solve for their multipliers, and drop a contact
// whose multiplier would become negative. Both lower the dual at every step, so that dependent contacts cannot make it cycle.
class ContactProjection {
 public:
  struct Options {
    double margin = 1e-12;     // of a gap, kept so that rounding makes no overlap [sigma]
    double tolerance = 4e-13;  // of gaps [sigma]; rounding leaves about 1e-15
    int max_rounds = 1000;     // of sweeps followed by conjugate gradients
  };

  // `inverse_masses` per slot, of any unit.
  ContactProjection(AlignedArray inverse_masses, const Options& options);

  // Replaces the wish w by u. `multipliers`, one per pair, are a first guess, such as those of the last step, and then the result:
  // u = w + M^-1 sum_c lambda_c A_c^T. Returns whether the tolerance was met; without it nothing is promised of u. A pair of one
  // sphere with itself is ignored. Vectors are all x, all y, all z.
  bool project(std::span<const PairGap> pairs, AlignedArray& displacement, std::vector<double>& multipliers);

  std::uint64_t rounds() const { return rounds_; }  // so far

 private:
  // A constraint g + a.(u_j - u_i) >= 0 with a = n scaled so that the diagonal of A M^-1 A^T is 1.
  struct Row {
    std::size_t i, j, pair;
    Point a;
    double scale;
  };
  // Of A M^-1 A^T, off its diagonal.
  struct Entry {
    std::uint32_t column;
    double value;
  };

  double allowed_approach(double gap) const;
  void collect(std::span<const PairGap> pairs, const AlignedArray& wish, const std::vector<double>& multipliers);
  void add_row(const PairGap& pair, std::size_t number, double multiplier);
  bool add_violated(std::span<const PairGap> pairs);
  void couple_rows();
  double coupling(const Row& row, std::size_t shared, const Row& other) const;
  void move_by_multipliers();
  double gap(std::size_t row) const;
  void sweep();
  double worst_row() const;
  bool solve_rows();
  double begin_face();
  double length_to_minimum(double squared);
  double allowed_length(double length) const;
  bool solve_face();
  void give(AlignedArray& displacement, std::vector<double>& multipliers) const;

  AlignedArray inverse_masses_;
  Options options_;
  std::vector<Point> wish_, u_;  // per slot
  std::vector<char> listed_;     // pairs that have a row
  std::vector<Row> rows_;
  std::vector<double> lambda_, at_wish_;  // per row: its multiplier, and its gap if u were w
  std::vector<std::size_t> row_begin_, slot_begin_, slot_rows_;
  std::vector<Entry> entries_;
  std::vector<std::size_t> face_, face_begin_;  // rows that act; the same numbers and arrays for them alone
  std::vector<std::uint32_t> in_face_;          // per row
  std::vector<Entry> face_entries_;
  std::vector<double> at_face_, gaps_, direction_, image_;
  std::uint64_t rounds_ = 0;
};

}  // namespace lanescape
