#include "path/shortening/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/float_environment.hpp"
#include "core/parallel.hpp"

namespace lanescape {
namespace {

// Of second derivatives that are taken into account, where strings have about 1: of gaps, and of their barrier.
constexpr double least_stiffness = 1e-9, least_barrier = 1e-4;
constexpr double most_of_the_way = 0.99;  // to where a slack or a multiplier vanishes

double norm(const AlignedArray& x) { return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0)); }

}  // namespace

InteriorPoint::InteriorPoint(const kernels::KernelTable& kernels, std::size_t nodes, std::size_t dimension, int threads)
    : inner_(nodes - 2), dimension_(dimension), threads_(threads), matrix_(kernels, inner_, dimension, threads) {
  for (auto* field : {&moves_, &rest_, &step_}) field->assign(inner_, AlignedArray(dimension, 0.0));
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
  of_segment_.assign(segments.size(), 0.0);
  for_each_segment(segments, [&](std::size_t k, const std::vector<GapConstraint>& gaps) {
    for (const GapConstraint& c : gaps)
      of_segment_[k] += (c.slack + lengths.primal * c.slack_step) * (c.multiplier + lengths.dual * c.multiplier_step);
  });
  std::size_t count = 0;
  for (const auto& gaps : segments) count += gaps.size();
  return count == 0 ? 0.0 : std::accumulate(of_segment_.begin(), of_segment_.end(), 0.0) / static_cast<double>(count);
}

// What softness takes off the pull of a segment on the node before (side 0) or behind it.
void InteriorPoint::soften(const String& string, std::size_t segment, std::size_t side, AlignedArray& rest) const {
  const double *from = node(moves_, segment), *to = node(moves_, segment + 1), *tangent = string.tangents[segment].data();
  double longer = 0.0;
  for (std::size_t q = 0; q < dimension_; ++q) longer += tangent[q] * ((to ? to[q] : 0.0) - (from ? from[q] : 0.0));
  const double pull = (side == 0 ? 1.0 : -1.0) * string.softness * string.tensions[segment] * longer;
  for (std::size_t q = 0; q < dimension_; ++q) rest[q] += pull * tangent[q];
}

// The gradient of the string and the forces of the gaps, which balance at the minimum.
void InteriorPoint::set_rest(const String& string, Segments& segments) {
  for_each_inner([&](std::size_t k) {
    AlignedArray& rest = rest_[k - 1];
    const double before = string.tensions[k - 1], behind = string.tensions[k];
    const double *here = node(moves_, k), *last = node(moves_, k - 1), *next = node(moves_, k + 1);
    for (std::size_t q = 0; q < dimension_; ++q)
      rest[q] = string.gradient[k - 1][q] + (before + behind + string.damping) * here[q] - (last ? before * last[q] : 0.0) -
                (next ? behind * next[q] : 0.0);
    for (const std::size_t side : {std::size_t{1}, std::size_t{0}}) {
      if (string.softness > 0.0) soften(string, k - side, side, rest);
      for (const GapConstraint& c : segments[k - side]) {
        c.push(side, -c.multiplier, rest.data());
        if (c.stiffness <= least_stiffness) continue;
        const double *start = node(moves_, k - side), *end = node(moves_, k - side + 1);
        c.push_turn(side, c.stiffness * c.turn(start, end), rest.data());
        if (bulge_ > 0.0) c.push(side, -bulge_ * c.stiffness, c.across(start, end), rest.data());
      }
    }
  });
}

double InteriorPoint::largest_rest() const {
  double largest = 0.0;
  for (const AlignedArray& rest : rest_) largest = std::max(largest, norm(rest));
  return largest;
}

double InteriorPoint::largest_violation(Segments& segments) {
  of_segment_.assign(segments.size(), 0.0);
  for_each_segment(segments, [&](std::size_t k, const std::vector<GapConstraint>& gaps) {
    for (const GapConstraint& c : gaps)
      of_segment_[k] = std::max(of_segment_[k], std::abs(c.gap + c.change(node(moves_, k), node(moves_, k + 1)) - c.slack));
  });
  return *std::max_element(of_segment_.begin(), of_segment_.end());
}

