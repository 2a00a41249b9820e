#include "verification/hard_sphere_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/random.hpp"

namespace lanescape {
namespace {

constexpr std::uint64_t seed = 2;

Box cube(double length) { return {{length, length, length}}; }

enum class Sizes { equal, binary, polydisperse };

const char* to_string(Sizes sizes) { return sizes == Sizes::equal ? "equal" : sizes == Sizes::binary ? "binary" : "polydisperse"; }

// Radii from 0.5 to 0.7. The species are interleaved, so the library's order differs from the user's.
void add_sphere(Configuration& configuration, Sizes sizes, const Point& at) {
  const std::size_t i = configuration.size();
  const CounterRandom random(seed, RandomStream::species);
  const bool large = sizes == Sizes::binary && i % 3 != 1;
  configuration.species.push_back(large ? 1 : 0);
  configuration.radii.push_back(large                          ? 0.7
                                : sizes == Sizes::polydisperse ? 0.5 + 0.2 * random.uniform(1, static_cast<std::uint32_t>(i))
                                                               : 0.5);
  configuration.positions.insert(configuration.positions.end(), at.begin(), at.end());
}

// Moves every third particle to another image, up to `boxes` away along each axis.
void unwrap(Configuration& configuration, std::uint32_t boxes) {
  const CounterRandom random(seed, RandomStream::sites);
  for (std::uint32_t i = 2; i < configuration.size(); i += 3)
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      configuration.positions[3 * i + axis] +=
          (static_cast<double>(random.below(2 * boxes + 1, boxes, i, axis)) - boxes) * configuration.box.length[axis];
}

// n spheres on a simple lattice with the given spacing in units of the largest diameter, displaced by up to `rattle` per axis.
Configuration on_lattice(std::size_t n, Sizes sizes, bool cubic, double spacing, double rattle) {
  const double diameter = sizes == Sizes::equal ? 1.0 : 1.4, a = spacing * diameter;
  std::size_t edge = 3;  // boxes stay above twice the diameter
  while (edge * edge * edge < n) ++edge;
  const std::array<std::size_t, 3> cells = {edge, edge, cubic ? edge : edge + 2};
  const double narrower = cubic ? 1.0 : 0.98;
  Configuration configuration{
      {{a * static_cast<double>(cells[0]), a * narrower * static_cast<double>(cells[1]), a * static_cast<double>(cells[2])}},
      {},
      {},
      {}};
  const CounterRandom random(seed, RandomStream::displacements);
  for (std::size_t i = 0; i < n; ++i) {
    // Sites are spread over the whole box, not only over its first layers.
    const std::size_t site = i * (cells[0] * cells[1] * cells[2]) / n;
    const std::array<std::size_t, 3> at = {site % cells[0], site / cells[0] % cells[1], site / (cells[0] * cells[1])};
    Point p;
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      p[axis] = static_cast<double>(at[axis]) * configuration.box.length[axis] / static_cast<double>(cells[axis]) +
                rattle * (2.0 * random.uniform(n, static_cast<std::uint32_t>(i), axis) - 1.0);
    add_sphere(configuration, sizes, p);
  }
  unwrap(configuration, 4);
  return configuration;
}

// Numbers of particles that leave every remainder in vectors of 2 to 16 lanes and in tiles of 4 rows.
void add_sizes(std::vector<HardSphereCase>& cases) {
  for (const std::size_t n : {0U, 1U, 2U, 3U, 7U, 8U, 9U, 15U, 16U, 17U, 31U, 107U, 108U, 256U, 257U})
    for (const Sizes sizes : {Sizes::equal, Sizes::binary, Sizes::polydisperse})
      for (const bool cubic : {true, false}) {
        const std::string name = fmt::format("{} N={} {}", to_string(sizes), n, cubic ? "cube" : "box");
        cases.push_back({name + " apart", on_lattice(n, sizes, cubic, 1.07, 0.02)});
        cases.push_back({name + " overlapping", on_lattice(n, sizes, cubic, 1.02, 0.12)});
      }
}

Configuration pair_at(const Point& first, const Point& second, const Box& box, double r1, double r2) {
  return {box, {0, 0}, {first[0], first[1], first[2], second[0], second[1], second[2]}, {r1, r2}};
}

struct Contact {
  const char* name;
  Point separation;
  double s;
};
struct Image {
  const char* name;
  Point first, boxes;
};

constexpr double inside = 0.125, face = 7.75;

// A touching pair, and the same with radii one ulp larger and smaller.
void add_contact(std::vector<HardSphereCase>& cases, const Contact& contact, const Image& image, const Box& box) {
  Point first = image.first, second;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (first[axis] == face) first[axis] = box.length[axis] - 0.25;
    second[axis] = first[axis] + contact.separation[axis] + image.boxes[axis] * box.length[axis];
  }
  const double r = 0.5 * contact.s;
  const std::string where = fmt::format("({}, {}, {})", contact.name, image.name, box.length[0] == box.length[1] ? "cube" : "box");
  cases.push_back({"touching pair " + where, pair_at(first, second, box, r, r)});
  const double more = std::nextafter(r, 1.0), less = std::nextafter(r, 0.0);
  cases.push_back({"pair of radii one ulp too large " + where, pair_at(first, second, box, more, more)});
  cases.push_back({"pair of radii one ulp smaller " + where, pair_at(first, second, box, less, less)});
}

// The second sphere of a pair is next to the first, across faces, across a corner, or in other images. All coordinates are sums of
// a few powers of two, so they are exact.
void add_touching_pairs(std::vector<HardSphereCase>& cases) {
  const std::array<Image, 5> images = {{{"inside", {inside, inside, inside}, {0, 0, 0}},
                                        {"across a face", {face, inside, inside}, {-1, 0, 0}},
                                        {"across another face", {inside, inside, face}, {0, 0, -1}},
                                        {"across a corner", {face, face, face}, {-1, -1, -1}},
                                        {"six boxes away", {inside, face, inside}, {6, -6, 5}}}};
  for (const Contact& contact :
       {Contact{"x", {1.0, 0.0, 0.0}, 1.0}, Contact{"y", {0.0, -1.0, 0.0}, 1.0}, Contact{"z", {0.0, 0.0, 1.0}, 1.0},
        Contact{"3 4 5", {0.75, 1.0, 0.0}, 1.25}, Contact{"1 2 2", {0.25, 0.5, 0.5}, 0.75}})
    for (const Image& image : images)
      for (const Box& box : {cube(8.0), Box{{8.0, 16.0, 4.0}}}) add_contact(cases, contact, image, box);
  const Point origin{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Point nearer{}, farther{};
    nearer[axis] = std::nextafter(1.0, 0.0);
    farther[axis] = std::nextafter(1.0, 2.0);
    cases.push_back({fmt::format("pair one ulp too near, axis {}", axis), pair_at(origin, nearer, cube(8.0), 0.5, 0.5)});
    cases.push_back({fmt::format("pair one ulp farther, axis {}", axis), pair_at(origin, farther, cube(8.0), 0.5, 0.5)});
  }
  cases.push_back({"coincident pair", pair_at({1.0, 2.0, 3.0}, {1.0, 2.0, 3.0 + 8.0}, cube(8.0), 0.5, 0.5)});
  // A full vector of touching spheres: a row around the box.
  Configuration row{cube(16.0), {}, {}, {}};
  for (int i = 0; i < 16; ++i) add_sphere(row, Sizes::equal, {static_cast<double>(i), 0.0, 15.5});
  cases.push_back({"row of touching spheres around the box", row});
}

// Spheres anywhere, each with a partner whose distance from contact is 1e-2 to 1e-16 of it, on either side, or within rounding. A
// filter in lower precision must not lose such pairs, and a single fused operation would change the decision.
Configuration near_contact(std::size_t n, const Box& box, Sizes sizes) {
  const CounterRandom random(seed, RandomStream::displacements);
  Configuration configuration{box, {}, {}, {}};
  for (std::uint32_t i = 0; i < n; ++i) {
    Point p;
    if (i % 2 == 0) {
      for (std::uint32_t axis = 0; axis < 3; ++axis) p[axis] = box.length[axis] * random.uniform(3, i, axis);
      add_sphere(configuration, sizes, p);
      continue;
    }
    add_sphere(configuration, sizes, p = {});
    const double z = 2.0 * random.uniform(4, i, 0) - 1.0, phi = 6.283185307179586 * random.uniform(4, i, 1);
    const Point direction = {std::sqrt(1.0 - z * z) * std::cos(phi), std::sqrt(1.0 - z * z) * std::sin(phi), z};
    const double least = i % 8 < 4 ? -2.0 : -15.5;
    const double off = std::pow(10.0, least - (16.0 + least) * random.uniform(4, i, 2)) * (i % 4 == 1 ? 1.0 : -1.0);
    const double r = (configuration.radii[i] + configuration.radii[i - 1]) * (1.0 + off);
    for (std::size_t axis = 0; axis < 3; ++axis)
      configuration.positions[3 * i + axis] = configuration.positions[3 * (i - 1) + axis] + r * direction[axis];
  }
  return configuration;
}

void add_boxes(std::vector<HardSphereCase>& cases) {
  for (const Sizes sizes : {Sizes::equal, Sizes::binary, Sizes::polydisperse}) {
    const double twice = sizes == Sizes::equal ? 2.0 : 2.8;
    for (const auto& [shape, box] : {std::pair{"cube of 1000", cube(1000.0)}, std::pair{"cube of 12", cube(12.0)},
                                     std::pair{"box of 1000", Box{{1000.0, 700.0, 3.0}}}}) {
      Configuration configuration = near_contact(256, box, sizes);
      cases.push_back({fmt::format("{} near contact, {}", to_string(sizes), shape), configuration});
      unwrap(configuration, 1'000'000);
      cases.push_back({fmt::format("{} near contact, {}, a million boxes away", to_string(sizes), shape), configuration});
    }
    for (const std::size_t n : {2U, 3U, 5U, 9U})
      for (const double above : {0.0, 1e-12, 1e-3, 0.1}) {
        const double length = twice * (1.0 + above);
        const auto name = [&](const char* shape) {
          return fmt::format("{} N={} {} {} above twice the diameter", to_string(sizes), n, shape, above);
        };
        cases.push_back({name("cube"), near_contact(n, cube(length), sizes)});
        cases.push_back({name("box"), near_contact(n, {{1.3 * length, length, 1.1 * length}}, sizes)});
      }
    // The spheres are half a box apart: two images are at the same distance.
    Configuration halves = pair_at({0.0, 0.0, 0.0}, {0.5 * twice, 0.0, 0.0}, cube(twice), 0.25 * twice, 0.25 * twice);
    cases.push_back({fmt::format("{} pair touching in two images", to_string(sizes)), halves});
    halves.positions[3] = std::nextafter(halves.positions[3], 10.0);
    cases.push_back({fmt::format("{} pair overlapping in the other image", to_string(sizes)), halves});
  }
}

}  // namespace

std::vector<HardSphereCase> hard_sphere_cases() {
  std::vector<HardSphereCase> cases;
  add_sizes(cases);
  add_touching_pairs(cases);
  add_boxes(cases);
  return cases;
}

}  // namespace lanescape
