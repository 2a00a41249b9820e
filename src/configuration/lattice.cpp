#include "configuration/lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "core/random.hpp"

namespace lanescape {
namespace {

constexpr std::size_t max_particles = 4'000'000;  // a gigabyte of state and lists
constexpr double max_density = 100.0;
constexpr double max_packing_fraction = 0.74;  // pi/(3 sqrt 2) = 0.7405 is close packing
constexpr double rounding_margin = 1e-12;

// The Fisher-Yates shuffle, from the end.
template <class T>
void shuffle(std::vector<T>& items, const CounterRandom& random) {
  for (std::size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[random.below(static_cast<std::uint32_t>(i), 0, static_cast<std::uint32_t>(i))]);
}

std::vector<int> species_in_proportion(const Mixture& model, std::size_t particles) {
  std::vector<int> species(particles, 0);
  std::size_t next = particles;
  for (std::size_t s = 1; s < model.species.size(); ++s) {
    // The guard keeps 0.2 * 500 at 100 where the product rounds below it.
    const double share = model.species[s].fraction * static_cast<double>(particles);
    const auto count = std::min(next, static_cast<std::size_t>(std::floor(share + 1e-9)));
    for (std::size_t k = 0; k < count; ++k) species[--next] = static_cast<int>(s);
  }
  return species;
}

void check_particles(std::size_t particles) {
  if (particles == 0 || particles > max_particles)
    throw_bad_input(fmt::format("{} particles are not allowed: from 1 to {}", particles, max_particles));
}

// The occupied sites of cells of four sites each, along each edge of a box so many that they are nearly cubic.
struct Lattice {
  std::array<std::size_t, 3> cells{1, 1, 1};  // along each edge
  std::vector<std::size_t> sites;             // of each particle

  // In a cube, which has as many cells along each edge, or in a box of this shape.
  Lattice(std::size_t particles, std::uint64_t seed, const Point& edges = {1.0, 1.0, 1.0}) {
    const bool cube = edges[0] == edges[1] && edges[1] == edges[2];
    while (4 * cells[0] * cells[1] * cells[2] < particles) {
      if (cube) {
        for (std::size_t& n : cells) ++n;
        continue;
      }
      // The longest cell is cut.
      const auto longer = [&](std::size_t a, std::size_t b) {
        return edges[a] / static_cast<double>(cells[a]) < edges[b] / static_cast<double>(cells[b]);
      };
      ++cells[*std::max_element(axes.begin(), axes.end(), longer)];
    }
    sites.resize(4 * cells[0] * cells[1] * cells[2]);
    std::iota(sites.begin(), sites.end(), std::size_t{0});
    if (sites.size() == particles) return;
    shuffle(sites, CounterRandom(seed, RandomStream::sites));
    sites.resize(particles);
  }

  // In half edges of a cell, where sites are the triples of integers with an even sum.
  std::array<std::size_t, 3> half_edges(std::size_t site) const {
    constexpr std::array<std::array<std::size_t, 3>, 4> basis = {{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}};
    const std::size_t corner = site / 4;
    const auto& b = basis[site % 4];
    return {2 * (corner % cells[0]) + b[0], 2 * (corner / cells[0] % cells[1]) + b[1], 2 * (corner / (cells[0] * cells[1])) + b[2]};
  }
  std::vector<double> positions(const Point& edges) const {
    std::vector<double> result;
    result.reserve(3 * sites.size());
    for (const std::size_t site : sites) {
      const std::array<std::size_t, 3> half = half_edges(site);
      for (const std::size_t axis : axes)
        result.push_back(edges[axis] / static_cast<double>(cells[axis]) * (0.5 * static_cast<double>(half[axis])));
    }
    return result;
  }

 private:
  static constexpr std::array<std::size_t, 3> axes{0, 1, 2};
};

// Spheres on lattice sites; the edge of the box is not yet fixed.
struct Packing {
  Lattice lattice;
  std::vector<int> species;   // of each particle
  std::vector<double> radii;  // of each particle
  double volume = 0.0;        // of all spheres [sigma^3]

