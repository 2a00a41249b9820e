#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "random_configurations.hpp"
#include "reference/images.hpp"
#include "verification/check.hpp"
#include "verification/reference_bridge.hpp"

namespace lanescape::testing {

// What is found for a random configuration, in the user's order; what is empty is not compared.
struct PairNumbersFound {
  double energy, virial;
  std::vector<double> gradient;
  std::vector<double> virial_tensor{};  // in double precision always
};

struct PairTolerances {
  double energy, virial, gradient, tensor;
};

// What rounding of coordinates does to a separation: four times 2^-53 of the largest coordinate or edge [sigma].
inline double separation_rounding(const Configuration& c) { return 4.0 * 0x1p-53 * largest_coordinate(c); }

// Rounding of separations counts relative to the least distance of 0.7 units, and amplified thirteen times by r^-13. In mixed
// precision with individual diameters a virial of few pairs is as far off as their forces.
inline PairTolerances tolerances(const RandomConfiguration& made) {
  const double rounding = 13.0 * separation_rounding(made.configuration) / (0.7 * made.unit);
  const double tensor = tolerance::pair_sums + rounding;
  if (made.options.precision == Precision::double_precision) return {tensor, tensor, tolerance::pair_gradient + rounding, tensor};
  const double sums = tolerance::mixed_sums + rounding;
  if (!made.model.form->has_diameters) return {sums, sums, tolerance::mixed_gradient + rounding, tensor};
  const double gradient = tolerance::mixed_diameters_gradient + rounding;
  return {sums, gradient, gradient, tensor};
}

// What rounding leaves to compare, where it decides whether a pair counts: at a cutoff, or as far from its image as from itself.
enum class Comparable { all, energy, nothing };

inline Comparable at_cutoff(Truncation truncation) {
  if (truncation == Truncation::shifted) return Comparable::energy;
  return truncation == Truncation::plain || truncation == Truncation::tail ? Comparable::nothing : Comparable::all;
}

// Whether an image of the separation d of two particles is at this distance from the cutoff or nearer.
inline bool is_at_cutoff(const RandomConfiguration& made, const Point& d, double cutoff, double width) {
  bool found = false;
  const Box& box = made.configuration.box;
  const auto rule = made.model.images == ImageRule::all ? reference::ImageRule::all : reference::ImageRule::minimum;
  reference::for_each_image(d, box.length, box.periodic, cutoff + width, rule, [&](const reference::Image& image) {
    found = found || std::abs(std::sqrt(reference::dot(image.separation, image.separation)) - cutoff) <= width;
  });
  return found;
}

// Whether two images of the separation d along some axis are as far away.
inline bool is_half_a_box(const Box& box, const Point& d, double width) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!box.periodic[axis]) continue;
    const double length = box.length[axis];
    if (std::abs(std::abs(std::remainder(d[axis], length)) - 0.5 * length) < 1e-9 * length + width) return true;
  }
  return false;
}

// What rounding may decide in a system. Images of a particle itself are at the same distances in all implementations.
struct DecidedByRounding {
  bool at_cutoff = false, half_a_box = false;
  double width = 0.0;  // of what is at the cutoff, relative to it

  explicit DecidedByRounding(const RandomConfiguration& made) {
    const Configuration& c = made.configuration;
    const double rounding = separation_rounding(c);
    const double relative_width = made.options.precision == Precision::mixed ? tolerance::mixed_cutoff : 1e-14;
    for (std::size_t i = 0; i < c.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Point d = difference(c.position(i), c.position(j));
        half_a_box = half_a_box || (made.model.images == ImageRule::minimum && is_half_a_box(c.box, d, rounding));
        if (made.model.form->has_diameters) continue;  // ends with value and slope zero, and is not tried there
        const auto pair = made.model.pair(static_cast<std::size_t>(c.species[i]), static_cast<std::size_t>(c.species[j]));
        const double cutoff = made.model.cutoff_of(pair), here = relative_width * cutoff + rounding;
        width = std::max(width, here / cutoff);
        at_cutoff = at_cutoff || is_at_cutoff(made, d, cutoff, here);
      }
  }

  Comparable comparable(const PairModel& model) const {
    if (half_a_box) return Comparable::nothing;
    // Forms with a range of their own end with value and slope zero, whatever the truncation.
    return !at_cutoff || std::isfinite(model.form->range) ? Comparable::all : lanescape::testing::at_cutoff(model.truncation);
  }
};

// The reference's numbers and magnitudes. Where a pair is at the cutoff, magnitudes are those of the system compressed a little, in
// which it counts: what is left of its energy and force in one implementation and not in another is rounding.
inline reference::Evaluation expected_of(const RandomConfiguration& made, const DecidedByRounding& rounding) {
  reference::Evaluation expected = evaluate_reference(made.model, made.configuration);
  if (!rounding.at_cutoff) return expected;
  Configuration compressed = made.configuration;
  for (double& x : compressed.positions) x *= 1.0 - 4.0 * rounding.width;
  for (double& edge : compressed.box.length) edge *= 1.0 - 4.0 * rounding.width;
  const reference::Evaluation there = evaluate_reference(made.model, compressed);
  expected.magnitude = there.magnitude;
  expected.virial_magnitude = there.virial_magnitude;
  expected.gradient_magnitude = there.gradient_magnitude;
  return expected;
}

inline PairTolerances deviations(const PairNumbersFound& found, const reference::Evaluation& expected) {
  PairTolerances worst{relative(found.energy, expected.energy, expected.magnitude),
                       relative(found.virial, expected.virial, expected.virial_magnitude), 0.0, 0.0};
  for (std::size_t i = 0; i < found.gradient.size() / 3; ++i) {
    const auto scale = std::ranges::max(std::span(expected.gradient_magnitude).subspan(3 * i, 3));
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
      worst.gradient = std::max(worst.gradient, relative(found.gradient[k], expected.gradient[k], scale));
  }
  for (std::size_t k = 0; k < found.virial_tensor.size(); ++k)
    worst.tensor = std::max(worst.tensor, relative(found.virial_tensor[k], expected.virial_tensor[k], expected.virial_magnitude));
  return worst;
}

inline bool within(const PairTolerances& worst, const PairTolerances& allowed, Comparable what) {
  if (what == Comparable::energy) return worst.energy <= allowed.energy;
  return worst.energy <= allowed.energy && worst.virial <= allowed.virial && worst.gradient <= allowed.gradient &&
         worst.tensor <= allowed.tensor;
}

inline std::string describe(const RandomConfiguration& made) {
  const Box& box = made.configuration.box;
  return fmt::format(
      "{}, {} species, images {}, {}, N={}, box {} {} {} units, {} open axes, largest coordinate {} units, {}, search {}",
      made.model.form->word, made.model.species.size(), to_string(made.model.images), to_string(made.model.truncation),
      made.configuration.size(), box.length[0] / made.unit, box.length[1] / made.unit, box.length[2] / made.unit,
      std::ranges::count(box.periodic, false), largest_coordinate(made.configuration) / made.unit,
      to_string(made.options.precision), static_cast<int>(made.options.search));
}

inline std::string describe(const PairTolerances& worst, const PairTolerances& allowed) {
  return fmt::format("deviations of energy {}, virial {}, gradient {}, tensor {}; allowed {} {} {} {}", worst.energy, worst.virial,
                     worst.gradient, worst.tensor, allowed.energy, allowed.virial, allowed.gradient, allowed.tensor);
}

}  // namespace lanescape::testing
