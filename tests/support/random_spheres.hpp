#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "configuration/configuration.hpp"
#include "random_draws.hpp"

namespace lanescape::testing {

// Hard spheres of one to five species, or each of its own size, in any unit of length. Many touch, to an ulp, or nearly.
struct RandomSpheres {
  Configuration configuration;
  std::size_t species;
  double reach;  // beyond contact, within which only the nearest image matters [sigma]
  bool box_holds_spheres;
};

class RandomSphereSystems : private RandomDraws {
 public:
  using RandomDraws::RandomDraws;

  // The unit is 10^-decades to 10^decades.
  RandomSpheres make(double decades = 12.0) {
    const double unit = std::pow(10.0, between(-decades, decades));
    RandomSpheres made{{}, 1 + below(5), 0.0, true};
    const std::size_t wanted = chance(0.005) ? 500 + below(1500) : chance(0.2) ? 100 + below(200) : 1 + below(60);
    const std::vector<double> radii = sizes(made.species, wanted, unit);
    const double diameter = 2.0 * *std::ranges::max_element(radii);
    Configuration& c = made.configuration;
    c.box = box_of(diameter, unit);
    const double overlapping = chance(0.5) ? 0.0 : between(0.0, 0.3), touching = chance(0.6) ? between(0.0, 0.5) : 0.0;
    const std::vector<Point> centres = this->centres(1 + below(4), c.box);
    const double spread = chance(0.5) ? diameter * std::cbrt(static_cast<double>(wanted)) : *std::ranges::max_element(c.box.length);
    for (std::size_t attempt = 0; attempt < 10 * wanted && c.size() < wanted; ++attempt) {
      const double radius = radii[c.size()];
      const Point at = c.size() > 0 && chance(touching) ? contact(c, radius) : place(centres, c.box, spread, unit);
      if (!chance(overlapping) && !is_free(c, at, radius)) continue;
      c.positions.insert(c.positions.end(), at.begin(), at.end());
      c.radii.push_back(radius);
      c.species.push_back(static_cast<int>(c.size() % made.species));
    }
    const double room = 0.5 * c.box.shortest() - 2.0 * *std::ranges::max_element(c.radii);
    made.box_holds_spheres = c.box.shortest() >= 4.0 * *std::ranges::max_element(c.radii);
    made.reach = std::max(0.0, room) * (chance(0.5) ? between(0.0, 1.0) : std::pow(10.0, between(-16.0, 0.0)));
    return made;
  }

 private:
  std::vector<double> sizes(std::size_t species, std::size_t count, double unit) {
    const double ratio = chance(0.1) ? 100.0 : 3.0;
    const bool own = chance(0.3);
    std::vector<double> of_species, all;
    for (std::size_t s = 0; s < species; ++s) of_species.push_back(0.5 * unit * std::pow(ratio, -between(0.0, 1.0)));
    for (std::size_t i = 0; i < count; ++i)
      all.push_back(own ? 0.5 * unit * std::pow(ratio, -between(0.0, 1.0)) : of_species[i % species]);
    return all;
  }

  // From two diameters on; some edges are an ulp off that, and here and there one is too short.
  Box box_of(double diameter, double unit) {
    const double lengths[] = {2.0 * diameter};
    Box box = this->box(lengths, unit);
    for (double& edge : box.length)
      if (edge < 2.0 * diameter && !chance(0.02)) edge = std::nextafter(2.0 * diameter, (chance(0.9) ? 3.0 : 0.0) * diameter);
    return box;
  }

  // A place at contact with one of the spheres, or 10^-2 to 10^-16 of the distance off it, along an axis or not.
  Point contact(const Configuration& c, double radius) {
    const std::size_t other = below(c.size());
    double distance = c.radii[other] + radius;
    if (chance(0.7)) distance *= 1.0 + (chance(0.5) ? 1.0 : -1.0) * std::pow(10.0, between(-16.0, -2.0));
    const double z = between(-1.0, 1.0), phi = between(0.0, 6.283185307179586);
    Point direction{std::sqrt(1.0 - z * z) * std::cos(phi), std::sqrt(1.0 - z * z) * std::sin(phi), z};
    if (chance(0.3)) direction = {0.0, chance(0.5) ? 1.0 : -1.0, 0.0};
    Point at = c.position(other);
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += distance * direction[axis];
    if (chance(0.2)) at[0] += c.box.length[0] * (static_cast<double>(below(9)) - 4.0);
    return at;
  }

  // Whether a sphere has room there, or overlaps by no more than rounding and a hundredth.
  static bool is_free(const Configuration& c, const Point& at, double radius) {
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Point d = c.box.nearest_image(difference(c.position(i), at));
      const double least = 0.98 * (c.radii[i] + radius);
      if (dot(d, d) < least * least) return false;
    }
    return true;
  }
};

}  // namespace lanescape::testing
