#include "configuration/lattice.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "core/random.hpp"

namespace lanescape {
namespace {

constexpr std::size_t max_particles = 100'000;  // of what all-pairs evaluation can be asked to do
constexpr double max_density = 100.0;

// Fisher and Yates, from the end.
template <class T>
void shuffle(std::vector<T>& items, const CounterRandom& random) {
  for (std::size_t i = items.size(); i > 1; --i)
    std::swap(items[i - 1], items[random.below(static_cast<std::uint32_t>(i), 0, static_cast<std::uint32_t>(i))]);
}

std::vector<int> species_in_proportion(const LennardJonesModel& model, std::size_t particles) {
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

}  // namespace

Configuration fcc_start(const LennardJonesModel& model, std::size_t particles, double density, std::uint64_t seed) {
  if (particles == 0 || particles > max_particles)
    throw_bad_input(fmt::format("{} particles are not allowed: from 1 to {}", particles, max_particles));
  if (!(density > 0.0 && density <= max_density))
    throw_bad_input(fmt::format("density {} is not allowed: above 0 and at most {}", density, max_density));

  std::size_t cells = 1;
  while (4 * cells * cells * cells < particles) ++cells;
  std::vector<std::size_t> sites(4 * cells * cells * cells);
  std::iota(sites.begin(), sites.end(), std::size_t{0});
  if (sites.size() > particles) {
    shuffle(sites, CounterRandom(seed, RandomStream::sites));
    sites.resize(particles);
  }
  const double length = std::cbrt(static_cast<double>(particles) / density);
  const double cell = length / static_cast<double>(cells);
  constexpr std::array<std::array<double, 3>, 4> basis = {{{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}};

  Configuration start{Box{{length, length, length}}, species_in_proportion(model, particles), {}};
  shuffle(start.species, CounterRandom(seed, RandomStream::species));
  for (const std::size_t site : sites) {
    const std::size_t corner = site / 4;
    const std::array<std::size_t, 3> at = {corner % cells, corner / cells % cells, corner / (cells * cells)};
    for (std::size_t axis = 0; axis < 3; ++axis)
      start.positions.push_back(cell * (static_cast<double>(at[axis]) + basis[site % 4][axis]));
  }
  return start;
}

}  // namespace lanescape