// The second derivatives of the string, of the gaps' barrier and of the gaps themselves.
void InteriorPoint::assemble(const String& string, const Segments& segments) {
  const auto products = [bulge = bulge_](const GapConstraint& c, std::size_t row, std::size_t column, const auto& add) {
    const bool curved = c.stiffness > least_stiffness;
    const double share = c.shares[row] * c.shares[column], round = curved ? bulge * c.stiffness * share : 0.0;
    const double along = share * c.multiplier / c.slack + round;
    if (along < least_barrier && !curved) return;
    for (std::size_t s = 0; s < 2; ++s)
      for (std::size_t t = 0; t < 2; ++t)
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b)
            add(c.at[s] + a, c.at[t] + b,
                c.scales[s] * c.scales[t] * (along * c.normal[a] * c.normal[b] - (a == b ? round : 0.0)) +
                    (curved ? c.stiffness * c.turns[row][s][a] * c.turns[column][t][b] : 0.0));
  };
  matrix_.set_zero();
  for_each_inner([&](std::size_t k) {
    for (std::size_t q = 0; q < dimension_; ++q)
      matrix_.add(k - 1, q, q, string.tensions[k - 1] + string.tensions[k] + string.damping);
    const auto to_node = [&](std::size_t row, std::size_t column, double x) {
      if (row <= column) matrix_.add(k - 1, row, column, x);
    };
    if (string.softness > 0.0) {
      for (const std::size_t j : {k - 1, k})
        matrix_.add_square(k - 1, -string.softness * string.tensions[j], string.tangents[j].data());
      if (k < inner_) matrix_.add_coupling_square(k - 1, string.softness * string.tensions[k], string.tangents[k].data());
    }
    for (const GapConstraint& c : segments[k - 1]) products(c, 1, 1, to_node);
    for (const GapConstraint& c : segments[k]) products(c, 0, 0, to_node);
    if (k == inner_) return;
    for (std::size_t q = 0; q < dimension_; ++q) matrix_.add_coupling(k - 1, q, q, -string.tensions[k]);
    const auto to_coupling = [&](std::size_t row, std::size_t column, double x) { matrix_.add_coupling(k - 1, row, column, x); };
    for (const GapConstraint& c : segments[k]) products(c, 0, 1, to_coupling);
  });
}

// Newton's step towards products of slacks and multipliers equal to `target`; corrected by the products of the step before. Returns
// how far it may be taken until the first slack or multiplier vanishes, at most all of it.
InteriorPoint::Lengths InteriorPoint::find_step(Segments& segments, double target, bool corrected) {
  for_each_segment(segments, [&](std::size_t k, std::vector<GapConstraint>& gaps) {
    for (GapConstraint& c : gaps) {
      const double product = target - (corrected ? c.slack_step * c.multiplier_step : 0.0);
      const double open = c.gap + c.change(node(moves_, k), node(moves_, k + 1)) - c.slack;
      c.multiplier_step = product / c.slack - c.multiplier;
      c.slack_step = open;
    }
  });
  for_each_inner([&](std::size_t k) {
    AlignedArray& right = step_[k - 1];
    for (std::size_t q = 0; q < dimension_; ++q) right[q] = -rest_[k - 1][q];
    const auto force = [](const GapConstraint& c) { return c.multiplier_step - c.multiplier / c.slack * c.slack_step; };
    for (const GapConstraint& c : segments[k - 1]) c.push(1, force(c), right.data());
    for (const GapConstraint& c : segments[k]) c.push(0, force(c), right.data());
  });
  matrix_.solve(step_);
  std::vector<Lengths> allowed(segments.size());
  for_each_segment(segments, [&](std::size_t k, std::vector<GapConstraint>& gaps) {
    Lengths most;
    for (GapConstraint& c : gaps) {
      c.slack_step += c.change(node(step_, k), node(step_, k + 1));
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
    const double now = complementarity(segments, {0.0, 0.0});
    set_rest(string, segments);
    if (steps > 0 && now <= 2.0 * goal.barrier && largest_rest() <= goal.force && largest_violation(segments) <= goal.violation)
      break;
    assemble(string, segments);
    if (!matrix_.factor()) {
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
