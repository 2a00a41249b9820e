#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "configuration/configuration.hpp"

namespace lanescape::testing {

// What generators of random systems share: all follows from one number. Boxes and coordinates are as nobody would write them down.
class RandomDraws {
 public:
  explicit RandomDraws(std::uint64_t number) : generator_(number), far_away_(between(0.0, 1.0) < 0.1) {}

 protected:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  std::size_t below(std::size_t n) { return std::min(n - 1, static_cast<std::size_t>(between(0.0, static_cast<double>(n)))); }
  bool chance(double p) { return between(0.0, 1.0) < p; }
  // x, or a number next to it.
  double one_ulp_from(double x) {
    const std::size_t side = below(3);
    return side == 0 ? x : std::nextafter(x, side == 1 ? 0.0 : 2.0 * x);
  }

  // Edges from half a length such as a cutoff to 10^6 units, up to 1:100. Some are half a length or several, or one ulp off that.
  Box box(std::span<const double> lengths, double unit) {
    const double first = lengths[below(lengths.size())];
    const double base = chance(0.4) ? first * between(0.5, 3.0) : unit * std::pow(10.0, between(0.3, 6.0));
    Box box{{base, base, base}};
    if (chance(0.6)) {
      for (double& edge : box.length) edge = base * std::pow(10.0, between(0.0, 2.0));
      box.length[below(3)] = base;
    }
    if (!chance(0.25)) return box;
    for (double& edge : box.length)
      if (chance(0.7)) edge = one_ulp_from(0.5 * static_cast<double>(1 + below(8)) * lengths[below(lengths.size())]);
    if (chance(0.3)) box.length[1] = box.length[2] = box.length[0];
    return box;
  }

  // A coordinate near a centre, or anywhere; on a face at times or one ulp from it, and boxes away: up to 10^6 of them in one
  // system of ten, but no further than 10^12 units, where 10^-4 units are one ulp.
  double coordinate(double centre, double spread, double edge, double unit) {
    double x = centre + between(-spread, spread);
    if (chance(0.02)) x = 0.0;
    if (chance(0.02)) x = edge;
    if (chance(0.02)) x = one_ulp_from(edge * (1.0 + static_cast<double>(below(4))));
    if (chance(0.05)) x += edge * (static_cast<double>(below(9)) - 4.0);
    if (!far_away_ || !chance(0.3)) return x;
    const double away = std::floor(std::min(1e6, 1e12 * unit / edge));
    const double boxes = std::floor(between(-away, away));
    return chance(0.2) && boxes != 0.0 ? one_ulp_from(boxes * edge) : x + boxes * edge;
  }

  // A place near one of the centres, or anywhere in the box.
  Point place(const std::vector<Point>& centres, const Box& box, double spread, double unit) {
    const Point& centre = centres[below(centres.size())];
    Point at{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      at[axis] = coordinate(centre[axis], std::min(spread, box.length[axis]), box.length[axis], unit);
    return at;
  }

  std::vector<Point> centres(std::size_t count, const Box& box) {
    std::vector<Point> centres(count);
    for (Point& centre : centres)
      for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] = box.length[axis] * between(0.0, 1.0);
    return centres;
  }

  // One of the particles moved along an axis by one of the lengths, to an ulp.
  Point beside(const Configuration& c, std::span<const double> lengths) {
    Point at = c.position(below(c.size()));
    at[below(3)] += one_ulp_from(lengths[below(lengths.size())]) * (chance(0.5) ? 1.0 : -1.0);
    return at;
  }

  // Puts up to `wanted` particles of `species` into the box of c, no two nearer than `least` at their nearest images; in some
  // systems a few are at one of the lengths, such as a cutoff, from others.
  void fill(Configuration& c, std::size_t wanted, std::size_t species, double least, double unit, std::span<const double> lengths) {
    const std::vector<Point> centres = this->centres(1 + below(4), c.box);
    const double around = unit * std::cbrt(static_cast<double>(wanted)) * between(0.5, 1.5);
    const double spread = chance(0.7) ? around : *std::ranges::max_element(c.box.length);
    const double at_lengths = chance(0.1) ? 0.2 : 0.0;
    for (std::size_t attempt = 0; attempt < 20 * wanted && c.size() < wanted; ++attempt) {
      const Point at = c.size() > 0 && chance(at_lengths) ? beside(c, lengths) : place(centres, c.box, spread, unit);
      if (!has_room(c, at, least)) continue;
      c.positions.insert(c.positions.end(), at.begin(), at.end());
      c.species.push_back(static_cast<int>(below(species)));
    }
  }

  static bool has_room(const Configuration& c, const Point& at, double least) {
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Point d = c.box.nearest_image(difference(c.position(i), at));
      if (dot(d, d) < least * least) return false;
    }
    return true;
  }

 private:
  std::mt19937_64 generator_;
  bool far_away_;  // some particles are
};

// The largest coordinate or edge: rounding of separations is proportional to it.
inline double largest_coordinate(const Configuration& c) {
  double largest = *std::ranges::max_element(c.box.length);
  for (const double x : c.positions) largest = std::max(largest, std::abs(x));
  return largest;
}

}  // namespace lanescape::testing