  Packing(const HardSphereModel& model, std::size_t particles, Arrangement arrangement, std::uint64_t seed)
      : lattice(particles, seed), species(species_in_proportion(model, particles)) {
    // Summed by species, so that the box does not depend on the order of particles.
    for (std::size_t s = 0; s < model.species.size(); ++s)
      volume += static_cast<double>(std::count(species.begin(), species.end(), static_cast<int>(s))) * std::numbers::pi / 6.0 *
                std::pow(model.diameters[s], 3);
    if (arrangement == Arrangement::random) {
      shuffle(species, CounterRandom(seed, RandomStream::species));
    } else {
      const auto diameter = [&](int s) { return model.diameters[static_cast<std::size_t>(s)]; };
      std::stable_sort(species.begin(), species.end(), [&](int a, int b) { return diameter(a) > diameter(b); });
      std::sort(lattice.sites.begin(), lattice.sites.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(lattice.half_edges(a)[0], a) < std::pair(lattice.half_edges(b)[0], b);
      });
    }
    radii = model.radii_of(species);
  }
};

struct Offset {
  std::array<std::size_t, 3> steps;  // in half edges, a whole turn added to keep them positive
  double length;                     // [half edges]
};

// Separations of two sites, or of a site and its images, up to a turn along each axis, shortest first.
std::vector<Offset> offsets_within(std::size_t cells, double reach) {
  const auto period = static_cast<std::ptrdiff_t>(2 * cells), most = std::min(period, static_cast<std::ptrdiff_t>(reach) + 1);
  std::vector<Offset> offsets;
  for (std::ptrdiff_t z = -most; z <= most; ++z)
    for (std::ptrdiff_t y = -most; y <= most; ++y)
      for (std::ptrdiff_t x = -most; x <= most; ++x) {
        const double length = std::sqrt(static_cast<double>(x * x + y * y + z * z));
        if ((x + y + z) % 2 != 0 || length == 0.0 || length > reach) continue;
        offsets.push_back(
            {{static_cast<std::size_t>(x + period), static_cast<std::size_t>(y + period), static_cast<std::size_t>(z + period)},
             length});
      }
  std::stable_sort(offsets.begin(), offsets.end(), [](const Offset& a, const Offset& b) { return a.length < b.length; });
  return offsets;
}

// The least r_ij / s_ij over pairs of spheres and their images, in half edges per sigma. Each pair is visited from its larger
// sphere, so that only spheres large enough to reach a distant site visit it: O(N) for similar sizes.
double least_distance_ratio(const Packing& packing) {
  const std::size_t period = 2 * packing.lattice.cells[0], n = packing.radii.size();
  const auto place = [&](const std::array<std::size_t, 3>& at) { return (at[2] * period + at[1]) * period + at[0]; };
  std::vector<double> radius_at(period * period * period, 0.0);  // 0: empty
  std::vector<std::size_t> by_size(n);
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  std::stable_sort(by_size.begin(), by_size.end(), [&](auto i, auto j) { return packing.radii[i] > packing.radii[j]; });
  for (std::size_t i = 0; i < n; ++i) radius_at[place(packing.lattice.half_edges(packing.lattice.sites[i]))] = packing.radii[i];

  // A sphere's own image bounds the ratio from above.
  const double largest = packing.radii[by_size.front()];
  double least = static_cast<double>(period) / (2.0 * largest);
  for (double reach = 2.0;; reach *= 2.0) {
    for (const Offset& offset : offsets_within(packing.lattice.cells[0], reach)) {
      if (offset.length >= least * 2.0 * largest) return least;
      for (const std::size_t i : by_size) {
        const double r = packing.radii[i];
        if (offset.length >= least * 2.0 * r) break;
        std::array<std::size_t, 3> at = packing.lattice.half_edges(packing.lattice.sites[i]);
        for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = (at[axis] + offset.steps[axis]) % period;
        const double other = radius_at[place(at)];
        if (other > 0.0 && other <= r) least = std::min(least, offset.length / (r + other));
      }
    }
    if (reach >= least * 2.0 * largest) return least;
  }
}

// The packing fraction at which the closest two spheres touch.
double largest_packing_fraction(const Packing& packing) {
  const double edge = 2.0 * static_cast<double>(packing.lattice.cells[0]) / least_distance_ratio(packing);
  return std::min(max_packing_fraction, packing.volume / (edge * edge * edge) * (1.0 - rounding_margin));
}

void check_density(double density, double length_unit) {
  if (const double most = max_density * std::pow(length_unit, -3); !(density > 0.0 && density <= most))
    throw_bad_input(fmt::format("density {} is not allowed: above 0 and at most {}", density, most));
}

Configuration fcc_start(const Mixture& model, std::size_t particles, double density, std::uint64_t seed, double length_unit) {
  check_particles(particles);
  check_density(density, length_unit);
  const double length = std::cbrt(static_cast<double>(particles) / density);
  Configuration start{Box{{length, length, length}}, species_in_proportion(model, particles),
                      Lattice(particles, seed).positions({length, length, length})};
  shuffle(start.species, CounterRandom(seed, RandomStream::species));
  return start;
}

}  // namespace

