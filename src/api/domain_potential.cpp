#include <lanescape/domain_potential.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "api/host_arrays.hpp"
#include "api/pair_models.hpp"
#include "core/error.hpp"
#include "core/float_environment.hpp"
#include "core/option_checks.hpp"
#include "dispatch/isa.hpp"
#include "interaction/pair/host_list_sums.hpp"
#include "interaction/pair/pair_sums.hpp"

namespace lanescape {
LANESCAPE_ABI_BEGIN

namespace {

// Longer than elsewhere: engines renew their ghosts, and so these lists, now and then anyway [sigma].
constexpr double domain_skin = 0.45;

// Species of the domain, and then the same as ghosts, which do not see each other: their reach is nothing beside any other.
// `share` of each pair with a ghost counts.
PairModel with_ghosts(const PairModel& model, double share) {
  constexpr double no_reach = 1e-6;
  const std::size_t count = model.species.size(), all = 2 * count;
  PairModel expanded = model;
  expanded.species.insert(expanded.species.end(), model.species.begin(), model.species.end());
  expanded.epsilon.resize(all * all);
  expanded.sigma.resize(all * all);
  for (std::size_t a = 0; a < all; ++a)
    for (std::size_t b = 0; b < all; ++b) {
      const std::size_t of = model.pair(a % count, b % count);
      const bool ghost_a = a >= count, ghost_b = b >= count;
      expanded.epsilon[a * all + b] = model.epsilon[of] * (ghost_a && ghost_b ? 0.0 : ghost_a || ghost_b ? share : 1.0);
      expanded.sigma[a * all + b] = model.sigma[of] * (ghost_a && ghost_b ? no_reach : 1.0);
    }
  return expanded;
}

}  // namespace

struct DomainPotential::Implementation {
  Implementation(const Model& given, Options with)
      : model(pair_model(given, "a DomainPotential")),
        options(std::move(with)),
        table(&kernel_table(choose_isa(options.instruction_set))),
        unit(model.length_unit()),
        reduced(model.in_unit(unit)),
        reach(reduced.largest_cutoff() + domain_skin) {
    check_without_box(model);
    checked_threads(options.threads);
  }

  void set(std::span<const int> given, std::span<const int> domain) {
    if (arrays && std::ranges::equal(species, given) && std::ranges::equal(in_domain, domain)) return;
    check_room("marks of the domain", domain.size(), given.size());
    const int count = static_cast<int>(model.species.size());
    const auto unknown = std::ranges::find_if(given, [&](int s) { return s < 0 || s >= count; });
    if (unknown != given.end())
      throw_bad_input(fmt::format("species {} of particle {} is not allowed: model {} has {}, numbered from 0", *unknown,
                                  unknown - given.begin(), model.name, count));
    species.assign(given.begin(), given.end());
    in_domain.assign(domain.begin(), domain.end());
    std::vector<int> kinds;
    for (std::size_t k = 0; k < species.size(); ++k) kinds.push_back(species[k] + (in_domain[k] != 0 ? 0 : count));
    arrays.emplace(ParticleLayout(kinds, 2 * model.species.size()));
    sums.reset();
    whole.reset();
  }

