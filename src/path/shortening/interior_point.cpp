#include "path/shortening/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/float_environment.hpp"
#include "core/parallel.hpp"

namespace lanescape {
namespace {

// Of second derivatives that are taken into account, where strings have about 1: of gaps, and of their barrier.
constexpr double least_stiffness = 1e-4, least_barrier = 1e-4;
constexpr double most_of_the_way = 0.99;  // to where a slack or a multiplier vanishes

double norm(const AlignedArray& x) { return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0)); }

}  // namespace

InteriorPoint::InteriorPoint(const kernels::KernelTable& kernels, std::size_t nodes, std::size_t dimension, int threads)
    : inner_(nodes - 2), dimension_(dimension), threads_(threads), matrix_(kernels, inner_, dimension, threads) {
  for (auto* field : {&moves_, &rest_, &step_}) field->assign(inner_, AlignedArray(dimension, 0.0));
  for (auto& field : pulls_) field.assign(nodes - 1, AlignedArray(dimension, 0.0));
}

// Of node k of the path; null at its ends, which stay.
const double* InteriorPoint::node(const std::vector<AlignedArray>& field, std::size_t k) const {
  return k == 0 || k > inner_ ? nullptr : field[k - 1].data();
}

template <class Body>
void InteriorPoint::for_each_inner(const Body& body) const {
  const FloatEnvironment environment;
  for_each_block(threads_, inner_, [&](std::size_t k) { body(k + 1); });
}

template <class Body>
void InteriorPoint::for_each_segment(Segments& segments, const Body& body) const {
  const FloatEnvironment environment;
  for_each_block(threads_, segments.size(), [&](std::size_t k) { body(k, segments[k]); });
}

// The mean product of slacks and multipliers after a step of these lengths.
double InteriorPoint::complementarity(Segments& segments, const Lengths& lengths) {
  of_segment_.assign(segments.size(), {0.0, 0.0});
  for_each_segment(segments, [&](std::size_t k, const std::vector<GapConstraint>& gaps) {
    double sum = 0.0;
    for (const GapConstraint& c : gaps)
      sum += (c.slack + lengths.primal * c.slack_step) * (c.multiplier + lengths.dual * c.multiplier_step);
    of_segment_[k].product = sum;
  });
  return total(segments).product;
}

InteriorPoint::State InteriorPoint::total(const Segments& segments) const {
  State sum{0.0, 0.0};
  std::size_t count = 0;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    sum.product += of_segment_[k].product;
    sum.violation = std::max(sum.violation, of_segment_[k].violation);
    count += segments[k].size();
  }
  if (count > 0) sum.product /= static_cast<double>(count);
  return sum;
}

// What softness takes off the pulls of a segment.
void InteriorPoint::soften(const String& string, std::size_t segment) {
  const double *from = node(moves_, segment), *to = node(moves_, segment + 1), *tangent = string.tangents[segment].data();
  double longer = 0.0;
  for (std::size_t q = 0; q < dimension_; ++q) longer += tangent[q] * ((to ? to[q] : 0.0) - (from ? from[q] : 0.0));
  const double pull = string.softness * string.tensions[segment] * longer;
  for (std::size_t q = 0; q < dimension_; ++q) {
    pulls_[0][segment][q] += pull * tangent[q];
    pulls_[1][segment][q] -= pull * tangent[q];
  }
}

void InteriorPoint::clear_pulls(std::size_t segment) {
  for (auto& field : pulls_) std::fill(field[segment].begin(), field[segment].end(), 0.0);
}

void InteriorPoint::add_pulls(std::size_t k, AlignedArray& out) const {
  const AlignedArray &behind = pulls_[1][k - 1], &before = pulls_[0][k];
  for (std::size_t q = 0; q < dimension_; ++q) out[q] += behind[q] + before[q];
}