Configuration fcc_start(const StateMixtureModel& model, std::size_t particles, double density, std::uint64_t seed) {
  return fcc_start(model, particles, density, seed, model.length_unit());
}

Configuration fcc_start(const PairModel& model, std::size_t particles, double density, std::uint64_t seed) {
  Configuration start = fcc_start(model, particles, density, seed, model.length_unit());
  if (!model.form->has_diameters) return start;
  constexpr double ratio = 0.45, largest = 0.5 * (1.0 + ratio) / ratio, smallest = ratio * largest;
  const double most = 1.0 / (smallest * smallest), least = 1.0 / (largest * largest);
  for (std::size_t i = 0; i < particles; ++i) {
    const double quantile = (static_cast<double>(i) + 0.5) / static_cast<double>(particles);
    start.diameters.push_back(1.0 / std::sqrt(most - quantile * (most - least)));
  }
  shuffle(start.diameters, CounterRandom(seed, RandomStream::diameters));
  return start;
}

Configuration fcc_in_box(const PairModel& model, const Box& box, double density, std::uint64_t seed) {
  check_density(density, model.length_unit());
  const double particles = std::round(density * box.volume());
  check_particles(particles <= static_cast<double>(max_particles) ? static_cast<std::size_t>(particles) : max_particles + 1);
  const auto count = static_cast<std::size_t>(particles);
  Configuration start{box, species_in_proportion(model, count), Lattice(count, seed, box.length).positions(box.length)};
  shuffle(start.species, CounterRandom(seed, RandomStream::species));
  return start;
}

Configuration hard_sphere_start(const HardSphereModel& model, std::size_t particles, double packing_fraction,
                                Arrangement arrangement, std::uint64_t seed) {
  check_particles(particles);
  if (!(packing_fraction > 0.0 && packing_fraction <= max_packing_fraction))
    throw_bad_input(
        fmt::format("packing fraction {} is not allowed: above 0 and at most {}", packing_fraction, max_packing_fraction));
  model.check();
  Packing packing(model, particles, arrangement, seed);
  if (const double largest = largest_packing_fraction(packing); packing_fraction > largest)
    throw_bad_input(fmt::format("packing fraction {} is beyond what this arrangement on an fcc lattice can reach ({:.6f})",
                                packing_fraction,
                                1e-6 * std::floor(1e6 * largest)));  // rounded down: the value in the message is allowed
  const double length = std::cbrt(packing.volume / packing_fraction);
  return {Box{{length, length, length}}, std::move(packing.species), packing.lattice.positions({length, length, length}),
          std::move(packing.radii)};
}

double largest_lattice_packing_fraction(const HardSphereModel& model, std::size_t particles, Arrangement arrangement,
                                        std::uint64_t seed) {
  check_particles(particles);
  model.check();
  return largest_packing_fraction(Packing(model, particles, arrangement, seed));
}

}  // namespace lanescape