  // Puts the positions inside a box with room around them, so that no image is near.
  void place(const Vectors<const double>& host) {
    const std::size_t slots = arrays->layout().slots();
    positions = arrays->positions(host);
    bool fits = sums != nullptr;
    std::array<double, 3> least{}, most{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t k = 0; k < slots; ++k) positions[axis * slots + k] /= unit;
      const auto [low, high] = extent(axis);
      least[axis] = low;
      most[axis] = high;
      fits = fits && low >= corner[axis] + reach && high <= corner[axis] + box.length[axis] - reach;
    }
    if (!fits) make(least, most);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const auto& block : arrays->layout().blocks())
        for (std::size_t k = block.begin; k < block.begin + block.count; ++k) positions[axis * slots + k] -= corner[axis];
  }

  std::pair<double, double> extent(std::size_t axis) const {
    const double* x = positions.data() + axis * arrays->layout().slots();
    std::optional<std::pair<double, double>> found;
    for (const auto& block : arrays->layout().blocks()) {
      if (block.count == 0) continue;
      const auto [low, high] = std::minmax_element(x + block.begin, x + block.begin + block.count);
      found = found ? std::pair{std::min(found->first, *low), std::max(found->second, *high)} : std::pair{*low, *high};
    }
    return found.value_or(std::pair{0.0, 0.0});
  }

  void make(const std::array<double, 3>& least, const std::array<double, 3>& most) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double room = reach + 0.05 * (most[axis] - least[axis]) + domain_skin;
      corner[axis] = least[axis] - room;
      box.length[axis] = most[axis] - least[axis] + 2.0 * room;
    }
    sums = make_sums(0.5);
    if (whole) whole = make_sums(1.0);
  }

  std::unique_ptr<ListSums> make_sums(double share) const {
    return std::make_unique<ListSums>(with_ghosts(reduced, share), box, arrays->layout(), *table, domain_skin,
                                      useful_threads(species.size(), options.threads), Precision::double_precision);
  }

  void write_energies(std::span<double> energies) {
    if (!whole) whole = make_sums(1.0);
    whole->energies(positions, arrays->energies());
    arrays->write_energies(energies);
    for (std::size_t k = 0; k < energies.size(); ++k)
      if (in_domain[k] == 0) energies[k] = 0.0;
  }

  ListedEvaluation sum(const ListedOutputs& outputs) {
    if (!outputs.stress && outputs.forces.x == nullptr) return {.energy = outputs.energy ? sums->energy(positions) : 0.0};
    kernels::PairOutput out{};
    AlignedArray& gradient = arrays->gradient();
    if (outputs.stress)
      sums->stress(positions, gradient, out);
    else if (outputs.energy)
      sums->gradient(positions, gradient, out);
    else
      sums->gradient_only(positions, gradient);
    ListedEvaluation e{out.energy, out.virial, {}};
    std::ranges::copy(out.virial_tensor, e.virial_tensor.begin());
    return e;
  }

  void write_forces(const ListedOutputs& outputs) {
    for (double& g : arrays->gradient()) g /= unit;
    if (outputs.add_to_forces)
      arrays->add_forces(outputs.forces);
    else
      arrays->write_forces(outputs.forces);
  }

  PairModel model;
  Options options;
  const kernels::KernelTable* table;
  double unit;  // of length inside
  PairModel reduced;
  double reach;  // of lists
  std::vector<int> species, in_domain;
  std::optional<HostArrays> arrays;  // in two kinds of each species
  Box box{};
  std::array<double, 3> corner{};
  AlignedArray positions;
  std::unique_ptr<ListSums> sums, whole;  // with half of each pair with a ghost; with all of it, for energies of particles
};

DomainPotential::DomainPotential(const Model& model) : DomainPotential(model, Options{}) {}
DomainPotential::DomainPotential(const Model& model, const Options& options)
    : implementation_(std::make_unique<Implementation>(model, options)) {}
DomainPotential::~DomainPotential() = default;
DomainPotential::DomainPotential(DomainPotential&&) noexcept = default;
DomainPotential& DomainPotential::operator=(DomainPotential&&) noexcept = default;

void DomainPotential::set_particles(std::span<const int> species, std::span<const int> in_domain) {
  implementation_->set(species, in_domain);
}

std::size_t DomainPotential::particles() const { return implementation_->species.size(); }

ListedEvaluation DomainPotential::evaluate(const Vectors<const double>& positions, const ListedOutputs& outputs) {
  Implementation& of = *implementation_;
  check_positions(positions, particles());
  if (outputs.forces.x != nullptr) check_forces(outputs.forces, particles());
  if (!outputs.energies.empty()) check_room("energies", outputs.energies.size(), particles());
  if (particles() == 0) return {};
  const FloatEnvironment environment;
  of.place(positions);
  if (!outputs.energies.empty()) of.write_energies(outputs.energies);
  const ListedEvaluation result = of.sum(outputs);
  if (outputs.forces.x != nullptr) of.write_forces(outputs);
  return result;
}

LANESCAPE_ABI_END
}  // namespace lanescape