// The gradient of the string and the forces of the gaps, which balance at the minimum.
InteriorPoint::State InteriorPoint::survey(const String& string, Segments& segments) {
  of_segment_.assign(segments.size(), {0.0, 0.0});
  for_each_segment(segments, [&](std::size_t k, const std::vector<GapConstraint>& gaps) {
    clear_pulls(k);
    if (string.softness > 0.0) soften(string, k);
    double *before = pulls_[0][k].data(), *behind = pulls_[1][k].data();
    const double *start = node(moves_, k), *end = node(moves_, k + 1);
    State sum{0.0, 0.0};
    for (const GapConstraint& c : gaps) {
      const Point moved = c.displacement(start, end);
      const double along = dot(moved, c.normal);
      sum.product += c.slack * c.multiplier;
      sum.violation = std::max(sum.violation, std::abs(c.gap + along - c.slack));
      Point force;
      const bool curved = c.stiffness > least_stiffness;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        force[axis] = -c.multiplier * c.normal[axis];
        if (curved) force[axis] -= bulge_ * c.stiffness * (moved[axis] - along * c.normal[axis]);
      }
      c.push(0, 1.0, force, before);
      c.push(1, 1.0, force, behind);
      if (!curved || !c.turning()) continue;
      const double turn = c.stiffness * c.turn(start, end);
      c.push_turn(0, turn, before);
      c.push_turn(1, turn, behind);
    }
    of_segment_[k] = sum;
  });
  for_each_inner([&](std::size_t k) {
    AlignedArray& rest = rest_[k - 1];
    const double before = string.tensions[k - 1], behind = string.tensions[k];
    const double *here = node(moves_, k), *last = node(moves_, k - 1), *next = node(moves_, k + 1);
    for (std::size_t q = 0; q < dimension_; ++q)
      rest[q] = string.gradient[k - 1][q] + (before + behind + string.damping) * here[q] - (last ? before * last[q] : 0.0) -
                (next ? behind * next[q] : 0.0);
    add_pulls(k, rest);
  });
  return total(segments);
}

double InteriorPoint::largest_rest() const {
  double largest = 0.0;
  for (const AlignedArray& rest : rest_) largest = std::max(largest, norm(rest));
  return largest;
}

// The second derivatives of a gap and of its barrier with moves of the first sphere at one node and the second at another:
// add(sphere, other sphere, square).
template <class Add>
void InteriorPoint::second_derivatives(const GapConstraint& c, std::size_t row, std::size_t column, const Add& add) const {
  const bool curved = c.stiffness > least_stiffness;
  const double share = c.shares[row] * c.shares[column], round = curved ? bulge_ * c.stiffness * share : 0.0;
  const double along = share * c.multiplier / c.slack + round;
  if (along < least_barrier && !curved) return;
  BlockTridiagonal::Square outer, square;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) outer[a][b] = along * c.normal[a] * c.normal[b] - (a == b ? round : 0.0);
  const bool turning = curved && c.turning();
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t t = 0; t < 2; ++t) {
      if (row == column && c.at[s] > c.at[t]) continue;
      const double scale = c.scales[s] * c.scales[t];
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
          square[a][b] = scale * outer[a][b] + (turning ? c.stiffness * c.turns[row][s][a] * c.turns[column][t][b] : 0.0);
      add(c.at[s], c.at[t], square);
    }
}

void InteriorPoint::add_diagonal(const String& string, const Segments& segments, std::size_t k) {
  for (std::size_t q = 0; q < dimension_; ++q)
    matrix_.add(k - 1, q, q, string.tensions[k - 1] + string.tensions[k] + string.damping);
  if (string.softness > 0.0)
    for (const std::size_t j : {k - 1, k})
      matrix_.add_product(k - 1, -string.softness * string.tensions[j], string.tangents[j].data());
  const auto add = [&](std::size_t row, std::size_t column, const BlockTridiagonal::Square& x) {
    matrix_.add(k - 1, row, column, x);
  };
  for (const GapConstraint& c : segments[k - 1]) second_derivatives(c, 1, 1, add);
  for (const GapConstraint& c : segments[k]) second_derivatives(c, 0, 0, add);
}

// Of a node and the next.
void InteriorPoint::set_coupling(const String& string, const Segments& segments, std::size_t k,
                                 BlockTridiagonal::Coupling& out) const {
  out.unit = -string.tensions[k];
  out.factor = string.softness * string.tensions[k];
  out.x = string.softness > 0.0 ? string.tangents[k].data() : nullptr;
  out.terms.clear();
  const auto add = [&](std::size_t row, std::size_t column, const BlockTridiagonal::Square& x) {
    out.terms.push_back({row, column, x});
  };
  for (const GapConstraint& c : segments[k])
    if (c.shares[0] != 0.0 && c.shares[1] != 0.0) second_derivatives(c, 0, 1, add);
}

