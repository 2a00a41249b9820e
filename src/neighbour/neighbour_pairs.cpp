#include "neighbour/neighbour_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <tuple>

#include "configuration/particle_layout.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "neighbour/periodic_points.hpp"

namespace lanescape {
namespace {

// Beyond these limits squares overflow or vanish, single precision resolves nothing, or shifts leave no digits for a position.
constexpr double least_cutoff = 1e-100, most_cutoff = 1e100;
constexpr double most_cutoffs_per_edge = 1e9;
constexpr double most_boxes_away = 1e8;
// Offsets are 32-bit numbers.
constexpr double most_points = 4294967295.0 / static_cast<double>(kernels::point_width);

void check_lengths(const Box& box, double cutoff) {
  if (!(cutoff >= least_cutoff && cutoff <= most_cutoff))
    throw_bad_input(fmt::format("cutoff {} is not allowed: it must be from {} to {}", cutoff, least_cutoff, most_cutoff));
  for (const double edge : box.length)
    if (!(edge > 0.0 && edge <= most_cutoffs_per_edge * cutoff))
      throw_bad_input(fmt::format("box edge {} is not allowed: it must be finite, above 0 and at most {}, which is {} cutoffs",
                                  edge, most_cutoffs_per_edge * cutoff, most_cutoffs_per_edge));
  if (cutoff > max_boxes_in_cutoff * box.shortest())
    throw_bad_input(fmt::format("cutoff {} is not allowed in a box whose shortest edge is {}: at most {} is, {} edges", cutoff,
                                box.shortest(), max_boxes_in_cutoff * box.shortest(), max_boxes_in_cutoff));
}

void check_positions(const Box& box, std::span<const double> positions, double cutoff) {
  if (positions.size() % 3 != 0)
    throw_bad_input(fmt::format("{} coordinates were given: 3 for each particle are needed", positions.size()));
  for (std::size_t k = 0; k < positions.size(); ++k)
    if (!(std::abs(positions[k]) <= most_boxes_away * box.length[k % 3]))
      throw_bad_input(
          fmt::format("{} coordinate {} of particle {} (from 0) is not allowed: it must be finite and at most {} boxes from 0",
                      "xyz"[k % 3], positions[k], k / 3, most_boxes_away));
  double points = static_cast<double>(positions.size() / 3);
  for (const double edge : box.length) points *= std::floor(1.0 + 2.0 * cutoff / edge) + 1.0;
  if (points > most_points)
    throw_bad_input(fmt::format("{} particles may have {:.3g} images within the cutoff {} of the box: at most {:.3g} are allowed",
                                positions.size() / 3, points, cutoff, most_points));
}

// Candidates for pairs. It works in a unit of length near the cutoff, a power of two, so that squares in single precision neither
// overflow nor vanish, and nothing is rounded by the change of units.
class CandidateSearch {
 public:
  CandidateSearch(const Box& box, std::span<const double> positions, double cutoff, const kernels::KernelTable& table)
      : table_(&table),
        exponent_(-std::ilogb(cutoff)),
        box_{{in_unit(box.length[0]), in_unit(box.length[1]), in_unit(box.length[2])}},
        layout_(std::vector<int>(positions.size() / 3, 0), 1),
        rounding_(rounding(positions, cutoff)),
        reach_(in_unit(cutoff) + rounding_),
        points_(box_, layout_, {reach_ + rounding_}, 1),
        place_of_(layout_.slots()),
        particle_in_(layout_.slots()),
        found_(256) {
    std::vector<double> in_units(positions.size());
    std::transform(positions.begin(), positions.end(), in_units.begin(), [&](double x) { return in_unit(x); });
    points_.sort(layout_.to_slots(in_units));
    boxes_.reserve(points_.size());
    for (std::size_t k = 0; k < points_.size(); ++k) boxes_.push_back(points_.boxes(k));
    for (const std::uint32_t place : points_.rows(0)) place_of_[points_.slot(place / kernels::point_width)] = place;
    for (std::size_t i = 0; i < layout_.size(); ++i) particle_in_[layout_.slot_of(i)] = i;
  }