// The second derivatives of the string, of the gaps' barrier and of the gaps themselves.
bool InteriorPoint::factor(const String& string, const Segments& segments) {
  return matrix_.factor({[&](std::size_t block) {
                           const FloatEnvironment environment;
                           add_diagonal(string, segments, block + 1);
                         },
                         [&](std::size_t block, BlockTridiagonal::Coupling& coupling) {
                           const FloatEnvironment environment;
                           set_coupling(string, segments, block + 1, coupling);
                         }});
}

// Newton's step towards products of slacks and multipliers equal to `target`; corrected by the products of the step before. Returns
// how far it may be taken until the first slack or multiplier vanishes, at most all of it.
InteriorPoint::Lengths InteriorPoint::find_step(Segments& segments, double target, bool corrected) {
  for_each_segment(segments, [&](std::size_t k, std::vector<GapConstraint>& gaps) {
    clear_pulls(k);
    const double *start = node(moves_, k), *end = node(moves_, k + 1);
    for (GapConstraint& c : gaps) {
      const double product = target - (corrected ? c.slack_step * c.multiplier_step : 0.0);
      c.slack_step = c.gap + c.change(start, end) - c.slack;
      const double reciprocal = 1.0 / c.slack;
      c.multiplier_step = product * reciprocal - c.multiplier;
      const double force = c.multiplier_step - c.multiplier * reciprocal * c.slack_step;
      c.push(0, force, pulls_[0][k].data());
      c.push(1, force, pulls_[1][k].data());
    }
  });
  for_each_inner([&](std::size_t k) {
    AlignedArray& right = step_[k - 1];
    for (std::size_t q = 0; q < dimension_; ++q) right[q] = -rest_[k - 1][q];
    add_pulls(k, right);
  });
  matrix_.solve(step_);
  return allowed(segments);
}

// Completes a step by that of slacks and multipliers.
InteriorPoint::Lengths InteriorPoint::allowed(Segments& segments) {
  std::vector<Lengths> allowed(segments.size());
  for_each_segment(segments, [&](std::size_t k, std::vector<GapConstraint>& gaps) {
    Lengths most;
    const double *start = node(step_, k), *end = node(step_, k + 1);
    for (GapConstraint& c : gaps) {
      c.slack_step += c.change(start, end);
      c.multiplier_step -= c.multiplier / c.slack * c.slack_step;
      if (c.slack_step < 0.0) most.primal = std::min(most.primal, -c.slack / c.slack_step);
      if (c.multiplier_step < 0.0) most.dual = std::min(most.dual, -c.multiplier / c.multiplier_step);
    }
    allowed[k] = most;
  });
  Lengths lengths;
  for (const Lengths& most : allowed) {
    lengths.primal = std::min(lengths.primal, most.primal);
    lengths.dual = std::min(lengths.dual, most.dual);
  }
  return lengths;
}

void InteriorPoint::take_step(Segments& segments, const Lengths& lengths) {
  for_each_inner([&](std::size_t k) {
    for (std::size_t q = 0; q < dimension_; ++q) moves_[k - 1][q] += lengths.primal * step_[k - 1][q];
  });
  for_each_segment(segments, [&](std::size_t, std::vector<GapConstraint>& gaps) {
    for (GapConstraint& c : gaps) {
      c.slack += lengths.primal * c.slack_step;
      c.multiplier += lengths.dual * c.multiplier_step;
    }
  });
}

void InteriorPoint::solve(const String& string, Segments& segments, const Goal& goal) {
  for (AlignedArray& move : moves_) std::fill(move.begin(), move.end(), 0.0);
  bulge_ = string.bulge;
  for (int steps = 0; steps < goal.most_steps; ++steps) {
    const auto [now, violation] = survey(string, segments);
    if (steps > 0 && now <= 2.0 * goal.barrier && violation <= goal.violation && largest_rest() <= goal.force) break;
    if (!factor(string, segments)) {
      if (bulge_ == 0.0) return;
      bulge_ = bulge_ > 0.2 ? 0.5 * bulge_ : 0.0;
      continue;
    }
    const double predicted = complementarity(segments, find_step(segments, 0.0, false));
    const double share = now > 0.0 ? predicted / now : 0.0;
    Lengths lengths = find_step(segments, std::max(share * share * share * now, goal.barrier), true);
    for (double* length : {&lengths.primal, &lengths.dual})
      if (*length < 1.0) *length *= most_of_the_way;
    take_step(segments, lengths);
  }
}

}  // namespace lanescape