  // Calls visit(j, shift) for each image that may be within the cutoff of particle i, in any order.
  template <class Visit>
  void visit(std::size_t i, Visit visit) {
    const std::size_t self = place_of_[layout_.slot_of(i)] / kernels::point_width;
    const std::array<int, 3>& home = boxes_[self];
    for (const std::uint32_t place : places_near(self)) {
      const std::size_t other = place / kernels::point_width;
      const std::array<int, 3>& boxes = boxes_[other];
      visit(particle_in_[points_.slot(other)], std::array<int, 3>{boxes[0] - home[0], boxes[1] - home[1], boxes[2] - home[2]});
    }
  }

 private:
  double in_unit(double length) const { return std::scalbn(length, exponent_); }

  // An upper bound on the difference between separations of points and of the caller's positions: each takes a few operations.
  double rounding(std::span<const double> positions, double cutoff) const {
    double largest = in_unit(cutoff);
    for (const double edge : box_.length) largest = std::max(largest, edge);
    for (const double x : positions) largest = std::max(largest, std::abs(in_unit(x)));
    return 1e-14 * largest;
  }

  std::span<const std::uint32_t> places_near(std::size_t self) {
    const double* position = points_.point(self);
    const kernels::NeighbourQuery query{{position[0], position[1], position[2]}, reach_, static_cast<std::uint32_t>(self)};
    std::size_t count = 0;
    while ((count = table_->points_within(points_.grid(0), query, found_.data(), found_.size())) > found_.size())
      found_.resize(2 * found_.size());
    return {found_.data(), count};
  }

  const kernels::KernelTable* table_;
  int exponent_;
  Box box_;
  ParticleLayout layout_;
  double rounding_, reach_;
  PeriodicPoints points_;
  std::vector<std::array<int, 3>> boxes_;  // added to each point's particle
  std::vector<std::uint32_t> place_of_;    // of each slot's particle, in the box
  std::vector<std::size_t> particle_in_;
  AlignedVector<std::uint32_t> found_;
};

struct Partner {
  std::size_t particle;
  std::array<int, 3> shift;
  std::array<double, 3> separation;
  double distance;
};

void append(OrderedPairs& pairs, std::size_t first, const std::vector<Partner>& partners) {
  for (const Partner& partner : partners) {
    pairs.first.push_back(first);
    pairs.second.push_back(partner.particle);
    pairs.shift.push_back(partner.shift);
    pairs.separation.push_back(partner.separation);
    pairs.distance.push_back(partner.distance);
  }
}

void find_pairs(const Box& box, std::span<const double> positions, double cutoff, const kernels::KernelTable& table,
                OrderedPairs& pairs) {
  CandidateSearch search(box, positions, cutoff, table);
  std::vector<Partner> partners;
  for (std::size_t i = 0; i < positions.size() / 3; ++i) {
    partners.clear();
    search.visit(i, [&](std::size_t j, const std::array<int, 3>& shift) {
      std::array<double, 3> d{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        d[axis] = (positions[3 * j + axis] - positions[3 * i + axis]) + shift[axis] * box.length[axis];
      const double distance = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      if (distance < cutoff) partners.push_back({j, shift, d, distance});
    });
    std::sort(partners.begin(), partners.end(),
              [](const Partner& a, const Partner& b) { return std::tie(a.particle, a.shift) < std::tie(b.particle, b.shift); });
    append(pairs, i, partners);
  }
}

}  // namespace

OrderedPairs ordered_pairs(const Box& box, std::span<const double> positions, double cutoff, const kernels::KernelTable& table) {
  const FloatEnvironment environment;
  check_lengths(box, cutoff);
  check_positions(box, positions, cutoff);
  OrderedPairs pairs;
  if (positions.empty()) return pairs;
  try {
    find_pairs(box, positions, cutoff, table, pairs);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::internal, fmt::format("no memory for all pairs of {} particles within {}: {} were found so far",
                                                 positions.size() / 3, cutoff, pairs.first.size()));
  }
  return pairs;
}

}  // namespace lanescape
